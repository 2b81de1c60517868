#include "mesh/pipeline/csv_matrix.h"

#include <fmt/format.h>

#include <iterator>

namespace penumbra {
namespace {

// A field of CSV (RFC 4180): in quotation marks where it holds what separates fields.
std::string CsvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + "\"";
}

class CsvMatrix : public MatrixWriter {
 public:
  bool IsDense() const override { return false; }

  std::string Bytes(const NamedMatrix& named) const override {
    const FormFactorMatrix& matrix = named.matrix;
    fmt::memory_buffer csv;
    fmt::format_to(std::back_inserter(csv), "from,to,F,error\n");
    for (std::size_t row = 0; row < matrix.Rows(); ++row)
      for (std::size_t k = matrix.first[row]; k < matrix.first[row + 1]; ++k)
        fmt::format_to(std::back_inserter(csv), "{},{},{:.17g},{:.17g}\n", CsvField(named.names[row]),
                       CsvField(named.names[static_cast<std::size_t>(matrix.column[k])]), matrix.factor[k],
                       matrix.error[k]);
    return fmt::to_string(csv);
  }
};

}  // namespace

MatrixWriterRegistry::Method CsvMatrixMethod() {
  return {"csv", "a row from,to,F,error for each factor that is not 0", {}, [] {
            return std::make_unique<const CsvMatrix>();
          }};
}

}  // namespace penumbra
