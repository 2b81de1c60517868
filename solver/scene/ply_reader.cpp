#include "solver/scene/ply_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/base/read_file.h"
#include "solver/base/size.h"
#include "solver/scene/file_format.h"
#include "solver/scene/polygon_soup.h"
#include "solver/scene/text_reader.h"
#include "solver/scene/written_digits.h"

namespace penumbra {
namespace {

enum class PlyForm { kText, kLittleEndian, kBigEndian };

struct PlyType {
  const char *name, *other_name;
  std::size_t size;
  bool is_real, is_signed;
};
constexpr auto kPlyTypes = std::to_array<PlyType>({{"char", "int8", 1, false, true},
                                                   {"uchar", "uint8", 1, false, false},
                                                   {"short", "int16", 2, false, true},
                                                   {"ushort", "uint16", 2, false, false},
                                                   {"int", "int32", 4, false, true},
                                                   {"uint", "uint32", 4, false, false},
                                                   {"float", "float32", 4, true, true},
                                                   {"double", "float64", 8, true, true}});

struct PlyProperty {
  std::string name;
  PlyType type = kPlyTypes[0];
  std::optional<PlyType> count_type;  // of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyForm form = PlyForm::kText;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  // [bytes]
};

std::vector<std::string_view> SplitWords(std::string_view line) {
  constexpr std::string_view kSpace = " \t\r";
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(kSpace); at < line.size();
       at = line.find_first_not_of(kSpace, at)) {
    const std::size_t end = std::min(line.find_first_of(kSpace, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

class PlyHeaderReader {
 public:
  PlyHeaderReader(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {}

  PlyHeader Read() {
    for (bool ended = false; !ended; ++line_) {
      if (header_.size >= bytes_.size()) throw Error("its header does not end; the file is truncated");
      const std::size_t end = std::min(bytes_.find('\n', header_.size), bytes_.size());
      const std::vector<std::string_view> words = SplitWords(bytes_.substr(header_.size, end - header_.size));
      header_.size = std::min(end + 1, bytes_.size());
      ended = !words.empty() && words[0] == "end_header";
      if (!words.empty() && line_ > 1 && !ended) Obey(words);
    }
    return std::move(header_);
  }

 private:
  InputError Error(const std::string& message) const { return ErrorAt(path_, line_, message); }

  void Obey(const std::vector<std::string_view>& words) {
    if (words[0] == "comment" || words[0] == "obj_info") return;
    if (words[0] == "format" && words.size() == 3) {
      const std::string_view form = words[1];
      if (form != "ascii" && form != "binary_little_endian" && form != "binary_big_endian")
        throw Error(Quoted(form) + " is no form of PLY files; export it anew");
      header_.form = form == "ascii"                  ? PlyForm::kText
                     : form == "binary_little_endian" ? PlyForm::kLittleEndian
                                                      : PlyForm::kBigEndian;
    } else if (words[0] == "element" && words.size() == 3) {
      const std::optional<double> count = ToNumber(words[2]);
      // Every element takes a byte or more.
      if (!count || !(*count >= 0) || *count != std::floor(*count) ||
          *count > static_cast<double>(bytes_.size()))
        throw Error(Quoted(words[2]) + " elements do not fit into the file; it is truncated or damaged");
      header_.elements.push_back({std::string(words[1]), static_cast<std::size_t>(*count), {}});
    } else if (words[0] == "property" && words.size() >= 3 && !header_.elements.empty()) {
      PlyProperty property = {std::string(words.back()), kPlyTypes[0], std::nullopt};
      const bool is_list = words[1] == "list";
      if (words.size() != (is_list ? 5U : 3U))
        throw Error("a property without a type or a name; export it anew");
      property.type = TypeOf(words[words.size() - 2]);
      if (is_list) property.count_type = TypeOf(words[2]);
      header_.elements.back().properties.push_back(std::move(property));
    } else {
      throw Error(Quoted(words[0]) + " is no line of a PLY header; export it anew");
    }
  }

  PlyType TypeOf(std::string_view name) const {
    for (const PlyType& type : kPlyTypes)
      if (name == type.name || name == type.other_name) return type;
    throw Error(Quoted(name) + " is no type of PLY files; export it anew");
  }

  std::string_view bytes_;
  const std::string& path_;
  PlyHeader header_;
  int line_ = 1;
};

// Takes one value after the other from what follows the header.
class PlyValues {
 public:
  PlyValues(std::string_view bytes, PlyForm form, const std::string& path)
      : rest_(bytes), form_(form), path_(path) {}

  double Next(const PlyType& type) { return form_ == PlyForm::kText ? NextText() : NextBinary(type); }
  // As it was written; empty in binary files.
  std::string_view Word() const { return word_; }
  // Every value takes a byte or more.
  std::size_t BytesLeft() const { return rest_.size(); }

  InputError Truncated() const {
    return ErrorAt(path_, 0, "it ends before its last element; the file is truncated, export it anew");
  }

 private:
  double NextText() {
    constexpr std::string_view kSpace = " \t\r\n";
    const std::size_t begin = rest_.find_first_not_of(kSpace);
    if (begin == rest_.npos) throw Truncated();
    const std::size_t end = std::min(rest_.find_first_of(kSpace, begin), rest_.size());
    word_ = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    const std::optional<double> value = ToNumber(word_);
    if (!value)
      throw ErrorAt(path_, 0, Quoted(word_) + " is not a number; the file is damaged, export it anew");
    return *value;
  }

  double NextBinary(const PlyType& type) {
    if (rest_.size() < type.size) throw Truncated();
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.size; ++i) {
      const std::size_t at = form_ == PlyForm::kBigEndian ? i : type.size - 1 - i;
      bits = bits << 8 | static_cast<unsigned char>(rest_[at]);
    }
    rest_.remove_prefix(type.size);
    if (type.is_real)
      return type.size == 4 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                            : std::bit_cast<double>(bits);
    const std::uint64_t sign = std::uint64_t{1} << (8 * type.size - 1);
    const double value = static_cast<double>(bits);
    return type.is_signed && (bits & sign) != 0 ? value - 2 * static_cast<double>(sign) : value;
  }

  std::string_view rest_, word_;
  PlyForm form_;
  const std::string& path_;
};

class PlyParser {
 public:
  PlyParser(std::string_view bytes, const std::string& path, const SceneOptions& options)
      : header_(PlyHeaderReader(bytes, path).Read()),
        values_(bytes.substr(header_.size), header_.form, path),
        path_(path),
        soup_(path, options) {}

  Scene Parse() {
    for (const PlyElement& element : header_.elements)
      for (std::size_t row = 0; row < element.count; ++row)
        element.name == "vertex" ? ReadVertex(element) : ReadOther(element);
    AddFaces();
    soup_.AddStep(header_.form == PlyForm::kText ? digits_.Step() : single_step_);
    WarnOfLeftOut();
    return soup_.Finish("PLY");
  }

 private:
  void ReadVertex(const PlyElement& element) {
    Vec3 vertex = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    for (const PlyProperty& property : element.properties) {
      if (property.count_type) {
        ReadList(property);
        continue;
      }
      const double value = values_.Next(property.type);
      if (property.name.size() != 1 || property.name[0] < 'x' || property.name[0] > 'z') continue;
      const int axis = property.name[0] - 'x';
      vertex[axis] = value;
      if (!std::isfinite(value)) continue;
      if (header_.form == PlyForm::kText) digits_.Add(axis, values_.Word(), value);
      if (property.type.is_real && property.type.size == 4 && value != 0)
        single_step_[axis] =
            std::max(single_step_[axis], std::exp2(std::ilogb(value)) *
                                             static_cast<double>(std::numeric_limits<float>::epsilon()));
    }
    vertices_.push_back(vertex);
  }

  std::vector<double> ReadList(const PlyProperty& property) {
    const double count = values_.Next(*property.count_type);
    if (!(count >= 0 && count <= static_cast<double>(values_.BytesLeft()))) throw values_.Truncated();
    std::vector<double> list;
    for (double i = 0; i < count; ++i) list.push_back(values_.Next(property.type));
    return list;
  }

  void ReadOther(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      if (!property.count_type) {
        values_.Next(property.type);
        continue;
      }
      std::vector<double> list = ReadList(property);
      if (element.name == "face" && (property.name == "vertex_indices" || property.name == "vertex_index"))
        faces_.push_back(std::move(list));
    }
  }

  // Vertices may follow the faces.
  void AddFaces() {
    const std::int32_t object = faces_.empty() ? 0 : soup_.ObjectNamed("default"),
                       material = faces_.empty() ? 0 : soup_.MaterialLike({"default"});
    for (const std::vector<double>& face : faces_) {
      Polygon3 polygon;
      for (const double index : face) {
        if (!(index >= 0 && index < static_cast<double>(vertices_.size()) && index == std::floor(index)))
          throw ErrorAt(
              path_, 0,
              fmt::format("a face has the vertex {}, but there are {}; the file is damaged, export it anew",
                          index, vertices_.size()));
        polygon.push_back(vertices_[static_cast<std::size_t>(index)]);
      }
      if (polygon.size() < 3)
        ++lines_and_points_;
      else
        soup_.Add(std::move(polygon), material, object, 0);
    }
  }

  void WarnOfLeftOut() {
    std::vector<std::string> left_out;
    if (lines_and_points_ > 0) left_out.push_back(Plural(lines_and_points_, "line or point", "", "s"));
    for (const PlyElement& element : header_.elements) {
      if (element.name != "vertex" && element.name != "face" && element.count > 0)
        left_out.push_back(fmt::format("the elements {}", Quoted(element.name)));
      for (const PlyProperty& property : element.properties)
        if (property.name == "red" || property.name == "diffuse_red")
          left_out.push_back(fmt::format("the colours of the elements {}", Quoted(element.name)));
    }
    if (!left_out.empty())
      soup_.warnings().push_back(WarningAt(path_, 0, fmt::format("left out: {}", fmt::join(left_out, "; "))));
  }

  PlyHeader header_;
  PlyValues values_;
  const std::string& path_;
  PolygonSoup soup_;
  std::vector<Vec3> vertices_;
  std::vector<std::vector<double>> faces_;
  WrittenDigits digits_;
  Vec3 single_step_ = Vec3::Zero();  // of coordinates in single precision
  int lines_and_points_ = 0;
};

class PlyReader final : public SceneReader {
 public:
  std::vector<std::string> Endings() const override { return {"ply"}; }
  bool RecognisesContent(const SceneSource& source) const override {
    return source.beginning.starts_with("ply\n") || source.beginning.starts_with("ply\r");
  }
  Scene Read(const std::string& name, const SceneOptions& options) const override {
    try {
      return ReadPly(ReadFileBytes(name), name, options);
    } catch (const ReadFailure& failure) {
      throw ErrorAt(name, 0, std::string(failure.what()) + "; give a PLY file that can be read");
    }
  }
};

}  // namespace

Scene ReadPly(std::string_view bytes, const std::string& path, const SceneOptions& options) {
  if (!bytes.starts_with("ply")) {
    RefuseForeignFormat(bytes, path, "a PLY file");
    throw ErrorAt(path, 0, "it does not begin with 'ply'; give a PLY file");
  }
  return PlyParser(bytes, path, options).Parse();
}

SceneReaderRegistry::Method PlyReaderMethod() {
  return {"ply", "PLY, in text or binary form", {}, [] { return std::make_unique<const PlyReader>(); }};
}

}  // namespace penumbra
