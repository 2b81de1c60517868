#include "solver/scene/patch_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "solver/base/random.h"
#include "solver/geometry/orientation.h"
#include "solver/geometry/plane_projection.h"

namespace penumbra {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A scene of faces with the materials 0 (grey) and 1 (a lamp), each face in one of the objects.
class TestScene {
 public:
  TestScene() {
    scene.materials.resize(2);
    scene.materials[1].emittance = Rgb::Constant(5);
  }

  TestScene& Add(Polygon3 vertices, std::int32_t material = 0, std::int32_t object = 0) {
    while (static_cast<std::int32_t>(scene.objects.size()) <= object) scene.objects.emplace_back();
    scene.objects[object].faces.push_back(static_cast<std::int32_t>(scene.faces.size()));
    scene.faces.push_back({std::move(vertices), material, object});
    return *this;
  }

  PatchReport Build() { return BuildPatches(scene); }

  double AreaOf(std::int32_t material) const {
    double sum = 0;
    for (const Patch& patch : scene.patches)
      if (patch.material == material) sum += patch.area;
    return sum;
  }

  Scene scene;
};

Polygon3 Rectangle(double x0, double y0, double x1, double y1, double z = 0) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

// Every patch is convex, with the corners and front of its face.
void CheckConvex(const Scene& scene) {
  for (const Patch& patch : scene.patches) {
    ASSERT_GE(patch.faces.size(), 1u);
    const Vec3 normal = VectorArea(scene.faces[patch.faces[0]].vertices).normalized();
    EXPECT_GT(patch.normal.dot(normal), 1 - 1e-9);
    const PlaneProjection projection(patch.vertex[0], normal);
    for (int i = 0; i < patch.size; ++i)
      EXPECT_EQ(Orientation(projection.ToPlane(patch.vertex[i]),
                            projection.ToPlane(patch.vertex[(i + 1) % patch.size]),
                            projection.ToPlane(patch.vertex[(i + 2) % patch.size])),
                1);
  }
}

Polygon3 Moved(const Polygon3& polygon, const Eigen::Matrix3d& rotation, const Vec3& shift) {
  Polygon3 moved;
  for (const Vec3& p : polygon) moved.push_back(rotation * p + shift);
  return moved;
}

Eigen::Matrix3d RandomRotation(Random& random) {
  return Eigen::Quaterniond(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1),
                            random.Uniform(-1, 1))
      .normalized()
      .toRotationMatrix();
}

TEST(PatchBuilder, ConvexFacesStayAsTheyAre) {
  // Triangles and convex quadrilaterals keep their vertices, order included.
  TestScene t;
  t.Add(Rectangle(0, 0, 1, 2)).Add({{0.1, 0.2, 0.3}, {1.1, 0, 0.7}, {0.3, 1, 0.2}}, 0, 1);
  EXPECT_THAT(t.Build().cut_faces, IsEmpty());
  ASSERT_EQ(t.scene.patches.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    const Patch& patch = t.scene.patches[i];
    EXPECT_EQ(Polygon3(patch.Vertices().begin(), patch.Vertices().end()), t.scene.faces[i].vertices);
    EXPECT_THAT(patch.faces, ElementsAre(i));
    EXPECT_EQ(patch.object, i);
  }
}

TEST(PatchBuilder, StraightCornersAreLeftOut) {
  // A quadrilateral with a straight corner is a triangle; an octagonal rectangle is a rectangle; tilted ones
  // too.
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Matrix3d rotation = trial == 0 ? Eigen::Matrix3d::Identity() : RandomRotation(random);
    const Vec3 shift = Vec3(random.Uniform(), random.Uniform(), random.Uniform());
    TestScene t;
    t.Add(Moved({{0, 0, 0}, {0.3, 0, 0}, {1, 0, 0}, {0, 1, 0}}, rotation, shift));
    t.Add(Moved(
        {{0, 0, 2}, {0.3, 0, 2}, {1, 0, 2}, {1, 0.7, 2}, {1, 1, 2}, {0.1, 1, 2}, {0, 1, 2}, {0, 0.4, 2}},
        rotation, shift));
    t.Build();
    ASSERT_EQ(t.scene.patches.size(), 2u);
    EXPECT_EQ(t.scene.patches[0].size, 3);
    EXPECT_EQ(t.scene.patches[1].size, 4);
    EXPECT_NEAR(t.AreaOf(0), 1.5, 1e-14);
    CheckConvex(t.scene);
  }
}

