// mesh/triangulation/leaf_triangulator.h
//
// Triangulates one leaf. The triangles depend only on the leaf's border and on the discontinuity lines in it.
// Leaves with the same border and the same lines therefore have the same triangles.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "mesh/discontinuities/dset.h"
#include "solver/geometry/constrained_triangulation.h"
#include "solver/geometry/segment_splitter.h"
#include "solver/geometry/vec.h"

namespace penumbra {

// All data that determine the triangles of a leaf, in the plane of the patch.
class LeafShape {
 public:
  // A line, clipped to the neighbourhood of the leaf.
  struct Line : DirectedLine {
    std::size_t first = 0, first_contact = 0, end = 0;  // range in intervals_
  };

  // Starts a new leaf without lines. `border` holds the vertices around the leaf, and `outline` its corners,
  // both counter-clockwise; `snap` is the patch's snap distance [m].
  void Reset(std::span<const Vec2> border, Polygon2 outline, double snap);
  void AddLine(const DiscontinuityLine& line);

  std::span<const Vec2> border() const { return border_; }
  const Polygon2& outline() const { return outline_; }
  double snap() const { return snap_; }
  std::span<const Line> lines() const { return lines_; }
  std::span<const LineInterval> Cover(const Line& line) const {
    return std::span(intervals_).subspan(line.first, line.first_contact - line.first);
  }
  std::span<const LineInterval> Contact(const Line& line) const {
    return std::span(intervals_).subspan(line.first_contact, line.end - line.first_contact);
  }

  // Converts the shape to a list of numbers, such that leaves with equal lists have equal triangles.
  void Encode(std::vector<double>* key) const;

 private:
  std::vector<Vec2> border_;
  Polygon2 outline_;
  double snap_ = 0;
  std::vector<Line> lines_;
  std::vector<LineInterval> intervals_;
};

inline constexpr std::int32_t kNoLine = -1;

// The triangles of a leaf. A vertex number below border_size is the index of a border vertex; the number
// border_size + i is inside[i]. The numbers of lines are indices in LeafShape::lines().
struct LeafMesh {
  struct Triangle {
    std::array<std::uint32_t, 3> vertex;  // counter-clockwise
    // Edge k runs from vertex k to vertex k + 1.
    std::array<std::int32_t, 3> line = {kNoLine, kNoLine, kNoLine};
    std::array<bool, 3> contact = {false, false, false};
  };

  std::uint32_t border_size = 0;
  std::vector<Vec2> inside;
  std::vector<Triangle> triangles;
  std::size_t dropped_segments = 0;  // too close to the border to be edges
};

// Triangulates leaves, and reuses its buffers. Each thread needs its own object.
class LeafTriangulator {
 public:
  // Each line becomes at most one constrained edge of the leaf: the shortest segment that contains all
  // intervals of the line that discontinuities cover inside the leaf. In the result, edges on the border that
  // lie on a line are labelled with the line. Vertices of the border are neither added nor moved.
  LeafMesh Triangulate(const LeafShape& shape);

 private:
  using Line = LeafShape::Line;
  struct Segment {
    std::int32_t from, to, line;
  };

  void AddSegment(std::int32_t number);
  void PushSegment(std::int32_t from, std::int32_t to, std::int32_t line);
  double Reach() const;
  std::int32_t BorderVertexOn(const Line& line, double t0, double t1, bool last) const;
  std::int32_t AddPoint(const Vec2& p);
  void TriangulateOutline(LeafMesh& mesh);
  void TriangulateSegments(LeafMesh& mesh);
  bool Split();
  void MarkBorder(std::int32_t number, LeafMesh& mesh) const;

  const LeafShape* shape_ = nullptr;
  std::vector<Vec2> points_;  // border vertices, then the ends of segments inside
  std::int32_t border_size_ = 0;
  std::vector<Segment> segments_;
  std::vector<Vec2> split_points_;
  std::vector<bool> used_;
  std::vector<SegmentPiece> pieces_;
  std::vector<ConstraintSegment> constraints_;
  std::vector<std::array<std::int32_t, 3>> convex_;
  SegmentSplitter splitter_;
  ConstrainedTriangulator triangulator_;
};

// A cache of triangulated leaves of one patch, from the latest triangulation of the patch. Leaves without
// lines are not cached, because triangulating such a leaf takes less time than searching the cache.
class LeafMeshCache {
 public:
  // The mesh of the leaf with this key (LeafShape::Encode); null if the cache does not contain it.
  std::shared_ptr<const LeafMesh> Find(const std::vector<double>& key) const;
  void Clear() { meshes_.clear(); }
  void Insert(std::vector<double> key, std::shared_ptr<const LeafMesh> mesh) {
    meshes_.insert_or_assign(std::move(key), std::move(mesh));
  }
  std::size_t size() const { return meshes_.size(); }

 private:
  struct Hash {
    std::size_t operator()(const std::vector<double>& key) const;
  };
  std::unordered_map<std::vector<double>, std::shared_ptr<const LeafMesh>, Hash> meshes_;
};

}  // namespace penumbra
