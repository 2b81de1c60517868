// tests/display/brute_force.h
//
// Finds the triangle that each pixel of a picture shows, by intersecting the pixel's ray with every triangle
// in binary64. Intersection with every triangle is slow, and serves as the reference for the tests of the
// rasteriser.

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "display/camera.h"
#include "display/glm_conversion.h"
#include "display/rasteriser.h"
#include "display/vector_kernels.h"

namespace penumbra {

struct Triangles {
  std::vector<Vec3> positions;
  std::vector<VertexIndices> triangles;

  std::uint32_t AddVertex(const Vec3& p) {
    positions.push_back(p);
    return static_cast<std::uint32_t>(positions.size() - 1);
  }
  void AddTriangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::uint32_t i = AddVertex(a), j = AddVertex(b), k = AddVertex(c);
    triangles.push_back({i, j, k});
  }
};

// The intersection of the viewing ray through a point of the picture with the plane of a triangle.
struct Meeting {
  bool front = false;  // true if the triangle's front faces the eye
  double depth = 0;    // depth of the intersection [m]
  // The distance of the picture's point to the line of the nearest edge [pixels], negative outside the
  // triangle.
  double pixels_inside = 0;
  double s = 0, t = 0;  // barycentric coordinates of the intersection, for vertices 1 and 2
};

inline Meeting Meet(const PixelRays& rays, double x, double y, const Triangles& mesh, std::size_t id) {
  std::array<glm::dvec3, 3> v;
  for (std::size_t k = 0; k < 3; ++k) v[k] = ToGlm(mesh.positions[mesh.triangles[id][k]]) - rays.eye;
  Meeting meeting;
  const double volume = -glm::dot(v[0], glm::cross(v[1] - v[0], v[2] - v[0]));
  meeting.front = volume > 0;
  if (!meeting.front) return meeting;
  const glm::dvec3 direction = rays.Direction(x, y);
  std::array<double, 3> b;
  meeting.pixels_inside = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 plane = glm::cross(v[(k + 2) % 3], v[(k + 1) % 3]);
    b[k] = glm::dot(plane, direction);
    const double slope = std::hypot(glm::dot(plane, rays.dx), glm::dot(plane, rays.dy));
    meeting.pixels_inside = std::min(meeting.pixels_inside, b[k] / slope);
  }
  const double sum = b[0] + b[1] + b[2];
  meeting.depth = volume / sum;
  meeting.s = b[1] / sum;
  meeting.t = b[2] / sum;
  return meeting;
}

// Counts of pixels where a drawn picture agrees with the reference or not.
struct Agreement {
  int pixels = 0;
  // The number of wrong pixels: they show a triangle that the ray misses or that another triangle hides, or
  // no triangle where there is one.
  int wrong = 0;
  // The number of pixels that differ from the reference but are acceptable, because several triangles meet in
  // the pixel.
  int loose = 0;
  std::size_t first_wrong = 0;
};

// Compares the triangle drawn in each pixel with the nearest triangle on the pixel's ray. Within a distance
// of 2 * kFringe pixels from an edge, the triangle on either side of the edge is accepted. CompareIds()
// accepts either of two triangles whose depths differ by a factor of less than 1 + 1e-5.
inline Agreement CompareIds(const PixelRays& rays, int width, int height, const Triangles& mesh,
                            const std::vector<std::uint32_t>& ids) {
  constexpr double kNear = 2 * static_cast<double>(kFringe);
  constexpr double kDepth = 1 + 1e-5;
  Agreement agreement;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      double nearest = std::numeric_limits<double>::infinity();
      std::uint32_t nearest_id = kNoTriangle;
      for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Meeting m = Meet(rays, x + 0.5, y + 0.5, mesh, i);
        if (!m.front || !(m.pixels_inside > kNear) || !(m.depth > 0) || m.depth >= nearest) continue;
        nearest = m.depth;
        nearest_id = static_cast<std::uint32_t>(i);
      }
      ++agreement.pixels;
      if (ids[at] == nearest_id) continue;
      bool right = false;
      if (ids[at] == kNoTriangle) {
        right = nearest_id == kNoTriangle;
      } else {
        const Meeting m = Meet(rays, x + 0.5, y + 0.5, mesh, ids[at]);
        // Near the edges of a triangle, the depth of its plane is not compared, because it may rise without
        // bound.
        const bool inner = m.pixels_inside > kNear;
        right = m.front && m.pixels_inside > -kNear && (!inner || m.depth <= nearest * kDepth);
      }
      if (right) {
        ++agreement.loose;
      } else if (agreement.wrong++ == 0) {
        agreement.first_wrong = at;
      }
    }
  return agreement;
}

}  // namespace penumbra