TEST(PatchBuilder, LShapeIsTwoQuadrilaterals) {
  // An L and a U fall apart into two and three quadrilaterals.
  TestScene t;
  t.Add({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});
  t.Add({{0, 0, 1}, {3, 0, 1}, {3, 2, 1}, {2, 2, 1}, {2, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}});
  t.Build();
  EXPECT_EQ(t.scene.patches.size(), 5u);
  EXPECT_EQ(t.AreaOf(0), 3 + 5);
  CheckConvex(t.scene);
}

TEST(PatchBuilder, RandomStarsAndCombs) {
  // Whatever the polygon and its plane, the patches are convex, their areas add up, and few enough: half the
  // vertices, and some.
  Random random(5);
  double worst = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Polygon3 polygon;
    const int n = 4 + static_cast<int>(random.Index(40));
    if (trial % 2 == 0) {
      for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * (i + 0.9 * random.Uniform()) / n,
                     r = random.Uniform(0.1, 1);
        polygon.push_back({r * std::cos(angle), r * std::sin(angle), 0});
      }
    } else {
      for (int i = 0; i < n; ++i) {
        const double tooth = random.Uniform(0.01, 1);
        for (const Vec2& p : {Vec2(i, 0), Vec2(i, tooth), Vec2(i + 0.5, tooth), Vec2(i + 0.5, 0)})
          polygon.push_back({-p.x(), p.y(), 0});
      }
      polygon.push_back({-1.0 * n, -1, 0});
      polygon.push_back({0, -1, 0});
    }
    if (VectorArea(polygon).z() <= 0) continue;
    const double scale = random.LogUniform(1e-3, 1e3);
    for (Vec3& p : polygon) p *= scale;
    polygon = Moved(polygon, trial % 3 == 0 ? Eigen::Matrix3d::Identity() : RandomRotation(random),
                    Vec3::Constant(random.Uniform(-scale, scale)));
    TestScene t;
    t.Add(polygon).Build();
    const double area = VectorArea(polygon).norm();
    worst = std::max(worst, std::abs(t.AreaOf(0) / area - 1));
    CheckConvex(t.scene);
    EXPECT_LE(t.scene.patches.size(), 3 * polygon.size() / 4);
    for (const Patch& patch : t.scene.patches)
      for (const Vec3& v : patch.Vertices())
        EXPECT_NE(std::find(polygon.begin(), polygon.end(), v), polygon.end()) << "vertices keep their bits";
    if (HasFailure()) FAIL() << "trial " << trial;
  }
  std::printf("largest relative error of the area: %.3g\n", worst);
  EXPECT_LE(worst, 1e-12);
}

TEST(PatchBuilder, TrianglesOfAWallAreJoined) {
  // Two triangles are one wall, whichever way they are turned; a point's face is the triangle it lies in.
  TestScene t;
  t.Add({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}}).Add({{0, 1, 0}, {0, 0, 0}, {2, 1, 0}});
  EXPECT_THAT(t.Build().cut_faces, IsEmpty());
  ASSERT_EQ(t.scene.patches.size(), 1u);
  const Patch& wall = t.scene.patches[0];
  EXPECT_EQ(wall.area, 2);
  EXPECT_THAT(wall.faces, ElementsAre(0, 1));
  EXPECT_THAT(wall.Vertices(), ElementsAre(Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(0, 1, 0)));
  EXPECT_EQ(t.scene.FaceAt(0, {1.5, 0.2, 0}), 0);
  EXPECT_EQ(t.scene.FaceAt(0, {0.5, 0.8, 0}), 1);
  EXPECT_EQ(t.scene.FaceAt(0, {1, 0.5, 0}), 0) << "on both: the lowest";
  EXPECT_EQ(t.scene.FaceAt(0, {0.5, 1 + 1e-10, 0}), 1) << "beside both: the nearer";
}

