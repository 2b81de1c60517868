// mesh/pipeline/matrix_writer.h
//
// The interface of writers of form-factor matrices. Each file format has its own writer.

#pragma once

#include <string>
#include <vector>

#include "solver/base/registry.h"
#include "solver/visibility/area/form_factor_matrix.h"

namespace penumbra {

// A matrix with the names of its rows, which are those of its columns, too.
struct NamedMatrix {
  FormFactorMatrix matrix;
  std::vector<std::string> names;    // of each row
  std::vector<std::string> objects;  // the object of each row's face; empty if rows are objects
  std::vector<double> whole_area;    // of each row, with what is covered [m^2]
  std::vector<double> absorptance;   // of each row: 1 - reflectance, the mean of channels and area
};

// The most rows of a dense array: 1.8 GB for one array of doubles.
inline constexpr std::size_t kMostDenseRows = 15'000;

class MatrixWriter {
 public:
  virtual ~MatrixWriter() = default;

  // True if the format stores every entry, 0 or not.
  virtual bool IsDense() const { return true; }

  // The contents of the file. Equal matrices give equal bytes. REQUIRES: at most kMostDenseRows rows if
  // IsDense().
  virtual std::string Bytes(const NamedMatrix& matrix) const = 0;
};

// The type of MatrixWriters(). The name of a writer is the ending of its files, without the dot.
using MatrixWriterRegistry = Registry<const MatrixWriter>;

// All entries in row-major order. `values` has one value per stored entry of the matrix; the others are 0.
std::vector<double> Dense(const FormFactorMatrix& matrix, const std::vector<double>& values);

}  // namespace penumbra
