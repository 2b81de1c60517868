#include "mesh/discontinuity_list.h"

#include "mesh/local_pass.h"
#include "solver/base/parallel.h"

namespace penumbra {

DiscontinuityList ListDiscontinuities(const RadiositySolution& solution, const PatchVisibility& visibility,
                                      DiscontinuityOptions options, const ExecutionContext& context) {
  if (options.can_want()) options.min_weight = options.min_wanted_weight;
  const Scene& scene = solution.forest.scene();
  const std::vector<double> strength = SourceStrengths(solution);
  const DiscontinuityFinder finder(scene, visibility);
  std::vector<std::vector<Discontinuity>> found(scene.patches.size());
  ParallelFor(found.size(), 1, [&](std::size_t p) {
    if (!context.Cancelled()) found[p] = finder.Find(static_cast<PatchId>(p), strength, options);
  });
  DiscontinuityList list;
  for (std::size_t p = 0; p < found.size(); ++p) {
    const Frame frame = PolygonFrame(scene.patches[p].Vertices());
    for (const Discontinuity& d : found[p]) {
      list.all.push_back(d);
      list.ends.push_back({frame.FromPlane(d.end[0]), frame.FromPlane(d.end[1])});
    }
  }
  return list;
}

}  // namespace penumbra