TEST(PatchBuilder, JoinsOnlyWhatIsOneWall) {
  // Triangles of other objects, materials, planes or sides, and those that form no convex quadrilateral, stay
  // apart.
  const Polygon3 a = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, b = {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto count = [](TestScene t) {
    t.Build();
    return t.scene.patches.size();
  };
  EXPECT_EQ(count(TestScene().Add(a).Add(b)), 1u);
  EXPECT_EQ(count(TestScene().Add(a, 0, 0).Add(b, 0, 1)), 2u);
  EXPECT_EQ(count(TestScene().Add(a, 0).Add(b, 1)), 2u);
  EXPECT_EQ(count(TestScene().Add(a).Add({{0, 0, 0}, {1, 1, 0}, {0, 1, 1e-7}})), 2u);
  EXPECT_EQ(count(TestScene().Add(a).Add({{0, 0, 0}, {0, 1, 0}, {1, 1, 0}})), 2u);
  EXPECT_EQ(count(TestScene().Add(a).Add({{0, 0, 0}, {1, 1, 0}, {-1, 0, 0}})), 2u) << "a straight corner";
  EXPECT_EQ(count(TestScene().Add(a).Add({{0, 0, 0}, {1, 1, 0}, {-1, -0.5, 0}})), 2u) << "a concave corner";
}

TEST(PatchBuilder, GridOfTrianglesBecomesAGridOfSquares) {
  // Of all ways to pair the triangles of a tilted grid, the squares win.
  Random random(9);
  const Eigen::Matrix3d rotation = RandomRotation(random);
  TestScene t;
  const int n = 12;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Polygon3 q = Moved(Rectangle(i, j, i + 1, j + 1), rotation, Vec3(0.1, 0.2, 0.3));
      t.Add({q[0], q[1], q[2]}).Add({q[2], q[3], q[0]});
    }
  EXPECT_THAT(t.Build().cut_faces, IsEmpty());
  ASSERT_EQ(t.scene.patches.size(), static_cast<std::size_t>(n * n));
  for (const Patch& patch : t.scene.patches) EXPECT_NEAR(patch.area, 1, 1e-13);
}

TEST(PatchBuilder, LightInAnUncutCeiling) {
  // The ceiling becomes a ring of four quadrilaterals around the light, whether it comes before or after it.
  for (const bool light_first : {false, true})
    for (const bool triangles : {false, true}) {
      const auto add = [&](TestScene& t, const Polygon3& q, std::int32_t material) {
        if (triangles)
          t.Add({q[0], q[1], q[2]}, material).Add({q[2], q[3], q[0]}, material);
        else
          t.Add(q, material);
      };
      TestScene t;
      if (light_first) add(t, Rectangle(1, 1, 2, 2.5, 3), 1);
      add(t, Rectangle(0, 0, 5, 4, 3), 0);
      if (!light_first) add(t, Rectangle(1, 1, 2, 2.5, 3), 1);
      const PatchReport report = t.Build();
      EXPECT_EQ(report.cut_faces.size(), triangles ? 2u : 1u);
      EXPECT_EQ(t.scene.patches.size(), 5u);
      for (const Patch& patch : t.scene.patches) EXPECT_EQ(patch.size, 4);
      EXPECT_EQ(t.AreaOf(0), 18.5);
      EXPECT_EQ(t.AreaOf(1), 1.5);
      CheckConvex(t.scene);
      for (std::size_t p = 0; p < t.scene.patches.size(); ++p) {
        const Vec3 centre = Centroid(t.scene.patches[p].Vertices());
        const std::int32_t face = t.scene.FaceAt(static_cast<PatchId>(p), centre);
        EXPECT_EQ(t.scene.faces[face].material, t.scene.patches[p].material);
        EXPECT_TRUE(ConvexContains(t.scene.faces[face].vertices, t.scene.patches[p].normal, centre, 1e-12));
      }
    }
}

