#include "solver/transport/form_factors/projected_form_factor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/base/parallel.h"
#include "solver/base/random.h"
#include "solver/transport/form_factors/item_buffer.h"
#include "solver/transport/links/cubature.h"
#include "solver/transport/links/link_cubature.h"

namespace penumbra {
namespace {

// The refinement of Cubature() for links, and for senders of form factors between areas.
constexpr int kPointsOfLink = 0, kPointsOfSender = 1;

// The eye at a point of a patch, turned about the normal by a random angle.
Eye TurnedEye(const Scene& scene, PatchId own, const Vec3& position, const Random& random) {
  const Frame frame = MakeFrame(position, scene.patches[static_cast<std::size_t>(own)].normal);
  const double angle = Random(random).Uniform(0, 2 * std::numbers::pi);
  Eye eye;
  eye.own = own;
  eye.position = position;
  eye.x = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
  eye.y = std::cos(angle) * frame.v - std::sin(angle) * frame.u;
  eye.z = frame.n;
  return eye;
}

// All blockers of the links, each once, and then the sources as targets.
std::vector<DrawnPolygon> PolygonsOf(const ReceiverLinks& links) {
  const Scene& scene = links.forest.scene();
  std::vector<PatchId> blockers;
  for (const LinkView& view : links.views)
    blockers.insert(blockers.end(), view.blockers.begin(), view.blockers.end());
  std::sort(blockers.begin(), blockers.end());
  blockers.erase(std::unique(blockers.begin(), blockers.end()), blockers.end());
  std::vector<DrawnPolygon> polygons;
  for (const PatchId blocker : blockers)
    polygons.push_back({blocker, scene.patches[static_cast<std::size_t>(blocker)].Vertices(), -1});
  for (std::size_t i = 0; i < links.set.links.size(); ++i) {
    const Element& source = links.forest[links.set.links[i].source];
    polygons.push_back({source.patch, source.Vertices(), static_cast<std::int32_t>(i)});
  }
  return polygons;
}

double LargestDelta(const std::vector<PlaneGrid>& planes) {
  double largest = 0;
  for (const PlaneGrid& plane : planes)
    largest = std::max(largest, *std::max_element(plane.delta.begin(), plane.delta.end()));
  return largest;
}

double EscapedFlux(const std::vector<PlaneGrid>& planes) {
  double seen = 0;
  for (const PlaneGrid& plane : planes) seen += SumOfDeltas(plane);
  return std::max(0.0, 1 - seen);
}

}  // namespace

// The two sides of a form factor between areas, and all that is drawn.
struct ProjectedFormFactor::Areas {
  const Scene& scene;
  std::span<const AreaPart> from;
  std::vector<DrawnPolygon> polygons;
};

ProjectedFormFactor::ProjectedFormFactor(const PlaneMaker& planes, int standard,
                                         const LinkFormFactorOptions& options)
    : maker_(planes),
      resolution_(options.resolution > 0 ? static_cast<int>(options.resolution) : standard),
      planes_(planes(resolution_)),
      seed_(options.seed),
      factors_only_(options.factors_only) {}

void ProjectedFormFactor::Find(ReceiverLinks* links, const ExecutionContext& context) const {
  if (!factors_only_) FindByCubature(links, context);
  std::vector<double> factors(links->set.links.size(), 0);
  const Scene& scene = links->forest.scene();
  const Element& receiver = links->forest[links->receiver];
  const std::vector<DrawnPolygon> polygons = PolygonsOf(*links);
  std::uint64_t place = static_cast<std::uint64_t>(links->receiver) << 8U;  // distinct for each point
  for (const CubaturePoint& point : Cubature(receiver.Vertices(), kPointsOfLink)) {
    const Eye eye = TurnedEye(scene, receiver.patch, point.position, Random(seed_, place++));
    for (const PlaneGrid& plane : planes_) {
      if (context.Cancelled()) return;
      ItemBuffer(plane, scene, eye, polygons).AddFactors(point.weight, factors);
    }
  }
  for (std::size_t i = 0; i < factors.size(); ++i) links->set.links[i].form_factor = factors[i];
}

double ProjectedFormFactor::Mean(const Areas& areas, const std::vector<PlaneGrid>& planes, int refinement,
                                 const ExecutionContext& context) const {
  struct Station {
    PatchId patch;
    CubaturePoint point;
  };
  std::vector<Station> stations;
  double area = 0;
  for (const AreaPart& part : areas.from) {
    const double weight = VectorArea(part.polygon).norm();
    area += weight;
    for (const CubaturePoint& point : Cubature(part.polygon, refinement))
      stations.push_back({part.patch, {point.position, weight * point.weight}});
  }
  std::vector<double> seen(stations.size(), 0);
  ParallelFor(stations.size(), 1, [&](std::size_t i) {
    const Station& at = stations[i];
    const Eye eye = TurnedEye(areas.scene, at.patch, at.point.position, Random(seed_, i));
    for (const PlaneGrid& plane : planes)
      if (!context.Cancelled())
        ItemBuffer(plane, areas.scene, eye, areas.polygons).AddFactors(at.point.weight, {&seen[i], 1});
  });
  double sum = 0;
  for (const double s : seen) sum += s;
  return area > 0 ? sum / area : 0;
}

std::optional<FormFactorEstimate> ProjectedFormFactor::Between(const Scene& scene,
                                                               std::span<const AreaPart> from,
                                                               std::span<const AreaPart> to,
                                                               const ExecutionContext& context) const {
  Areas areas{scene, from, {}};
  for (std::size_t p = 0; p < scene.patches.size(); ++p)
    areas.polygons.push_back({static_cast<PatchId>(p), scene.patches[p].Vertices(), -1});
  for (const AreaPart& part : to) areas.polygons.push_back({part.patch, part.polygon, 0});
  const double fine = Mean(areas, planes_, kPointsOfSender, context);
  const double coarse = Mean(areas, maker_(std::max(1, resolution_ / 2)), kPointsOfSender - 1, context);
  std::size_t points = 0;
  for (const AreaPart& part : from) points += Cubature(part.polygon, kPointsOfSender).size();
  FormFactorEstimate estimate;
  estimate.factor = fine;
  estimate.points = points;
  if (points > 0)
    estimate.error = std::abs(fine - coarse) + EscapedFlux(planes_) +
                     LargestDelta(planes_) / std::sqrt(static_cast<double>(points));
  return estimate;
}

}  // namespace penumbra
