#include "solver/scene/building.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <span>

#include "solver/base/check.h"
#include "solver/base/random.h"

namespace penumbra {
namespace {

constexpr std::string_view kPrefix = "building-";
constexpr const char* kLibrary = "building.mtl";

// [m]
constexpr double kWidth = 4, kDepth = 5, kHeight = 2.7, kWall = 0.2;
constexpr double kDoorWidth = 0.9, kDoorHeight = 2.1;

// Streams of random numbers: of a room's furniture, of the doorways east and north of it.
enum Stream : std::uint64_t { kFurniture, kEast, kNorth };

constexpr const char* kMaterials =
    "# Kd: reflectance; Ke: emittance in W/m^2.\n"
    "newmtl floor\nKd 0.45 0.36 0.28\n\n"
    "newmtl ceiling\nKd 0.8 0.79 0.77\n\n"
    "newmtl wall_0\nKd 0.72 0.66 0.55\n\n"
    "newmtl wall_1\nKd 0.55 0.65 0.7\n\n"
    "newmtl wall_2\nKd 0.7 0.55 0.5\n\n"
    "newmtl wall_3\nKd 0.58 0.68 0.52\n\n"
    "newmtl doorway\nKd 0.6 0.58 0.55\n\n"
    "newmtl wood\nKd 0.5 0.31 0.16\n\n"
    "newmtl cloth\nKd 0.45 0.14 0.1\n\n"
    "newmtl paint\nKd 0.25 0.4 0.45\n\n"
    "newmtl lamp_case\nKd 0.5 0.5 0.5\n\n"
    "newmtl light_0\nKd 0.6 0.6 0.6\nKe 200 185 160\n\n"
    "newmtl light_1\nKd 0.6 0.6 0.6\nKe 170 170 165\n\n"
    "newmtl light_2\nKd 0.6 0.6 0.6\nKe 130 115 90\n\n";

// Writes faces, each with vertices of its own.
class ObjText {
 public:
  ObjText() { text_ = std::string("mtllib ") + kLibrary + "\n"; }

  void Object(const std::string& name) { text_ += "o " + name + "\n"; }
  void Material(const std::string& name) { text_ += "usemtl " + name + "\n"; }

  void Face(std::span<const Vec3> polygon) {
    for (const Vec3& v : polygon) {
      text_ += 'v';
      for (int axis = 0; axis < 3; ++axis) Number(v[axis]);
      text_ += '\n';
    }
    text_ += 'f';
    for (std::size_t i = 0; i < polygon.size(); ++i) text_ += ' ' + std::to_string(++vertices_);
    text_ += '\n';
  }

  std::string Take() { return std::move(text_); }

 private:
  // The shortest text that reads back to the same bits.
  void Number(double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    text_ += ' ';
    text_.append(digits.data(), end);
  }

  std::string text_;
  long vertices_ = 0;
};

// An upright box: half extents along its own axes, which are turned by `turn` about the vertical through
// (x, y).
struct Box {
  double x = 0, y = 0, half_x = 0, half_y = 0, low = 0, high = 0, turn = 0;