TEST(PatchBuilder, DuplicateFaceLosesWhole) {
  // Of two equal faces the first stays; an emitter stays even as the second.
  TestScene t;
  t.Add(Rectangle(0, 0, 1, 1)).Add({{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}, 0, 1);
  EXPECT_THAT(t.Build().cut_faces, ElementsAre(1));
  ASSERT_EQ(t.scene.patches.size(), 1u);
  EXPECT_THAT(t.scene.patches[0].faces, ElementsAre(0));

  TestScene lamp;
  lamp.Add(Rectangle(0, 0, 1, 1)).Add(Rectangle(0, 0, 1, 1), 1);
  EXPECT_THAT(lamp.Build().cut_faces, ElementsAre(0));
  ASSERT_EQ(lamp.scene.patches.size(), 1u);
  EXPECT_THAT(lamp.scene.patches[0].faces, ElementsAre(1));
}

TEST(PatchBuilder, PartialAndThreefoldOverlaps) {
  // The union's area is covered once, each place by the emitter or else the first.
  TestScene t;
  t.Add(Rectangle(0, 0, 2, 2)).Add(Rectangle(1, 1, 3, 3)).Add(Rectangle(1.5, 0.5, 2.5, 2.5), 1);
  EXPECT_THAT(t.Build().cut_faces, ElementsAre(0, 1));
  EXPECT_EQ(t.AreaOf(1), 2);
  EXPECT_DOUBLE_EQ(t.AreaOf(0), 7 - 1.75);  // the union of the squares, less what the lamp covers of it
  CheckConvex(t.scene);
}

TEST(PatchBuilder, ContactIsNoOverlap) {
  // A box's foot on a floor, neighbours with a common edge, and parallel planes a little apart are left
  // alone.
  TestScene t;
  t.Add(Rectangle(0, 0, 4, 4));
  Polygon3 foot = Rectangle(1, 1, 2, 2);
  std::reverse(foot.begin(), foot.end());
  t.Add(foot)
      .Add(Rectangle(4, 0, 5, 4))
      .Add(Rectangle(1, 1, 2, 2, 1e-5))
      .Add({{4, 4, 0}, {5, 5, 0}, {4, 5, 0}});
  EXPECT_THAT(t.Build().cut_faces, IsEmpty());
  EXPECT_EQ(t.scene.patches.size(), 5u);
}

// The area that axis-aligned rectangles cover together.
double AreaOfUnion(const std::vector<Polygon3>& flat) {
  double total = 0;
  std::vector<double> xs, ys;
  for (const Polygon3& q : flat)
    for (const Vec3& v : q) {
      xs.push_back(v.x());
      ys.push_back(v.y());
    }
  std::sort(xs.begin(), xs.end());
  std::sort(ys.begin(), ys.end());
  for (std::size_t i = 1; i < xs.size(); ++i)
    for (std::size_t j = 1; j < ys.size(); ++j) {
      const Vec3 middle(0.5 * (xs[i] + xs[i - 1]), 0.5 * (ys[j] + ys[j - 1]), 0);
      if (std::any_of(flat.begin(), flat.end(),
                      [&](const Polygon3& q) { return ConvexContains(q, Vec3::UnitZ(), middle, 0); }))
        total += (xs[i] - xs[i - 1]) * (ys[j] - ys[j - 1]);
    }
  return total;
}

TEST(PatchBuilder, RandomOverlapsInATiltedPlane) {
  // Rectangles strewn over a tilted plane: the patches cover each sample point just once, and it belongs to
  // the right one.
  Random random(13);
  double worst = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Eigen::Matrix3d rotation = RandomRotation(random);
    const Vec3 shift = Vec3::Constant(random.Uniform());
    TestScene t;
    std::vector<Polygon3> flat;
    const int n = 2 + static_cast<int>(random.Index(5));
    for (int i = 0; i < n; ++i) {
      // On a coarse grid at times, so that edges coincide.
      const auto coordinate = [&] {
        return trial % 2 ? random.Uniform(0, 4) : std::floor(random.Uniform(0, 5));
      };
      const double x = coordinate(), y = coordinate();
      flat.push_back(Rectangle(x, y, x + 1 + coordinate(), y + 1 + coordinate()));
      t.Add(Moved(flat.back(), rotation, shift), random.Index(3) == 0 ? 1 : 0, i);
    }
    t.Build();
    CheckConvex(t.scene);
    double covered = 0;
    for (int s = 0; s < 400; ++s) {
      const Vec3 p(random.Uniform(0, 9), random.Uniform(0, 9), 0);
      std::int32_t owner = -1;
      for (int i = 0; i < n; ++i) {
        if (!ConvexContains(flat[i], Vec3::UnitZ(), p, 0)) continue;
        if (owner < 0 || t.scene.faces[i].material > t.scene.faces[owner].material) owner = i;
      }
      std::vector<std::int32_t> found;
      for (const Patch& patch : t.scene.patches)
        if (ConvexContains(patch.Vertices(), patch.normal, rotation * p + shift, 0))
          found.push_back(patch.faces[0]);
      if (owner < 0) {
        EXPECT_THAT(found, IsEmpty());
      } else {
        EXPECT_THAT(found, ElementsAre(owner));
      }
    }
    for (const Patch& patch : t.scene.patches) covered += patch.area;
    worst = std::max(worst, std::abs(covered / AreaOfUnion(flat) - 1));
    if (HasFailure()) FAIL() << "trial " << trial;
  }
  std::printf("largest relative error of the covered area: %.3g\n", worst);
  EXPECT_LE(worst, 1e-9);
}

