// mesh/triangulation/leaf_triangulator.h
//
// The triangles of one leaf, from its border and its lines alone: what leaves of the same shape with the same
// lines have once been given, they need not be given again.

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

// All that the triangles of a leaf depend on, in the plane of the patch.
class LeafShape {
 public:
  // A line, cut down to what can matter in the leaf.
  struct Line : DirectedLine {
    std::size_t first = 0, first_contact = 0, end = 0;  // its range in intervals()
  };

  // Begins anew: the vertices around the border and the corners of the leaf, both counter-clockwise; the
  // patch's snap distance [m].
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

  // All of it as numbers: equal ones give equal triangles.
  void Encode(std::vector<double>* key) const;

 private:
  std::vector<Vec2> border_;
  Polygon2 outline_;
  double snap_ = 0;
  std::vector<Line> lines_;
  std::vector<LineInterval> intervals_;
};

inline constexpr std::int32_t kNoLine = -1;

// The triangles of a leaf. A vertex below border_size is that place around the border, others are of
// `inside`. Lines are those of the LeafShape by their number there.
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
  std::size_t dropped_segments = 0;  // too near to the border to be edges
};

// Triangulates leaves one after the other. One object a thread.
class LeafTriangulator {
 public:
  // Each line gives the leaf at most one edge, the hull of its cover there; a piece of border that lies on a
  // line is marked. The border is never split or moved.
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
  std::vector<Vec2> points_;  // around the border, then the ends of segments inside
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

// The meshes of one patch's leaves that lines run through or along, as they were when the patch was last
// triangulated. Others are made faster than found.
class LeafMeshCache {
 public:
  // The mesh that was made of a shape with this key; null if there is none.
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
