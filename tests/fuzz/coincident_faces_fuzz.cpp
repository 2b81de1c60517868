// Faces that coincide: to the last bit, nearly, turned, rounded to some decimals, in strips, as slivers. Of
// each set, as an OBJ file, patches are made: all of them finite, and each place of a plane covered once. Of
// some a closed room is made in which every surface reflects 1/2 and emits 1/2, so that irradiance is 1
// everywhere.
//
//   coincident_faces_fuzz [RUNS=1000 [SEED=1 [FIRST=0]]]
//
// Where a run crashes, takes longer than kLongestRun, or is wrong, its number is told: PROGRAM 1 SEED NUMBER
// repeats it.

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <string>

#include "mesh/pipeline/pipeline.h"
#include "solver/base/check.h"
#include "solver/base/random.h"
#include "solver/geometry/orientation.h"
#include "solver/geometry/plane_projection.h"
#include "solver/scene/obj_reader.h"
#include "solver/scene/plane_overlaps.h"
#include "solver/transport/points/point_irradiance.h"
#include "tests/fuzz/fuzz_loop.h"

namespace penumbra {
namespace {

constexpr std::uint32_t kRunsARoom = 400;

using fuzz::Fail;

std::uint32_t Roll(Random& random, std::initializer_list<std::uint32_t> choices) {
  return choices.begin()[random.Index(static_cast<std::uint32_t>(choices.size()))];
}

// A plane in space, and how the coordinates of what lies in it are written.
struct Setting {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 shift = Vec3::Zero();
  double scale = 1;
  int decimals = -1;  // -1: 17 significant digits

  Vec3 At(const Vec2& p) const { return turn * Vec3(scale * p.x(), scale * p.y(), 0) + shift; }
};

Setting RandomSetting(Random& random) {
  Setting setting;
  if (random.Index(3) > 0)
    setting.turn = Eigen::Quaterniond(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1),
                                      random.Uniform(0.1, 1))
                       .normalized()
                       .toRotationMatrix();
  setting.scale = random.Index(4) == 0 ? random.LogUniform(1e-3, 1e3) : random.Uniform(1, 5);
  if (random.Index(2) == 0)
    setting.shift = setting.scale * Vec3(random.Uniform(-3, 3), random.Uniform(-3, 3), random.Uniform(-3, 3));
  if (random.Index(8) == 0) setting.shift += Vec3(4.5e5, 5.2e6, 300);
  if (random.Index(2) == 0) setting.decimals = 3 + static_cast<int>(random.Index(10));
  return setting;
}

using Flat = std::vector<Vec2>;

Flat RandomShape(Random& random) {
  const auto on_grid = [&] { return 0.25 * random.Index(17); };
  switch (random.Index(5)) {
    case 0: {
      const double x = on_grid(), y = on_grid(), w = 0.25 + on_grid(), h = 0.25 + on_grid();
      return {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
    }
    case 1: {  // an L
      const double x = random.Uniform(0, 2), y = random.Uniform(0, 2);
      return {{x, y}, {x + 2, y}, {x + 2, y + 1}, {x + 1, y + 1}, {x + 1, y + 2}, {x, y + 2}};
    }
    case 2: {  // a sliver
      const double x = random.Uniform(0, 3), y = random.Uniform(0, 3), w = random.LogUniform(1e-16, 1e-3);
      return {{x, y}, {x + 1, y}, {x + 1, y + w}, {x, y + w}};
    }
    case 3: {  // a star
      Flat star;
      const std::uint32_t n = 5 + random.Index(8);
      for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * (i + 0.8 * random.Uniform()) / n,
                     r = random.Uniform(0.3, 2);
        star.emplace_back(2 + r * std::cos(angle), 2 + r * std::sin(angle));
      }
      return star;
    }
    default: {
      Flat triangle;
      for (int i = 0; i < 3; ++i) triangle.emplace_back(random.Uniform(0, 4), random.Uniform(0, 4));
      if (SignedArea(triangle) < 0) std::swap(triangle[1], triangle[2]);
      return triangle;
    }
  }
}

// The shape again: itself, begun elsewhere, moved by next to nothing, widened, as a strip of it.
Flat Again(Flat shape, Random& random) {
  const double little = random.LogUniform(1e-16, 1e-3);
  std::rotate(shape.begin(), shape.begin() + random.Index(static_cast<std::uint32_t>(shape.size())),
              shape.end());
  switch (random.Index(5)) {
    case 0:
      for (Vec2& p : shape) p += little * Vec2(random.Uniform(-1, 1), random.Uniform(-1, 1));
      break;
    case 1:
      shape[0] += little * (shape[0] - shape[1]);
      break;
    case 2: {
      // Between two lines through its sides, as far as it is convex there.
      const double s = random.Uniform(), t = random.Uniform();
      if (shape.size() == 4)
        shape = {shape[0] + s * (shape[1] - shape[0]), shape[1], shape[2],
                 shape[3] + s * (shape[2] - shape[3])};
      else if (shape.size() == 3)
        shape = {shape[0], shape[0] + s * (shape[1] - shape[0]), shape[0] + t * (shape[2] - shape[0])};
      break;
    }
    case 3: {
      const double angle = little;
      const Vec2 centre = shape[0];
      for (Vec2& p : shape) {
        const Vec2 d = p - centre;
        p = centre + Vec2(std::cos(angle) * d.x() - std::sin(angle) * d.y(),
                          std::sin(angle) * d.x() + std::cos(angle) * d.y());
      }
      break;
    }
    default:
      break;
  }
  return shape;
}

class Text {
 public:
  explicit Text(const Setting& setting) : setting_(setting) { text_ = "mtllib m.mtl\n"; }

