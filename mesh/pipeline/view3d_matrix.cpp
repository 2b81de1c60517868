// The text file of View3D (Walton 2002, NISTIR 6925), which programs for radiant heat read; there is no
// library for it.

#include "mesh/pipeline/view3d_matrix.h"

#include <fmt/format.h>

#include <iterator>

namespace penumbra {
namespace {

// The first line names program and version that define the format, the format (0: text), whether rows were
// made to add up to 1, whether emittances were worked into the factors, and the number of rows; blanks fill
// it up to 30 characters, which its readers skip.
std::string HeaderOf(std::size_t rows) {
  return fmt::format("{:<30}\n", fmt::format("View3D 3.2 0 0 0 {}", rows));
}

void AppendLine(const double* values, std::size_t count, fmt::memory_buffer* out) {
  for (std::size_t i = 0; i < count; ++i)
    fmt::format_to(std::back_inserter(*out), "{}{:.17g}", i > 0 ? " " : "", values[i]);
  out->push_back('\n');
}

class View3dMatrix : public MatrixWriter {
 public:
  std::string Bytes(const NamedMatrix& named) const override {
    const FormFactorMatrix& matrix = named.matrix;
    const std::vector<double> dense = Dense(matrix, matrix.factor);
    fmt::memory_buffer text;
    fmt::format_to(std::back_inserter(text), "{}", HeaderOf(matrix.Rows()));
    AppendLine(matrix.area.data(), matrix.Rows(), &text);
    for (std::size_t row = 0; row < matrix.Rows(); ++row)
      AppendLine(dense.data() + row * matrix.Rows(), matrix.Rows(), &text);
    AppendLine(named.absorptance.data(), named.absorptance.size(), &text);
    return fmt::to_string(text);
  }
};

}  // namespace

MatrixWriterRegistry::Method View3dMatrixMethod() {
  return {"vf", "the text of View3D: areas, dense F, and 1 - reflectance as emittances", {}, [] {
            return std::make_unique<const View3dMatrix>();
          }};
}

}  // namespace penumbra
