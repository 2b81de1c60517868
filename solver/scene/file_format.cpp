#include "solver/scene/file_format.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace penumbra {
namespace {

using std::string_view_literals::operator""sv;

struct Beginning {
  std::string_view bytes;
  ForeignFormat format;
  std::size_t at = 0;  // where they stand
};

constexpr FormatKind kScene = FormatKind::kScene, kPacked = FormatKind::kPacked,
                     kEncoding = FormatKind::kEncoding, kOther = FormatKind::kOther;

// The longer of two that begin alike comes first.
constexpr auto kBeginnings = std::to_array<Beginning>({
    {"BLENDER"sv, {kScene, "a Blender file"}},
    {"glTF"sv, {kScene, "a glTF file (GLB)"}},
    {"ply\n"sv, {kScene, "a PLY file"}},
    {"ply\r"sv, {kScene, "a PLY file"}},
    {"Kaydara FBX Binary"sv, {kScene, "an FBX file"}},
    {"; FBX"sv, {kScene, "an FBX file"}},
    {"solid "sv, {kScene, "an STL file"}},
    {"#VRML"sv, {kScene, "a VRML file"}},
    {"#usda"sv, {kScene, "a USD file"}},
    {"PXR-USDC"sv, {kScene, "a USD file"}},
    {"Ogawa"sv, {kScene, "an Alembic file"}},
    {"AC10"sv, {kScene, "a DWG drawing"}},
    {"AutoCAD Binary DXF"sv, {kScene, "a DXF drawing"}},
    {"ISO-10303-21"sv, {kScene, "a STEP file"}},
    {"3D Geometry File Format"sv, {kScene, "a Rhino file (3DM)"}},
    {"\xff\xfe\xff\x0eS\0k\0e\0t\0c\0h\0U\0p\0"sv, {kScene, "a SketchUp file"}},
    {"//Maya ASCII"sv, {kScene, "a Maya file"}},
    {"FOR4"sv, {kScene, "a Maya file"}},
    {"FOR8"sv, {kScene, "a Maya file"}},
    {"LWO2"sv, {kScene, "a LightWave file"}, 8},
    {"LWOB"sv, {kScene, "a LightWave file"}, 8},
    {"xof "sv, {kScene, "a DirectX file"}},
    {"AC3D"sv, {kScene, "an AC3D file"}},
    {"OFF\n"sv, {kScene, "an OFF file"}},
    {"OFF\r"sv, {kScene, "an OFF file"}},
    {"C4DC4D6"sv, {kScene, "a Cinema 4D file"}, 8},
    {"PK\x03\x04"sv, {kPacked, "a ZIP archive"}},
    {"PK\x05\x06"sv, {kPacked, "a ZIP archive"}},
    {"\x1f\x8b"sv, {kPacked, "a gzip file"}},
    {"BZh"sv, {kPacked, "a bzip2 file"}},
    {"\xfd"
     "7zXZ\0"sv,
     {kPacked, "an xz file"}},
    {"7z\xbc\xaf\x27\x1c"sv, {kPacked, "a 7z archive"}},
    {"Rar!\x1a\x07"sv, {kPacked, "a RAR archive"}},
    {"\x28\xb5\x2f\xfd"sv, {kPacked, "a Zstandard file (as newer Blender files are)"}},
    {"ustar"sv, {kPacked, "a tar archive"}, 257},
    {"\x89Penumbra solution"sv, {FormatKind::kSolution, "a solution of penumbra"}},
    {"\x89HDF\r\n\x1a\n"sv, {FormatKind::kHdf5, "an HDF5 file"}},
    {"\x89PNG"sv, {kOther, "a PNG image"}},
    {"\xff\xd8\xff"sv, {kOther, "a JPEG image"}},
    {"GIF8"sv, {kOther, "a GIF image"}},
    {"II*\0"sv, {kOther, "a TIFF image"}},
    {"MM\0*"sv, {kOther, "a TIFF image"}},
    {"\x76\x2f\x31\x01"sv, {kOther, "an OpenEXR image"}},
    {"#?RADIANCE"sv, {kOther, "a Radiance picture"}},
    {"DDS "sv, {kOther, "a DDS texture"}},
    {"%PDF"sv, {kOther, "a PDF document"}},
    {"\x7f"
     "ELF"sv,
     {kOther, "a program"}},
    {"version https://git-lfs"sv, {kOther, "a pointer of Git LFS, whose content was not fetched"}},
    {"SQLite format 3"sv, {kOther, "an SQLite database"}},
    {"\xff\xfe\0\0"sv, {kEncoding, "UTF-32"}},
    {"\0\0\xfe\xff"sv, {kEncoding, "UTF-32"}},
    {"\xff\xfe"sv, {kEncoding, "UTF-16"}},
    {"\xfe\xff"sv, {kEncoding, "UTF-16"}},
});

bool StartsAt(std::string_view text, std::size_t at, std::string_view part) {
  return text.size() >= at + part.size() && text.substr(at, part.size()) == part;
}

// The bytes as a little-endian number of 32 bits.
std::uint32_t Uint32At(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// 3D Studio: a chunk 0x4D4D with its length, and in it a chunk of the version or of the editor.
bool Is3ds(std::string_view bytes) {
  return bytes.size() >= 12 && bytes.starts_with("MM") && Uint32At(bytes, 2) >= 12 &&
         (StartsAt(bytes, 6, "\x02\0"sv) || StartsAt(bytes, 6, "\x3d\x3d"sv));
}

// A header of 80 bytes, the number of triangles, and 50 bytes a triangle, of which two are mostly zero.
bool IsBinaryStl(std::string_view bytes) {
  constexpr std::size_t kHeader = 84, kTriangle = 50;
  return bytes.size() >= kHeader + kTriangle && bytes.substr(0, kHeader).find('\0') != bytes.npos &&
         Uint32At(bytes, 80) > 0 && Uint32At(bytes, 80) < 1U << 28 &&
         StartsAt(bytes, kHeader + kTriangle - 2, "\0\0"sv) &&
         (bytes.size() < kHeader + 2 * kTriangle || StartsAt(bytes, kHeader + 2 * kTriangle - 2, "\0\0"sv));
}

// A text of two bytes a character without a mark: every second byte of the beginning is zero, no other is.
bool IsWideText(std::string_view bytes) {
  constexpr std::size_t kLook = 16;
  if (bytes.size() < kLook) return false;
  std::array<int, 2> zeros{};
  for (std::size_t i = 0; i < kLook; ++i) zeros[i % 2] += bytes[i] == '\0' ? 1 : 0;
  constexpr int kAll = kLook / 2;
  return (zeros[0] == kAll && zeros[1] == 0) || (zeros[1] == kAll && zeros[0] == 0);
}

// Formats of marks and braces, and others that a blank may stand before.
std::optional<ForeignFormat> FindTextFormat(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == text.npos) return std::nullopt;
  text.remove_prefix(first);
  if (text.starts_with("<")) {
    if (text.find("<COLLADA") != text.npos) return ForeignFormat{kScene, "a COLLADA file"};
    if (text.find("<X3D") != text.npos) return ForeignFormat{kScene, "an X3D file"};
    if (text.starts_with("<?xml")) return ForeignFormat{kScene, "an XML file"};
    if (text.find("<html") != text.npos || text.find("<HTML") != text.npos || text.starts_with("<!DOCTYPE") ||
        text.starts_with("<!doctype"))
      return ForeignFormat{kOther, "a web page (HTML)"};
  }
  if (text.starts_with("{")) {
    const bool gltf = text.find("\"asset\"") != text.npos || text.find("\"accessors\"") != text.npos;
    return gltf ? ForeignFormat{kScene, "a glTF file"} : ForeignFormat{kOther, "a JSON file"};
  }
  if (text.starts_with("0") && text.find("SECTION") < 20) return ForeignFormat{kScene, "a DXF drawing"};
  return std::nullopt;
}

}  // namespace

std::optional<ForeignFormat> FindForeignFormat(std::string_view beginning) {
  beginning = beginning.substr(0, kFormatBytes);
  for (const Beginning& known : kBeginnings)
    if (StartsAt(beginning, known.at, known.bytes)) return known.format;
  if (Is3ds(beginning)) return ForeignFormat{kScene, "a 3D Studio file (3DS)"};
  if (IsWideText(beginning)) return ForeignFormat{kEncoding, "UTF-16"};
  if (IsBinaryStl(beginning)) return ForeignFormat{kScene, "an STL file"};
  return FindTextFormat(beginning);
}

std::string ForeignFormatMessage(const ForeignFormat& format, std::string_view wanted) {
  const std::string name(format.name), file(wanted);
  switch (format.kind) {
    case FormatKind::kScene:
      return "this is " + name + (wanted == "an OBJ file" ? "; export OBJ, and give that" : "; give " + file);
    case FormatKind::kPacked:
      return "this is " + name + "; unpack it, and give " + file;
    case FormatKind::kEncoding:
      return "the text is " + name + "; save it as UTF-8 or ASCII";
    default:
      return "this is " + name + "; give " + file;
  }
}

}  // namespace penumbra
