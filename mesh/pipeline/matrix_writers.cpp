#include "mesh/pipeline/matrix_writers.h"

#include "mesh/pipeline/csv_matrix.h"
#include "mesh/pipeline/hdf5_matrix.h"
#include "mesh/pipeline/npy_matrix.h"
#include "mesh/pipeline/view3d_matrix.h"

namespace penumbra {

MatrixWriterRegistry& MatrixWriters() {
  static MatrixWriterRegistry registry(
      "matrix writer", {Hdf5MatrixMethod(), CsvMatrixMethod(), NpyMatrixMethod(), View3dMatrixMethod()});
  return registry;
}

}  // namespace penumbra
