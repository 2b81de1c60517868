// The shadow lines of the light flush with the ceiling of experiments/peers/box.obj.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/dset.h"
#include "mesh_test_scenes.h"
#include "solver/scene/obj_reader.h"
#include "test_paths.h"

namespace penumbra {
namespace {

// The scene by its objects: floor, left, right, back, front; then the ceiling with the light; then the block.
constexpr PatchId kFloor = 0, kWalls = 5, kLight = 9, kBlock = 14, kTop = 18;

// A ray from the light through a point of the block, as far as the room's floor or a wall: the point there by
// similar triangles, and the patch.
struct Landing {
  PatchId patch = kNoPatch;
  Vec3 point;
};
Landing Land(const Vec3& from, const Vec3& through) {
  Landing landing;
  double nearest = std::numeric_limits<double>::infinity();
  const auto meet = [&](PatchId patch, int axis, double at) {
    const double step = through[axis] - from[axis];
    const double s = (at - from[axis]) / step;
    if (step == 0 || !(s >= 1) || s >= nearest) return;
    nearest = s;
    landing = {patch, from + s * (through - from)};
    landing.point[axis] = at;
  };
  meet(kFloor, 2, 0);
  meet(1, 0, 0);
  meet(2, 0, 1);
  meet(3, 1, 1);
  meet(4, 1, 0);
  return landing;
}

// How far the point is from the nearest of the segments of this kind and source part [m].
double Distance(const std::vector<Discontinuity>& found, DiscontinuityKind kind, std::int32_t part,
                const Vec2& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Discontinuity& d : found) {
    if (d.kind != kind || d.source_part != part) continue;
    const Vec2 along = d.end[1] - d.end[0];
    const double t = std::clamp((p - d.end[0]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (d.end[0] + t * along - p).norm());
  }
  return least;
}

class FlushLight : public testing::Test {
 protected:
  void SetUp() override {
    const std::vector<Vec3> light(scene_.patches[kLight].Vertices().begin(),
                                  scene_.patches[kLight].Vertices().end());
    ASSERT_EQ(scene_.patches.size(), 19U);
    for (const Vec3& v : light) ASSERT_EQ(v.z(), 1);
    std::vector<double> strength(scene_.patches.size(), 0.0);
    strength[kLight] = 10;
    const PatchVisibility visibility(scene_);
    const DiscontinuityFinder finder(scene_, visibility);
    for (PatchId p = 0; p < static_cast<PatchId>(scene_.patches.size()); ++p)
      found_.push_back(finder.Find(p, strength, {}));
    for (std::int32_t k = 0; k < 4; ++k) {
      corner_.push_back(scene_.patches[kTop].vertex[k]);
      const Vec3 along = scene_.patches[kTop].vertex[(k + 1) % 4] - corner_.back();
      outward_.emplace_back(along.y(), -along.x(), 0.0);
    }
  }

  // Whether the point sees the side of the block under its top edge k.
  bool SeesSide(const Vec3& from, std::size_t k) const { return outward_[k].dot(from - corner_[k]) > 0; }

  // Checks that the rays from the light's point through the block's land on a line of that kind.
  void Check(const Vec3& from, const Vec3& through, DiscontinuityKind kind, std::int32_t part) {
    const Landing landing = Land(from, through);
    ASSERT_NE(landing.patch, kNoPatch);
    // In the edges of the room two patches share the line.
    constexpr double kEdge = 1e-6;
    int close = 0;
    for (int axis = 0; axis < 3; ++axis)
      close += std::min(landing.point[axis], 1 - landing.point[axis]) < kEdge ? 1 : 0;
    if (close > 1) return;
    const Frame frame = PolygonFrame(scene_.patches[landing.patch].Vertices());
    const double distance = Distance(found_[landing.patch], kind, part, frame.ToPlane(landing.point));
    EXPECT_LE(distance, 1e-12) << "on patch " << landing.patch << " at " << landing.point.transpose();
    worst_ = std::max(worst_, distance);
    lit_.insert(landing.patch);
    ++checked_;
  }

