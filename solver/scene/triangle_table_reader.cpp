#include "solver/scene/triangle_table_reader.h"

#include <array>

#include "solver/base/read_file.h"
#include "solver/scene/polygon_soup.h"
#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

constexpr std::size_t kColumns = 11;

std::array<double, kColumns> NumbersOf(std::string_view line, const std::string& path, int number) {
  std::array<double, kColumns> values{};
  for (std::size_t column = 0; column < kColumns; ++column) {
    const std::size_t end = column + 1 < kColumns ? line.find(',') : line.size();
    const std::optional<double> value = end == line.npos ? std::nullopt : ToNumber(line.substr(0, end));
    if (!value)
      throw ErrorAt(path, number,
                    "no triangle; write nine coordinates, reflectance and emittance, with commas between");
    values[column] = *value;
    if (column + 1 < kColumns) line.remove_prefix(end + 1);
  }
  return values;
}

class TriangleTableReader final : public SceneReader {
 public:
  std::vector<std::string> Endings() const override { return {"triangles"}; }
  Scene Read(const std::string& name, const SceneOptions& options) const override {
    const std::string text = ReadFileBytes(name);
    PolygonSoup soup(name, options);
    LineReader lines(text);
    for (int number = 1; !lines.AtEnd(); ++number) {
      const std::array<double, kColumns> at = NumbersOf(lines.Take(), name, number);
      Material material;
      material.name = "table";
      material.reflectance = Rgb::Constant(at[9]);
      material.emittance = Rgb::Constant(at[10]);
      soup.Add({{at[0], at[1], at[2]}, {at[3], at[4], at[5]}, {at[6], at[7], at[8]}},
               soup.MaterialLike(material), soup.ObjectNamed("table"), number);
    }
    return soup.Finish("a table of triangles");
  }
};

}  // namespace

SceneReaderRegistry::Method TriangleTableReaderMethod() {
  return {"triangles", "a table with a triangle in each line", {}, [] {
            return std::make_unique<const TriangleTableReader>();
          }};
}

}  // namespace penumbra
