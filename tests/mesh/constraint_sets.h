// tests/mesh/constraint_sets.h
//
// Makes difficult sets of discontinuities from bytes, and checks the mesh that results from a set. The sets
// of discontinuities are used in tests with stored inputs and in fuzzing.

#pragma once

#include <cstdint>
#include <span>

#include "mesh/discontinuities/leaf_lines.h"
#include "mesh/triangulation/leaf_triangulation.h"
#include "mesh_test_scenes.h"
#include "solver/base/check.h"
#include "solver/scene/tolerances.h"

namespace penumbra::mesh_test {

// Reads the given bytes one by one, and then an endless sequence of zeros.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  bool empty() const { return at_ >= bytes_.size(); }
  std::uint32_t Next() { return at_ < bytes_.size() ? bytes_[at_++] : 0; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

// A scene with one patch, the patch's quadtree, and discontinuities on the patch.
struct ConstraintSet {
  Scene scene = EmptyScene();
  ElementForest forest;
  std::vector<Discontinuity> found;
  int max_leaf_dsets = 10;

  void AddShape(std::uint32_t shape) {
    switch (shape % 4) {
      case 0:
        AddPatch(scene, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
        break;
      case 1:
        AddPatch(scene, {{0, 0, 0}, {2, 0.1, 0}, {1.3, 1.1, 0}, {0.2, 0.9, 0}});
        break;
      case 2:
        AddPatch(scene, {{0, 0, 0}, {1, 0.2, 0.3}, {0.3, 1, 0.1}});
        break;
      default:
        AddPatch(scene, {{100, 200, 30}, {103, 200, 30}, {103, 200.3, 30.1}, {100, 200.3, 30.1}});
    }
    forest = ElementForest(scene);
  }

  // Returns the point of the patch whose lattice coordinates are the fractions s and t, in [0, 1], of the
  // lattice's size.
  Vec2 At(double s, double t) const {
    const Patch& patch = scene.patches[0];
    const auto at = [](double x) { return static_cast<std::int32_t>(x * kLatticeSize); };
    if (patch.size == 3 && s + t > 1) {
      s = 1 - s;
      t = 1 - t;
    }
    return PolygonFrame(patch.Vertices()).ToPlane(LatticePosition(patch, {at(s), at(t)}));
  }

  void Add(const Vec2& a, const Vec2& b, bool contact = false) {
    if ((b - a).norm() > SnapDistance(scene.patches[0]))
      found.push_back(Segment(a, b, contact ? kInfiniteWeight : 1.0 + static_cast<double>(found.size() % 7),
                              contact ? DiscontinuityDegree::kD0 : DiscontinuityDegree::kD2));
  }
};

// Makes a constraint set from two bytes of header and seven bytes for each segment. The end points of a
// segment lie on a lattice of sixteenths of the patch, and may be moved by 1e-14 to 1e-7. A segment may also
// be collinear with the preceding segment, parallel to the preceding segment, or end on it.
inline ConstraintSet SetFromBytes(std::span<const std::uint8_t> input) {
  Bytes bytes(input);
  ConstraintSet set;
  set.AddShape(bytes.Next());
  const std::uint32_t header = bytes.Next();
  set.max_leaf_dsets = 1 + static_cast<int>(header >> 4);
  Random random(header);
  RefineAtRandom(set.forest, 0, random, static_cast<int>(header & 7), 3);
  const auto point = [&](std::uint32_t x, std::uint32_t y, std::uint32_t shift) {
    Vec2 p = set.At((x & 15) / 15.0, (y & 15) / 15.0);
    if (((x >> 4) & 1) != 0) p = set.At((x & 15) / 16.0, (y & 15) / 16.0);
    if ((shift & 8) != 0) {
      const double angle = (y >> 4) * M_PI / 8;
      p += std::pow(10.0, -14 + static_cast<double>(shift & 7)) * Vec2(std::cos(angle), std::sin(angle));
    }
    return p;
  };
  constexpr std::size_t kMostSegments = 24;
  while (!bytes.empty() && set.found.size() < kMostSegments) {
    const std::uint32_t kind = bytes.Next();
    const std::uint32_t x0 = bytes.Next(), y0 = bytes.Next(), x1 = bytes.Next(), y1 = bytes.Next();
    const std::uint32_t shift = bytes.Next(), more = bytes.Next();
    Vec2 a = point(x0, y0, shift & 15), b = point(x1, y1, shift >> 4);
    if (!set.found.empty() && (kind & 3) != 0) {
      const auto& [c, d] = set.found.back().end;
      const double fraction = more / 128.0 - 0.5;
      if ((kind & 3) == 1) {  // collinear with the preceding segment
        b = c + (0.5 + fraction) * (d - c);
        a = c + fraction * (d - c);
      } else if ((kind & 3) == 2) {  // parallel and near to the preceding segment
        const Vec2 side(-(d - c).y(), (d - c).x());
        const Vec2 offset = std::pow(10.0, -14 + static_cast<double>(more & 7)) * side.normalized();
        a = c + offset;
        b = d + offset;
      } else {  // end on the preceding segment
        b = c + fraction * (d - c);
      }
    }
    set.Add(a, b, (kind & 4) != 0);
  }
  return set;
}

// Stops the program unless the mesh of the constraint set is valid: triangles are counter-clockwise, their
// areas add up to the patch's area, and the mesh conforms (Validate). CheckSet() also requires that edges on
// discontinuities cover every active line, unless segments had to be dropped.
inline PatchTriangulation CheckSet(const ConstraintSet& set) {
  DiscontinuityOptions options;
  options.max_leaf_dsets = set.max_leaf_dsets;
  const PatchDSets dsets = ActivateDiscontinuities(set.forest, 0, set.found, options);
  PatchTriangulation mesh = TriangulateLeaves(set.forest, 0, dsets);
  mesh.Validate(set.scene.patches[0]);
  if (mesh.dropped_segments > 0) return mesh;
  const Frame frame = PolygonFrame(set.scene.patches[0].Vertices());
  // Near the border of a leaf, a segment may end up to kLeafReach too early, and may be bent sideways by a
  // few snap distances.
  const double reach = 70 * SnapDistance(set.scene.patches[0]);
  for (std::size_t leaf = 0; leaf < dsets.leaves.size(); ++leaf) {
    const Polygon2 outline = LeafOutline(set.forest[dsets.leaves[leaf]], frame);
    for (const std::int32_t number : dsets.leaf_lines[leaf]) {
      const DiscontinuityLine& line = dsets.lines[number];
      const LineInterval inside = ClipLine(line.origin, line.direction, outline, reach);
      for (const LineInterval& cover : line.cover) {
        const double t0 = std::max(cover.t0, inside.t0), t1 = std::min(cover.t1, inside.t1);
        if (t1 - t0 <= 4 * reach) continue;
        for (const double s : {0.25, 0.6}) {
          const Vec2 p = line.At((1 - s) * t0 + s * t1);
          bool on_edge = false;
          for (std::uint32_t t = mesh.first_triangle[leaf]; t < mesh.first_triangle[leaf + 1] && !on_edge;
               ++t)
            for (int k = 0; k < 3; ++k) {
              if (mesh.triangles[t].line[k] == kNoLine) continue;
              const Vec2 &a = mesh.in_plane[mesh.triangles[t].vertex[k]],
                         &b = mesh.in_plane[mesh.triangles[t].vertex[(k + 1) % 3]];
              const double u = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
              on_edge |= (a + u * (b - a) - p).norm() <= reach;
            }
          PENUMBRA_CHECK(on_edge);
        }
      }
    }
  }
  return mesh;
}

}  // namespace penumbra::mesh_test