  void Material(std::string_view name) { text_ += "usemtl " + std::string(name) + "\n"; }

  // `noise`: how far each coordinate is off, relative to the scale.
  void Face(std::span<const Vec3> polygon, double noise, Random& random) {
    for (const Vec3& v : polygon) {
      text_ += "v";
      for (int axis = 0; axis < 3; ++axis) {
        std::array<char, 400> number{};
        const double x = v[axis] + noise * setting_.scale * random.Uniform(-1, 1);
        if (setting_.decimals >= 0)
          std::snprintf(number.data(), number.size(), " %.*f", setting_.decimals, x);
        else
          std::snprintf(number.data(), number.size(), " %.17g", x);
        text_ += number.data();
      }
      text_ += "\n";
    }
    text_ += "f";
    for (std::size_t i = polygon.size(); i > 0; --i) text_ += " -" + std::to_string(i);
    text_ += "\n";
  }

  // Nothing if the reader refuses it.
  std::optional<Scene> Read(bool two_sided) const {
    SceneOptions options;
    options.two_sided = two_sided;
    const MtlSource library = [](std::string_view) {
      return std::optional<std::string>("newmtl grey\nKd .5 .5 .5\nnewmtl glow\nKd .5 .5 .5\nKe .5 .5 .5\n");
    };
    try {
      return ReadObjText(text_, "scene.obj", library, options);
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

  const std::string& text() const { return text_; }

 private:
  const Setting& setting_;
  std::string text_;
};

void CheckPatches(const Scene& scene) {
  for (const Patch& patch : scene.patches) {
    if (!(patch.area > 0) || !std::isfinite(patch.area)) Fail("a patch has no area");
    if (!(std::abs(patch.normal.norm() - 1) < 1e-9)) Fail("a patch has no normal");
    for (const Vec3& v : patch.Vertices())
      if (!v.allFinite()) Fail("a patch has no place");
  }
}

// +1 inside, -1 outside, 0 within `margin` of the border.
int Side(std::span<const Vec2> polygon, const Vec2& p, double margin) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Vec2 along = b - a;
    const double t =
        along.squaredNorm() > 0 ? std::clamp(along.dot(p - a) / along.squaredNorm(), 0.0, 1.0) : 0;
    if ((a + t * along - p).norm() <= margin) return 0;
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / along.y() * along.x())
      inside = !inside;
  }
  return inside ? 1 : -1;
}

// Away from all borders each place of the plane lies on one patch if it lies on a face, else on none.
void CheckCover(const Scene& scene, const Setting& setting, double margin, Random& random) {
  const auto flat = [&](std::span<const Vec3> polygon) {
    Flat points;
    for (const Vec3& v : polygon) {
      const Vec3 back = setting.turn.transpose() * (v - setting.shift);
      points.emplace_back(back.x(), back.y());
    }
    return points;
  };
  std::vector<Flat> faces, patches;
  for (const Face& face : scene.faces)
    if (!face.vertices.empty()) faces.push_back(flat(face.vertices));
  for (const Patch& patch : scene.patches) patches.push_back(flat(patch.Vertices()));
  constexpr int kPlaces = 60;
  for (int place = 0; place < kPlaces; ++place) {
    const Vec2 p = setting.scale * Vec2(random.Uniform(-1, 7), random.Uniform(-1, 7));
    bool near = false;
    int on_faces = 0, on_patches = 0;
    for (const Flat& face : faces) {
      const int side = Side(face, p, margin);
      near = near || side == 0;
      on_faces += side > 0;
    }
    if (near) continue;
    for (const Flat& patch : patches) {
      const int side = Side(patch, p, 1e-12 * setting.scale);
      near = near || side == 0;
      on_patches += side > 0;
    }
    if (!near && on_patches != (on_faces > 0 ? 1 : 0))
      Fail("a place that lies on " + std::to_string(on_faces) + " faces lies on " +
           std::to_string(on_patches) + " patches");
  }
}

