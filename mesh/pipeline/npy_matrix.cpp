// NumPy's format is a line of text before the bytes of the array; no library of Debian's writes it from C++.

#include "mesh/pipeline/npy_matrix.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

namespace penumbra {
namespace {

// NumPy's format, version 1.0 (NEP 1): a magic word, the length of the header, and the header, a Python
// dictionary that blanks fill up to a multiple of 64 bytes.
std::string NpyHeader(std::size_t rows) {
  constexpr std::size_t kAlignment = 64, kBefore = 10;
  std::string dictionary =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({0}, {0}), }}", rows);
  dictionary.append(kAlignment - (kBefore + dictionary.size() + 1) % kAlignment, ' ');
  dictionary += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(dictionary.size() & 0xff);
  header += static_cast<char>(dictionary.size() >> 8);
  return header + dictionary;
}

class NpyMatrix : public MatrixWriter {
 public:
  std::string Bytes(const NamedMatrix& named) const override {
    static_assert(std::endian::native == std::endian::little);
    const std::vector<double> dense = Dense(named.matrix, named.matrix.factor);
    std::string bytes = NpyHeader(named.matrix.Rows());
    const std::size_t begin = bytes.size();
    bytes.resize(begin + dense.size() * sizeof(double));
    if (!dense.empty()) std::memcpy(bytes.data() + begin, dense.data(), dense.size() * sizeof(double));
    return bytes;
  }
};

}  // namespace

MatrixWriterRegistry::Method NpyMatrixMethod() {
  return {
      "npy", "NumPy: F as a dense array of doubles", {}, [] { return std::make_unique<const NpyMatrix>(); }};
}

}  // namespace penumbra
