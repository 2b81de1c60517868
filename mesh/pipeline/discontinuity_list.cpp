#include "mesh/pipeline/discontinuity_list.h"

#include "mesh/interpolants/reference_irradiance.h"
#include "mesh/refinement/local_pass.h"
#include "solver/base/parallel.h"

namespace penumbra {

DiscontinuityList ListDiscontinuities(const RadiositySolution& solution, const PatchVisibility& visibility,
                                      const DiscontinuityOptions& options, const ExecutionContext& context) {
  const Scene& scene = solution.forest.scene();
  const std::vector<double> strength = SourceStrengths(solution);
  const DiscontinuityFinder finder(scene, visibility);
  std::vector<std::vector<Discontinuity>> found(scene.patches.size());
  const ReferenceIrradiance light(solution, options.weight);
  ParallelFor(found.size(), 1, [&](std::size_t p) {
    if (context.Cancelled()) return;
    const auto patch = static_cast<PatchId>(p);
    found[p] = finder.Find(patch, strength, light.ToFindOn(patch, options), context);
  });
  DiscontinuityList list;
  if (context.Cancelled()) return list;
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
