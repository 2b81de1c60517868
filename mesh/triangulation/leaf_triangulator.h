// mesh/triangulation/leaf_triangulator.h
//
// Triangulates one leaf of a patch's quadtree. The triangles of a leaf depend only on the leaf's border and
// on the discontinuity lines in the leaf. Leaves with the same border and the same discontinuity lines
// therefore have the same triangles.

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

// All data that determine the triangles of a quadtree leaf, in coordinates of the patch's plane.
class LeafShape {
 public:
  // A discontinuity line, clipped to the neighbourhood of the quadtree leaf.
  struct Line : DirectedLine {
    // The discontinuities on the line cover intervals_[first, first_contact), and the contacts on the line
    // cover intervals_[first_contact, end).
    std::size_t first = 0, first_contact = 0, end = 0;
  };

  // Replaces the contents of the LeafShape by a leaf without discontinuity lines. `border` holds the vertices
  // around the leaf, and `outline` the corners of the leaf, both counter-clockwise. `snap` is SnapDistance(),
  // the distance within which points on the patch count as one point [m].
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

  // Converts the leaf's shape to a list of numbers, such that leaves with equal lists have equal triangles.
  void Encode(std::vector<double>* key) const;

 private:
  std::vector<Vec2> border_;
  Polygon2 outline_;
  double snap_ = 0;
  std::vector<Line> lines_;
  std::vector<LineInterval> intervals_;
};

inline constexpr std::int32_t kNoLine = -1;

// The triangles of one quadtree leaf. A vertex number below border_size is the index of a vertex on the
// leaf's border. The vertex number border_size + i stands for inside[i], a vertex in the interior of the
// leaf. A discontinuity line is numbered by its index in LeafShape::lines().
struct LeafMesh {
  struct Triangle {
    std::array<std::uint32_t, 3> vertex;  // numbers of the triangle's vertices, counter-clockwise
    // Edge k of a triangle runs from vertex k to vertex (k + 1) % 3.
    std::array<std::int32_t, 3> line = {kNoLine, kNoLine, kNoLine};
    std::array<bool, 3> contact = {false, false, false};
  };

  std::uint32_t border_size = 0;
  std::vector<Vec2> inside;
  std::vector<Triangle> triangles;
  // The number of discontinuity segments that are no edges because they are too close to the border of the
  // leaf.
  std::size_t dropped_segments = 0;
};

// Triangulates quadtree leaves one after another, with the same buffers. Each thread needs its own
// LeafTriangulator.
class LeafTriangulator {
 public:
  // Each discontinuity line becomes at most one constrained edge of the leaf's triangulation. The constrained
  // edge of a line is the shortest segment that contains all intervals that discontinuities cover on the line
  // inside the leaf. If an edge of a triangle on the leaf's border lies on a discontinuity line,
  // LeafMesh::Triangle::line holds the number of this line. Vertices of the leaf's border are neither added
  // nor moved.
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
  // The vertices of the leaf's border, followed by the ends of discontinuity segments inside the leaf.
  std::vector<Vec2> points_;
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
// discontinuity lines are not cached, because triangulating such a leaf takes less time than searching the
// cache.
class LeafMeshCache {
 public:
  // Returns the triangles of the leaf whose shape LeafShape::Encode() converts to `key`; null if the cache
  // does not contain the leaf.
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