// The polygon's coordinates to so many decimals.
Polygon3 Rounded(const Polygon3& polygon, int decimals) {
  const double unit = std::pow(10, -decimals);
  Polygon3 rounded;
  for (const Vec3& p : polygon) rounded.push_back((p.array() / unit).round() * unit);
  return rounded;
}

void AddTriangles(TestScene& t, const Polygon3& q, std::int32_t material) {
  t.Add({q[0], q[1], q[2]}, material).Add({q[2], q[3], q[0]}, material);
}

TEST(PatchBuilder, LampInATurnedCeilingOfFewDecimals) {
  // Of a lamp in an uncut ceiling, turned at random and written with 3 to 12 decimals, the lamp is seen and
  // the ceiling is what is left around it, to what the decimals leave of lengths.
  Random random(17);
  for (int trial = 0; trial < 400; ++trial) {
    const int decimals = 3 + trial % 10;
    const double unit = std::pow(10, -decimals);
    const Eigen::Matrix3d rotation = RandomRotation(random);
    const Vec3 shift(random.Uniform(-2, 2), random.Uniform(-2, 2), random.Uniform(-2, 2));
    const double x = random.Uniform(0.2, 2), y = random.Uniform(0.2, 1.5);
    TestScene t;
    t.scene.coordinate_step = Vec3::Constant(unit);
    AddTriangles(t, Rounded(Moved(Rectangle(0, 0, 5, 4), rotation, shift), decimals), 0);
    AddTriangles(t, Rounded(Moved(Rectangle(x, y, x + 1, y + 0.8), rotation, shift), decimals), 1);
    const PatchReport report = t.Build();
    EXPECT_FALSE(report.cut_faces.empty());
    EXPECT_LE(report.largest_distance, 2.6 * unit);
    EXPECT_NEAR(t.AreaOf(1), 0.8, 4 * unit);
    EXPECT_NEAR(t.AreaOf(0), 19.2, 40 * unit);
    for (const Patch& patch : t.scene.patches) EXPECT_LE((patch.normal - rotation.col(2)).norm(), 20 * unit);
    if (HasFailure()) FAIL() << "trial " << trial << ", " << decimals << " decimals";
  }
}

TEST(PatchBuilder, TheDigitsTellLevelPlanesApart) {
  // A sheet one unit of the last digit above a table is another plane; so is a lamp at that distance. Faces
  // in one plane whose edges are a unit apart leave a strip of that width.
  TestScene t;
  t.scene.coordinate_step = Vec3::Constant(0.01);
  t.Add(Rectangle(0, 0, 2, 1, 0.75))
      .Add(Rectangle(0.5, 0.5, 0.7, 0.8, 0.76))
      .Add(Rectangle(1, 0.2, 1.2, 0.4, 0.74), 1);
  EXPECT_THAT(t.Build().cut_faces, IsEmpty());
  EXPECT_EQ(t.scene.patches.size(), 3u);

  TestScene strip;
  strip.scene.coordinate_step = Vec3::Constant(0.01);
  strip.Add(Rectangle(0, 0, 1, 1)).Add(Rectangle(0, 0, 1.01, 1));
  EXPECT_THAT(strip.Build().cut_faces, ElementsAre(1));
  ASSERT_EQ(strip.scene.patches.size(), 2u);
  EXPECT_NEAR(strip.scene.patches[1].area, 0.01, 1e-15);
}

