#include "solver/transport/links/link_former.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "solver/visibility/pair/tube_blockers.h"

namespace penumbra {
namespace {

// Adds a link to the candidate, unless the two ends cannot see each other.
void AddLink(const LinkCandidate& candidate, ReceiverLinks* links) {
  const Scene& scene = links->forest.scene();
  const Element &receiver = links->forest[links->receiver], &source = links->forest[candidate.source];
  const std::optional<TubeEnds> ends = ClipToEachOther(receiver.Vertices(), scene.patches[receiver.patch],
                                                       source.Vertices(), scene.patches[source.patch]);
  if (!ends) return;

  Link link;
  link.receiver = links->receiver;
  link.source = candidate.source;
  link.first_blocker = static_cast<std::uint32_t>(links->set.blockers.size());
  TubeBlockers blockers;
  if (!FindTubeBlockers(scene, *ends, receiver.patch, source.patch, candidate.blockers, blockers)) return;
  LinkView view;
  view.blockers = std::move(blockers.first);
  links->set.blockers.insert(links->set.blockers.end(), blockers.all.begin(), blockers.all.end());
  link.blocker_count = static_cast<std::uint32_t>(links->set.blockers.size()) - link.first_blocker;
  link.visibility = link.blocker_count > 0 ? Visibility::kPartial : Visibility::kVisible;
  if (ends->receiver_clipped) {
    view.lit = ends->receiver;
    view.lit_fraction = std::min(1.0, VectorArea(ends->receiver).norm() / receiver.area);
  }
  links->set.links.push_back(link);
  links->views.push_back(std::move(view));
}

}  // namespace

LinkSet FormLinks(const ElementForest& forest, ElementId receiver, std::span<const LinkCandidate> candidates,
                  const LinkFormFactorMethod& form_factors, const ExecutionContext& context) {
  ReceiverLinks links{forest, receiver, {}, {}};
  for (const LinkCandidate& candidate : candidates) {
    if (context.Cancelled()) return {};
    AddLink(candidate, &links);
  }
  form_factors.Find(&links, context);
  return std::move(links.set);
}

}  // namespace penumbra
