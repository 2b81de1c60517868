#include "mesh/pipeline/matrix_writer.h"

namespace penumbra {

std::vector<double> Dense(const FormFactorMatrix& matrix, const std::vector<double>& values) {
  std::vector<double> dense(matrix.Rows() * matrix.Rows(), 0.0);
  for (std::size_t row = 0; row < matrix.Rows(); ++row)
    for (std::size_t k = matrix.first[row]; k < matrix.first[row + 1]; ++k)
      dense[row * matrix.Rows() + static_cast<std::size_t>(matrix.column[k])] = values[k];
  return dense;
}

}  // namespace penumbra
