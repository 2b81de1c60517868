#include "display/reconstruction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "display/glm_conversion.h"
#include "mesh/interpolants/hermite_surface.h"
#include "solver/transport/links/element_locator.h"

namespace penumbra {
namespace {

// A vertex of a leaf in homogeneous picture coordinates, with its light.
struct LitVertex {
  glm::dvec3 at{0.0};  // Projection
  Rgb light = Rgb::Zero();
};
using LitPolygon = std::vector<LitVertex>;

// Leaves are cut at this fraction of the depth of the visible point, in front of which a vertex would be
// projected too far away or mirrored.
constexpr double kNearest = 1e-3;

// The part of the polygon where inside(vertex) >= 0, a linear function of homogeneous coordinates
// (Sutherland and Hodgman 1974). Light is linear along the edges in space, as in Ashdown's section 4.8.
template <class Inside>
void CutPolygon(const Inside& inside, LitPolygon& polygon) {
  LitPolygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const LitVertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double from = inside(a.at), to = inside(b.at);
    if (from >= 0) kept.push_back(a);
    if ((from >= 0) == (to >= 0)) continue;
    const double part = from / (from - to);
    kept.push_back({a.at + part * (b.at - a.at), a.light + part * (b.light - a.light)});
  }
  polygon.swap(kept);
}

// Light where a row of pixels crosses an edge of a polygon.
struct Crossing {
  double x = 0;
  Rgb light = Rgb::Zero();
};

// The crossings of the height y with the edges, the leftmost and the rightmost; nullopt if there are none.
std::optional<std::pair<Crossing, Crossing>> CrossRow(const LitPolygon& polygon, double y) {
  std::optional<std::pair<Crossing, Crossing>> span;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const LitVertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double ay = a.at.y / a.at.z, by = b.at.y / b.at.z;
    if (ay == by || y < std::min(ay, by) || y > std::max(ay, by)) continue;
    const double part = (y - ay) / (by - ay), ax = a.at.x / a.at.z, bx = b.at.x / b.at.z;
    const Crossing crossing = {ax + part * (bx - ax), a.light + part * (b.light - a.light)};
    if (!span) span.emplace(crossing, crossing);
    if (crossing.x < span->first.x) span->first = crossing;
    if (crossing.x > span->second.x) span->second = crossing;
  }
  return span;
}

}  // namespace

struct ReconstructedLight::Impl {
  Reconstruction kind;
  const ElementForest& forest;
  std::vector<VertexLight> light;
  ElementLocator locator;
  std::vector<std::optional<HermiteSurface>> surface;  // of the quadrilateral patches, with kBicubic

  Rgb At(const RayPoint& point) const;
  Rgb OnScreen(const RayPoint& point, const PixelRays& rays, int width, int height) const;
};

ReconstructedLight::ReconstructedLight(Reconstruction kind, const ElementForest& forest,
                                       std::vector<VertexLight> light) {
  auto impl = std::make_unique<Impl>(Impl{kind, forest, std::move(light), ElementLocator(forest), {}});
  if (kind == Reconstruction::kBicubic)
    for (std::size_t p = 0; p < impl->light.size(); ++p) {
      impl->surface.emplace_back();
      if (forest.scene().patches[p].size == 4)
        impl->surface.back().emplace(forest, static_cast<PatchId>(p), impl->light[p]);
    }
  impl_ = std::move(impl);
}

ReconstructedLight::~ReconstructedLight() = default;
ReconstructedLight::ReconstructedLight(ReconstructedLight&&) noexcept = default;

Rgb ReconstructedLight::Impl::At(const RayPoint& point) const {
  const auto patch = static_cast<std::size_t>(point.patch);
  const ElementLocator::Place place = locator.Find(point.patch, point.position);
  const Element& leaf = forest[place.element];
  const double s = std::clamp(place.s, 0.0, 1.0), t = std::clamp(place.t, 0.0, 1.0);
  if (kind != Reconstruction::kBicubic || !surface[patch]) return BilinearAt(leaf, light[patch], s, t);
  const double side = leaf.corner[1].x - leaf.corner[0].x;
  return surface[patch]
      ->At((leaf.corner[0].x + s * side) / kLatticeSize, (leaf.corner[0].y + t * side) / kLatticeSize)
      .value;
}

// The leaf at the point is cut to the picture, and its light is interpolated in the picture.
Rgb ReconstructedLight::Impl::OnScreen(const RayPoint& point, const PixelRays& rays, int width,
                                       int height) const {
  const Projection project = MakeProjection(rays);
  const auto homogeneous = [&](const Vec3& p) { return project(ToGlm(p) - rays.eye); };
  const glm::dvec3 seen = homogeneous(point.position);
  const Element& leaf = forest[locator.Find(point.patch, point.position).element];
  LitPolygon polygon;
  for (std::size_t k = 0; k < leaf.Corners().size(); ++k)
    polygon.push_back(
        {homogeneous(leaf.vertex[k]), light[static_cast<std::size_t>(point.patch)].at(leaf.corner[k])});
  CutPolygon([&](const glm::dvec3& h) { return h.z - kNearest * seen.z; }, polygon);
  CutPolygon([](const glm::dvec3& h) { return h.x; }, polygon);
  CutPolygon([&](const glm::dvec3& h) { return width * h.z - h.x; }, polygon);
  CutPolygon([](const glm::dvec3& h) { return h.y; }, polygon);
  CutPolygon([&](const glm::dvec3& h) { return height * h.z - h.y; }, polygon);
  const double x = seen.x / seen.z, y = seen.y / seen.z;
  const auto span = CrossRow(polygon, y);
  // A leaf that is seen edge-on may miss the point by rounding.
  if (!span) return At(point);
  const auto& [left, right] = *span;
  const double part = right.x > left.x ? std::clamp((x - left.x) / (right.x - left.x), 0.0, 1.0) : 0.0;
  return left.light + part * (right.light - left.light);
}

RayShader ReconstructedLight::Shade(const Camera& camera, int width, int height) const {
  const Impl* impl = impl_.get();
  const PixelRays rays = MakePixelRays(camera, width, height);
  if (impl->kind == Reconstruction::kGouraudScreen)
    return [=](const RayPoint& point) -> Rgb { return impl->OnScreen(point, rays, width, height).max(0.0); };
  return [=](const RayPoint& point) -> Rgb { return impl->At(point).max(0.0); };
}

ReconstructedLight ReconstructLight(Reconstruction kind, const RadiositySolution& solution,
                                    const std::function<const PointIrradiance&()>& exact,
                                    const ExecutionContext& context) {
  const bool by_means = kind == Reconstruction::kNodal || kind == Reconstruction::kGouraudScreen;
  return ReconstructedLight(kind, solution.forest,
                            by_means ? NodalAverages(solution.forest, solution.irradiance)
                                     : ExactAtVertices(solution.forest, exact(), context));
}

ReconstructedLight ReconstructLight(Reconstruction kind, const Pipeline& pipeline,
                                    const ExecutionContext& context) {
  const auto exact = [&]() -> const PointIrradiance& { return pipeline.irradiance(); };
  return ReconstructLight(kind, pipeline.solution(), exact, context);
}

}  // namespace penumbra