  // Corner i: bits 0, 1, 2 choose the sides along x, y, z.
  Vec3 Corner(int i) const {
    const double u = i & 1 ? half_x : -half_x, v = i & 2 ? half_y : -half_y;
    const double c = std::cos(turn), s = std::sin(turn);
    return {x + c * u - s * v, y + s * u + c * v, i & 4 ? high : low};
  }
};

// The faces of a box, looking outwards: below, above, then front, back, left, right.
constexpr std::array<std::array<int, 4>, 6> kBoxFaces = {
    {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};

void WriteBoxFace(ObjText& out, const Box& box, int face) {
  std::array<Vec3, 4> polygon;
  for (std::size_t k = 0; k < 4; ++k) polygon[k] = box.Corner(kBoxFaces[static_cast<std::size_t>(face)][k]);
  out.Face(polygon);
}

void WriteBox(ObjText& out, const Box& box) {
  for (int face = 0; face < 6; ++face) WriteBoxFace(out, box, face);
}

// A place for one piece of furniture and how it is turned.
struct Place {
  double x = 0, y = 0, turn = 0;

  // A box whose middle lies at (u, v) from the place, along the turned axes.
  Box At(double u, double v, double half_x, double half_y, double low, double high) const {
    const double c = std::cos(turn), s = std::sin(turn);
    return {x + c * u - s * v, y + s * u + c * v, half_x, half_y, low, high, turn};
  }
};

// All pieces stay within 0.75 m of their place, and stand on the floor or on each other without gaps.
void WriteTable(ObjText& out, Random& random, const Place& place) {
  const double top = random.Uniform(0.68, 0.78), half_x = random.Uniform(0.5, 0.62), half_y = 0.36;
  out.Material("wood");
  WriteBox(out, place.At(0, 0, half_x, half_y, top - 0.04, top));
  for (const double side : {-1.0, 1.0})
    WriteBox(out, place.At(side * (half_x - 0.08), 0, 0.02, half_y - 0.05, 0, top - 0.04));
}

void WriteChair(ObjText& out, Random& random, const Place& place) {
  const double seat = random.Uniform(0.4, 0.48), half = random.Uniform(0.22, 0.26);
  const double back = random.Uniform(0.85, 1.0);
  out.Material("cloth");
  WriteBox(out, place.At(0, 0, half, half, 0, seat));
  WriteBox(out, place.At(0, half - 0.05, half - 0.02, 0.03, seat, back));
}

void WriteCupboard(ObjText& out, Random& random, const Place& place) {
  const double top = random.Uniform(0.8, 1.3), half_x = random.Uniform(0.4, 0.55);
  const double half_y = random.Uniform(0.2, 0.3), at = random.Uniform(-0.2, 0.2);
  const double half = random.Uniform(0.1, 0.18), height = random.Uniform(0.15, 0.4);
  out.Material("paint");
  WriteBox(out, place.At(0, 0, half_x, half_y, 0, top));
  WriteBox(out, place.At(at, 0, half, 0.12, top, top + height));
}

class Building {
 public:
  explicit Building(const BuildingSize& size) : size_(size) {}

  std::string Write() {
    for (int row = 0; row < size_.rows; ++row)
      for (int column = 0; column < size_.columns; ++column) {
        WriteShell(row, column);
        WriteFurniture(row, column);
        if (column + 1 < size_.columns) WriteDoorway(row, column, true);
        if (row + 1 < size_.rows) WriteDoorway(row, column, false);
      }
    return out_.Take();
  }

 private:
  static double West(int column) { return column * (kWidth + kWall); }
  static double South(int row) { return row * (kDepth + kWall); }

  static Random Numbers(int row, int column, Stream stream) {
    return Random(static_cast<std::uint64_t>(row * kMostRooms + column), stream);
  }
  static std::string Name(const char* what, int row, int column) {
    return std::string(what) + "-" + std::to_string(row + 1) + "-" + std::to_string(column + 1);
  }

  // Where the doorway in the wall east or north of a room begins, along the wall.
  static double DoorFrom(int row, int column, bool east) {
    Random random = Numbers(row, column, east ? kEast : kNorth);
    const double length = east ? kDepth : kWidth;
    return (east ? South(row) : West(column)) + length * random.Uniform(0.3, 0.7) - kDoorWidth / 2;
  }

  // A wall between two corners of the floor, which lie left and right as seen from inside; around a doorway
  // that begins at `door` along the wall's axis if there is one.
  void WriteWall(const Vec3& left, const Vec3& right, const std::optional<double>& door) {
    const Vec3 up(0, 0, kHeight);
    Polygon3 wall = {left};
    if (door) {
      const int axis = left.x() != right.x() ? 0 : 1;
      Vec3 from = left, to = left;
      from[axis] = *door;
      to[axis] = *door + kDoorWidth;
      if (left[axis] > right[axis]) std::swap(from, to);
      const Vec3 lintel(0, 0, kDoorHeight);
      wall.insert(wall.end(), {from, from + lintel, to + lintel, to});
    }
    wall.insert(wall.end(), {right, right + up, left + up});
    out_.Face(wall);
  }

  void WriteShell(int row, int column) {
    const double x0 = West(column), x1 = x0 + kWidth, y0 = South(row), y1 = y0 + kDepth;
    const Vec3 sw(x0, y0, 0), se(x1, y0, 0), nw(x0, y1, 0), ne(x1, y1, 0), up(0, 0, kHeight);
    out_.Object(Name("room", row, column));
    out_.Material("floor");
    out_.Face(Polygon3{sw, se, ne, nw});
    out_.Material("ceiling");
    out_.Face(Polygon3{nw + up, ne + up, se + up, sw + up});
    out_.Material("wall_" + std::to_string(Numbers(row, column, kFurniture).Index(4)));
    const auto door = [&](bool there, int r, int c, bool east) {
      return there ? std::optional<double>(DoorFrom(r, c, east)) : std::nullopt;
    };
    WriteWall(nw, ne, door(row + 1 < size_.rows, row, column, false));
    WriteWall(ne, se, door(column + 1 < size_.columns, row, column, true));
    WriteWall(se, sw, door(row > 0, row - 1, column, false));
    WriteWall(sw, nw, door(column > 0, row, column - 1, true));
  }

  // Floor, lintel and jambs: the sides of a box that is open towards both rooms, seen from inside.
  void WriteDoorway(int row, int column, bool east) {
    const double from = DoorFrom(row, column, east);
    const Vec3 low = east ? Vec3(West(column) + kWidth, from, 0) : Vec3(from, South(row) + kDepth, 0);
    const Vec3 high = east ? Vec3(West(column + 1), from + kDoorWidth, kDoorHeight)
                           : Vec3(from + kDoorWidth, South(row + 1), kDoorHeight);
    out_.Object(Name(east ? "door-east" : "door-north", row, column));
    out_.Material("doorway");
    for (std::size_t face = 0; face < 6; ++face) {
      const bool open = east ? face >= 4 : face == 2 || face == 3;
      if (open) continue;
      Polygon3 polygon;
      for (const int i : kBoxFaces[face])
        polygon.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                             i & 4 ? high.z() : low.z());
      std::reverse(polygon.begin(), polygon.end());
      out_.Face(polygon);
    }
  }

  void WriteFurniture(int row, int column) {
    Random random = Numbers(row, column, kFurniture);
    random.Index(4);  // the colour of the walls
    const double x = West(column), y = South(row);
    // A quarter of the floor each, one stays empty.
    std::array<int, 4> quarters = {0, 1, 2, 3};
    for (std::uint32_t i = 3; i > 0; --i) std::swap(quarters[i], quarters[random.Index(i + 1)]);
    const auto place = [&](int quarter) {
      return Place{x + kWidth * (quarter & 1 ? 0.75 : 0.25) + random.Uniform(-0.2, 0.2),
                   y + kDepth * (quarter & 2 ? 0.75 : 0.25) + random.Uniform(-0.4, 0.4),
                   random.Uniform(0, 2 * std::numbers::pi)};
    };
    out_.Object(Name("table", row, column));
    WriteTable(out_, random, place(quarters[0]));
    out_.Object(Name("chair", row, column));
    WriteChair(out_, random, place(quarters[1]));
    out_.Object(Name("cupboard", row, column));
    WriteCupboard(out_, random, place(quarters[2]));

    const Box lamp{x + kWidth / 2 + random.Uniform(-0.4, 0.4),
                   y + kDepth / 2 + random.Uniform(-0.8, 0.8),
                   random.Uniform(0.3, 0.6),
                   random.Uniform(0.15, 0.3),
                   kHeight - 0.08,
                   kHeight,
                   0};
    out_.Object(Name("lamp", row, column));
    out_.Material("light_" + std::to_string(random.Index(3)));
    WriteBoxFace(out_, lamp, 0);
    out_.Material("lamp_case");
    for (int face = 1; face < 6; ++face) WriteBoxFace(out_, lamp, face);
  }

  BuildingSize size_;
  ObjText out_;
};

}  // namespace

std::optional<BuildingSize> BuildingNamed(std::string_view name) {
  if (!name.starts_with(kPrefix)) return std::nullopt;
  const std::string_view numbers = name.substr(kPrefix.size());
  const char* const end = numbers.data() + numbers.size();
  BuildingSize size;
  const auto rows = std::from_chars(numbers.data(), end, size.rows);
  const bool has_x = rows.ec == std::errc() && rows.ptr != end && *rows.ptr == 'x';
  const auto columns = has_x ? std::from_chars(rows.ptr + 1, end, size.columns) : rows;
  const auto sensible = [](int n) { return n >= 1 && n <= kMostRooms; };
  if (!has_x || columns.ec != std::errc() || columns.ptr != end || !sensible(size.rows) ||
      !sensible(size.columns))
    throw InputError(std::string(name) +
                     ": error: a building is named building-RxC, R and C whole numbers from 1 to " +
                     std::to_string(kMostRooms) + ", such as building-2x3");
  return size;
}

std::string BuildingObj(const BuildingSize& size) { return Building(size).Write(); }

std::string BuildingMtl() { return kMaterials; }

std::vector<Camera> BuildingCameras(const BuildingSize& size) {
  const double width = size.columns * (kWidth + kWall) - kWall, depth = size.rows * (kDepth + kWall) - kWall;
  const Vec3 middle(width / 2, depth / 2, 0);
  return {{"room", {0.3, 0.3, 2.2}, {2.6, 3.4, 0.6}, Vec3::UnitZ(), 60},
          {"corner", {3.7, 4.7, 1.6}, {1.2, 1.2, 0.8}, Vec3::UnitZ(), 60},
          {"above", middle + Vec3(0, -depth, 1.6 * std::max(width, depth)), middle, Vec3::UnitZ(), 45}};
}

}  // namespace penumbra