  const Scene scene_ = ReadObj(PENUMBRA_SOURCE_DIR "/experiments/peers/box.obj", {});
  std::vector<std::vector<Discontinuity>> found_;
  std::vector<Vec3> corner_, outward_;  // of the block's top, and of the side from corner k on
  std::set<PatchId> lit_;
  double worst_ = 0;
  int checked_ = 0;
};

// VE: every ray from a corner of the light over a silhouette edge of the block's top, or past one of its
// upright edges, lands on a line, by similar triangles; on the floor and on the walls. EV likewise from the
// light's edges past the top's corners.
TEST_F(FlushLight, ShadowLinesLieWhereSimilarTrianglesPutThem) {
  const Patch& light = scene_.patches[kLight];
  constexpr int kSteps = 25;
  for (std::int32_t part = 0; part < 4; ++part) {
    const Vec3& v = light.vertex[part];
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 &a = corner_[k], &b = corner_[(k + 1) % 4], foot(a.x(), a.y(), 0);
      for (int i = 0; i < kSteps; ++i) {
        const double t = (i + 0.5) / kSteps;
        // The top is seen from everywhere on the ceiling.
        if (!SeesSide(v, k)) Check(v, a + t * (b - a), DiscontinuityKind::kVE, part);
        if (SeesSide(v, k) != SeesSide(v, (k + 3) % 4))
          Check(v, a + t * (foot - a), DiscontinuityKind::kVE, part);
        const Vec3 y = v + t * (light.vertex[(part + 1) % 4] - v);
        if (!SeesSide(y, k) || !SeesSide(y, (k + 3) % 4)) Check(y, a, DiscontinuityKind::kEV, part);
      }
    }
  }
  std::printf("%d rays on %zu patches, at most %.2g m off\n", checked_, lit_.size(), worst_);
  EXPECT_GT(checked_, 500);
  EXPECT_GE(lit_.size(), 3U);
  EXPECT_TRUE(lit_.contains(kFloor));
}

// And there are no other lines: each is the block's, and its middle sees the vertex that made it just over
// the edge that made it. The ceiling around the light casts none and gets none.
TEST_F(FlushLight, NothingElseCastsLines) {
  std::size_t lines = 0;
  for (PatchId p = 0; p < static_cast<PatchId>(scene_.patches.size()); ++p) {
    const Frame frame = PolygonFrame(scene_.patches[p].Vertices());
    for (const Discontinuity& d : found_[p]) {
      if (d.kind == DiscontinuityKind::kContact) continue;
      ++lines;
      ASSERT_EQ(d.source, kLight);
      ASSERT_GE(d.blocker, kBlock);
      EXPECT_LT(p, kWalls) << "only the floor and the walls get any";
      const Vec3 x = frame.FromPlane(0.5 * (d.end[0] + d.end[1]));
      const Patch &source = scene_.patches[kLight], &blocker = scene_.patches[d.blocker];
      const bool ve = d.kind == DiscontinuityKind::kVE;
      const Vec3& apex = ve ? source.vertex[d.source_part] : blocker.vertex[d.blocker_part];
      const Patch& other = ve ? blocker : source;
      const std::int32_t k = ve ? d.blocker_part : d.source_part;
      const Vec3 &a = other.vertex[k], &b = other.vertex[(k + 1) % other.size];
      const Vec3 ray = (apex - x).normalized();
      EXPECT_NEAR(ray.dot((a - x).cross(b - x)) / (b - a).norm(), 0, 1e-12);
    }
  }
  EXPECT_GT(lines, 30U);
}

// The strongest of them become edges of the mesh of the floor and of a wall, ten a leaf at most.
TEST_F(FlushLight, LinesAreActivated) {
  const ElementForest forest(scene_);
  for (const PatchId p : {kFloor, kFloor + 1}) {
    const PatchDSets dsets = ActivateDiscontinuities(forest, p, found_[p], {});
    EXPECT_GT(dsets.dsets_active, 4U) << p;
    EXPECT_LE(dsets.dsets_active, 10U) << p;
  }
}

}  // namespace
}  // namespace penumbra
