#include "solver/transport/sources/source_polygon.h"

#include <algorithm>

#include "solver/base/check.h"

namespace penumbra {

SourcePolygon::SourcePolygon(std::span<const Vec3> vertices)
    : size(static_cast<std::int32_t>(vertices.size())) {
  PENUMBRA_CHECK(size == 3 || size == 4);
  std::copy(vertices.begin(), vertices.end(), vertex.begin());
}

bool SourcePolygon::operator==(const SourcePolygon& other) const {
  const std::span<const Vec3> a = Vertices(), b = other.Vertices();
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

std::vector<SourcePolygon> Fan(std::span<const Vec3> p) {
  std::vector<SourcePolygon> fan;
  for (std::size_t i = 2; i < p.size(); i += 2) {
    const std::array<Vec3, 4> corners = {p[0], p[i - 1], p[i], p[std::min(i + 1, p.size() - 1)]};
    fan.emplace_back(std::span<const Vec3>(corners.data(), i + 1 < p.size() ? 4 : 3));
  }
  return fan;
}

std::array<SourcePolygon, 4> Quarters(const SourcePolygon& whole) {
  const std::array<Vec3, 4>& v = whole.vertex;
  const auto n = static_cast<std::size_t>(whole.size);
  std::array<Vec3, 4> middle;
  for (std::size_t k = 0; k < n; ++k) middle[k] = 0.5 * (v[k] + v[(k + 1) % n]);
  const Vec3 centre = 0.25 * ((v[0] + v[1]) + (v[2] + v[3]));
  std::array<SourcePolygon, 4> quarters;
  for (std::size_t k = 0; k < n; ++k) {
    quarters[k].size = whole.size;
    // The quarter at vertex k keeps the vertex at place k, so that the corners of a quarter correspond to
    // those of the whole.
    quarters[k].vertex[k] = v[k];
    quarters[k].vertex[(k + 1) % n] = middle[k];
    quarters[k].vertex[(k + n - 1) % n] = middle[(k + n - 1) % n];
    if (n == 4) quarters[k].vertex[(k + 2) % n] = centre;
  }
  if (n == 3) {
    quarters[3].size = 3;
    quarters[3].vertex = {middle[1], middle[2], middle[0], Vec3::Zero()};
  }
  return quarters;
}

std::optional<SourcePolygon> JoinQuarters(const SourcePolygon& a, const SourcePolygon& b,
                                          const SourcePolygon& c, const SourcePolygon& d) {
  const std::int32_t size = a.size;
  if (b.size != size || c.size != size || d.size != size) return std::nullopt;
  const std::array<Vec3, 4>&p = a.vertex, &q = b.vertex, &r = c.vertex, &s = d.vertex;
  SourcePolygon whole;
  whole.size = size;
  if (size == 3) {
    const bool joined =
        p[1] == q[0] && q[2] == r[1] && r[0] == p[2] && s[0] == q[2] && s[1] == p[2] && s[2] == p[1];
    if (!joined) return std::nullopt;
    whole.vertex = {p[0], q[1], r[2], Vec3::Zero()};
    return whole;
  }
  const bool joined = p[2] == q[3] && p[2] == r[0] && p[2] == s[1] && p[1] == q[0] && q[2] == r[1] &&
                      r[3] == s[2] && s[0] == p[3];
  if (!joined) return std::nullopt;
  whole.vertex = {p[0], q[1], r[2], s[3]};
  return whole;
}

}  // namespace penumbra
