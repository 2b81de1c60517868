// mesh/pipeline/matrix_writer.h
//
// The interface of writers of form-factor matrices. Each file format of form-factor matrices has its own
// writer.

#pragma once

#include <string>
#include <vector>

#include "solver/base/registry.h"
#include "solver/visibility/area/form_factor_matrix.h"

namespace penumbra {

// A form-factor matrix with the names of its rows. Row i and column i of the form-factor matrix have the same
// name.
struct NamedMatrix {
  FormFactorMatrix matrix;
  std::vector<std::string> names;  // the name of the face or object that belongs to each row of the matrix
  // The name of the object that contains the face of each row; empty if rows are objects.
  std::vector<std::string> objects;
  // Area of each row's surfaces, including parts that other surfaces touch and cover [m^2].
  std::vector<double> whole_area;
  // The absorptance 1 - reflectance of each row's surfaces, averaged over area and channels.
  std::vector<double> absorptance;
};

// The largest number of rows of a dense matrix, which limits one array of doubles to 1.8 GB.
inline constexpr std::size_t kMostDenseRows = 15'000;

class MatrixWriter {
 public:
  virtual ~MatrixWriter() = default;

  // True if the file format stores every entry of the matrix, including zeros.
  virtual bool IsDense() const { return true; }

  // Returns the contents of the matrix file. Equal matrices give files with equal bytes. REQUIRES: if
  // IsDense() is true, the matrix has at most kMostDenseRows rows.
  virtual std::string Bytes(const NamedMatrix& matrix) const = 0;
};

// The type of the registry that MatrixWriters() returns. The name of a matrix writer is the ending of its
// files, without the dot.
using MatrixWriterRegistry = Registry<const MatrixWriter>;

// Returns all entries of a sparse matrix as a dense array in row-major order. `values` has one value for each
// stored entry of the matrix; all other entries are 0.
std::vector<double> Dense(const FormFactorMatrix& matrix, const std::vector<double>& values);

}  // namespace penumbra