TEST(PatchBuilder, PlanesThatTouchAreOne) {
  // A sheet nearer to a table than things are that touch is in the table's plane, before it or behind: a
  // point on one is on the other. The lamp stays whole.
  for (const double height : {-1e-6, 1e-6, -1e-8, 1e-8}) {
    TestScene t;
    t.Add(Rectangle(0, 0, 2, 1)).Add(Rectangle(0.5, 0.5, 0.7, 0.8, height), 1);
    EXPECT_THAT(t.Build().cut_faces, ElementsAre(0));
    EXPECT_NEAR(t.AreaOf(0), 1.94, 1e-12);
    EXPECT_NEAR(t.AreaOf(1), 0.06, 1e-15);
  }
}

TEST(PatchBuilder, FaceOffItsPlaneGivenTwice) {
  // A face whose corners lie off their plane, as much as a face may, is one with its copy, whichever corner
  // that begins with.
  Random random(19);
  for (int trial = 0; trial < 100; ++trial) {
    Polygon3 wall = Rectangle(0, 0, 3, 2);
    for (Vec3& p : wall) p.z() += random.Uniform(-3e-6, 3e-6);
    wall = Moved(wall, RandomRotation(random), Vec3::Constant(random.Uniform()));
    TestScene t;
    t.Add(wall);
    std::rotate(wall.begin(), wall.begin() + random.Index(4), wall.end());
    t.Add(wall);
    EXPECT_THAT(t.Build().cut_faces, ElementsAre(1));
    EXPECT_EQ(t.scene.patches.size(), 1u);
  }
}

TEST(PatchBuilder, SliversAreNoPatches) {
  // Of a floor given twice, the second time wider by next to nothing, no strip is left; a slab without
  // thickness to speak of has two sides. No patch is narrower than the points on it are snapped.
  for (int power = 9; power <= 18; ++power) {
    const double little = std::pow(10, -power);
    TestScene t;
    t.Add(Rectangle(0, 0, 1, 1)).Add(Rectangle(0, -little, 1, 1));
    EXPECT_EQ(t.Build().narrow_faces.size(), 0u);
    EXPECT_EQ(t.scene.patches.size(), 1u) << little;
  }
  TestScene slab;
  const double thickness = 1e-10;
  slab.Add(Rectangle(0, 0, 1, 1, thickness));
  Polygon3 foot = Rectangle(0, 0, 1, 1);
  std::reverse(foot.begin(), foot.end());
  slab.Add(foot).Add({{0, 0, 0}, {1, 0, 0}, {1, 0, thickness}, {0, 0, thickness}});
  EXPECT_THAT(slab.Build().narrow_faces, ElementsAre(2));
  EXPECT_EQ(slab.scene.patches.size(), 2u);
}

TEST(PatchBuilder, FacesThatCoincideToTheLastBit) {
  // Of two triangles or quadrilaterals that differ by some of their last bits one is left, however they are
  // turned.
  Random random(23);
  for (int trial = 0; trial < 5000; ++trial) {
    Polygon3 face = Rectangle(0, 0, random.Uniform(0.1, 2), random.Uniform(0.1, 2));
    if (trial % 2) face.pop_back();
    face = Moved(face, RandomRotation(random), Vec3::Constant(random.Uniform(0, 20)));
    TestScene t;
    t.Add(face);
    for (Vec3& p : face)
      for (int axis = 0; axis < 3; ++axis)
        if (random.Index(2)) p[axis] = std::nextafter(p[axis], random.Uniform(-30, 30));
    t.Add(face);
    EXPECT_THAT(t.Build().cut_faces, ElementsAre(1));
    ASSERT_EQ(t.scene.patches.size(), 1u) << trial;
  }
}

TEST(PatchBuilder, ManyFacesTakeNoTime) {
  // 12800 triangles in a plane and as many above it are paired in well under a second.
  TestScene t;
  for (int z = 0; z < 2; ++z)
    for (int i = 0; i < 80; ++i)
      for (int j = 0; j < 80; ++j) {
        const Polygon3 q = Rectangle(i, j, i + 1, j + 1, z);
        t.Add({q[0], q[1], q[2]}, 0, j).Add({q[2], q[3], q[0]}, 0, j);
      }
  const auto start = std::chrono::steady_clock::now();
  t.Build();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(t.scene.patches.size(), 12800u);
  std::printf("%.3f s\n", seconds);
  EXPECT_LT(seconds, 10);  // the checked and sanitized builds are slower
}

}  // namespace
}  // namespace penumbra