void RunPlane(Random& random) {
  const Setting setting = RandomSetting(random);
  Text text(setting);
  const bool one_plane = random.Index(2) == 0;
  const std::uint32_t pairs = Roll(random, {1, 1, 1, 8, 18});
  for (std::uint32_t pair = 0; pair < pairs; ++pair) {
    const Flat shape = RandomShape(random);
    for (const Flat& flat : {shape, Again(shape, random)}) {
      std::vector<Vec3> polygon;
      for (const Vec2& p : flat) polygon.push_back(setting.At(p));
      if (!one_plane && random.Index(8) == 0) std::reverse(polygon.begin(), polygon.end());
      text.Material(random.Index(3) == 0 ? "glow" : "grey");
      const bool off = !one_plane && random.Index(2) == 0;
      text.Face(polygon, off ? random.LogUniform(1e-17, polygon.size() == 3 ? 1e-3 : 1e-7) : 0, random);
    }
  }
  const std::optional<Scene> scene = text.Read(!one_plane && random.Index(4) == 0);
  if (!scene) return;
  CheckPatches(*scene);
  // What is written too coarsely for the size of the shapes may be anything.
  const double step = setting.decimals >= 0 ? std::pow(10, -setting.decimals) : 1e-15 * setting.shift.norm();
  const double margin = 4 * step + 1e-8 * setting.scale;
  const bool coarse = setting.decimals >= 0 && step > 0.2 * kCoarsestPlane * setting.scale;
  if (one_plane && !coarse) CheckCover(*scene, setting, margin, random);
}

const Vec3 kRoomSize(4, 3, 2.5);

// A wall of the room, and often a part of it once more.
void AddRoomWall(int wall, const Setting& setting, Text& text, Random& random) {
  const int axis = wall / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto corner = [&](double s, double t) {
    Vec3 p;
    p[axis] = wall % 2 ? kRoomSize[axis] : 0;
    p[u] = s * kRoomSize[u];
    p[v] = t * kRoomSize[v];
    return Vec3(setting.turn * p + setting.shift);
  };
  const auto rectangle = [&](double s0, double t0, double s1, double t1, double noise) {
    std::vector<Vec3> face = {corner(s0, t0), corner(s1, t0), corner(s1, t1), corner(s0, t1)};
    if (wall % 2) std::reverse(face.begin(), face.end());
    text.Face(face, noise, random);
  };
  rectangle(0, 0, 1, 1, 0);
  const double little = random.LogUniform(1e-16, 1e-6);
  switch (random.Index(6)) {
    case 0:
      rectangle(0, 0, 1, 1, 0);
      break;
    case 1:
      rectangle(0, 0, 1 + little, 1, 0);
      break;
    case 2:
      for (int strip = 0; strip < 5; ++strip) rectangle(0.2 * strip, 0, 0.2 * (strip + 1), 1, 0);
      break;
    case 3:
      rectangle(random.Uniform(0, 0.5), 0, 1, random.Uniform(0.5, 1), 0);
      break;
    case 4:
      rectangle(0.25, 0.25, 0.75, 0.75, little);
      break;
    default:
      break;
  }
}

// At random points of the room the irradiance is 1 W/m^2.
void CheckFurnace(const Pipeline& pipeline, const Setting& setting, Random& random) {
  constexpr int kPoints = 10;
  for (int i = 0; i < kPoints; ++i) {
    ReceiverPoint at;
    const Vec3 p(4 * random.Uniform(0.1, 0.9), 3 * random.Uniform(0.1, 0.9), 2.5 * random.Uniform(0.1, 0.9));
    at.position = setting.turn * p + setting.shift;
    at.normal = Vec3(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(0.1, 1)).normalized();
    const Rgb irradiance = pipeline.irradiance().Anywhere(at).irradiance;
    if (!((irradiance - 1).abs() <= 0.05).all())
      Fail("irradiance in a furnace is " + std::to_string(irradiance[0]));
  }
}

// A furnace, some of whose walls are given again, whole or in part.
void RunRoom(Random& random) {
  Setting setting = RandomSetting(random);
  setting.scale = 1;
  if (setting.decimals >= 0) setting.decimals = std::max(setting.decimals, 6);
  Text text(setting);
  text.Material("glow");
  for (int wall = 0; wall < 6; ++wall) AddRoomWall(wall, setting, text, random);
  const std::optional<Scene> scene = text.Read(false);
  if (!scene) return;
  CheckPatches(*scene);
  PipelineOptions options;
  options.error = 0.05;
  Pipeline pipeline(*scene, options);
  const ExecutionContext context;
  pipeline.Solve(context);
  pipeline.BuildMesh(MeshKind::kInterpolant, context, true);
  for (const QuadraticInterpolant& q : pipeline.mesh().irradiance)
    for (const Rgb& value : {q.At(0, 0), q.At(1, 0), q.At(0, 1)})
      if (!value.allFinite()) Fail("an interpolant is no number");
  CheckFurnace(pipeline, setting, random);
}

// One run in kRunsARoom makes a room and solves it.
void Run(Random& random) {
  if (random.Index(kRunsARoom) == 0)
    RunRoom(random);
  else
    RunPlane(random);
}

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) { return penumbra::fuzz::Loop(argc, argv, 1000, &penumbra::Run); }
