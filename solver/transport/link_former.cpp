#include "solver/transport/link_former.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "solver/transport/cubature.h"
#include "solver/visibility/point_view.h"
#include "solver/visibility/tube.h"

namespace penumbra {
namespace {

// Receivers nearer to the source than this many of their own radii see the form factor bend towards the
// contact: the rule is refined twice there. Beyond, the 9-point rule is good to about 1e-4 of the form
// factor.
constexpr double kNear = 1.0;
constexpr int kNearRefinement = 2;

// A candidate that may shed light on the receiver.
struct Pending {
  std::size_t link = 0;
  Polygon3 lit;             // the receiver's part before the source's plane; empty if that is all of it
  double lit_fraction = 1;  // of its area
  int refinement = 0;
  double mean = 0, mean_square = 0;
};

double Radius(const Element& element, const Vec3& centre) {
  double square = 0;
  for (const Vec3& v : element.Vertices()) square = std::max(square, (v - centre).squaredNorm());
  return std::sqrt(square);
}

double Highest(std::span<const Vec3> polygon, const Patch& above) {
  double highest = -INFINITY;
  for (const Vec3& v : polygon) highest = std::max(highest, above.normal.dot(v - above.vertex[0]));
  return highest;
}

double Lowest(std::span<const Vec3> polygon, const Patch& above) {
  double lowest = INFINITY;
  for (const Vec3& v : polygon) lowest = std::min(lowest, above.normal.dot(v - above.vertex[0]));
  return lowest;
}

class Former {
 public:
  Former(const ElementForest& forest, ElementId receiver)
      : forest_(forest),
        receiver_(forest[receiver]),
        id_(receiver),
        patch_(forest.scene().patches[receiver_.patch]),
        centre_(Centroid(receiver_.Vertices())),
        radius_(Radius(receiver_, centre_)) {}

  LinkSet Form(std::span<const LinkCandidate> candidates) {
    for (const LinkCandidate& candidate : candidates) Consider(candidate);
    // Points outermost: what a point sees of a blocker serves all sources. Groups of equal rules share their
    // points.
    for (int refinement : {0, kNearRefinement}) {
      std::vector<std::size_t> whole;
      for (std::size_t i = 0; i < pending_.size(); ++i) {
        if (pending_[i].refinement != refinement) continue;
        if (pending_[i].lit.empty()) {
          whole.push_back(i);
        } else {
          Average(Cubature(pending_[i].lit, refinement), {&i, 1});
        }
      }
      if (!whole.empty()) Average(Cubature(receiver_.Vertices(), refinement), whole);
    }
    for (const Pending& pending : pending_) {
      Link& link = set_.links[pending.link];
      link.form_factor = pending.lit_fraction * pending.mean;
      link.variation = std::sqrt(
          std::max(0.0, pending.lit_fraction * pending.mean_square - link.form_factor * link.form_factor));
    }
    return std::move(set_);
  }

 private:
  void Consider(const LinkCandidate& candidate) {
    const Element& source = forest_[candidate.source];
    const Patch& source_patch = forest_.scene().patches[source.patch];
    const double rounding = HeightRounding(std::max(patch_.extent, source_patch.extent));
    if (Highest(receiver_.Vertices(), source_patch) <= rounding ||
        Highest(source.Vertices(), patch_) <= rounding)
      return;

    Pending pending;
    pending.link = set_.links.size();
    Polygon3 receiver(receiver_.Vertices().begin(), receiver_.Vertices().end());
    Polygon3 seen(source.Vertices().begin(), source.Vertices().end());
    if (Lowest(receiver, source_patch) < -rounding) {
      receiver = ClipToHalfSpace(receiver, source_patch.normal, source_patch.vertex[0]);
      if (receiver.empty()) return;
      pending.lit = receiver;
      pending.lit_fraction = std::min(1.0, VectorArea(receiver).norm() / receiver_.area);
    }
    if (Lowest(seen, patch_) < -rounding) {
      seen = ClipToHalfSpace(seen, patch_.normal, patch_.vertex[0]);
      if (seen.empty()) return;
    }

    Link link;
    link.receiver = id_;
    link.source = candidate.source;
    link.first_blocker = static_cast<std::uint32_t>(set_.blockers.size());
    if (!candidate.blockers.empty()) {
      const Tube tube(receiver, seen);
      for (const PatchId blocker : candidate.blockers) {
        const Patch& patch = forest_.scene().patches[blocker];
        if (tube.Misses(patch.Vertices(), patch.normal)) continue;
        if (tube.HiddenBy(patch.Vertices(), patch.normal)) {
          set_.blockers.resize(link.first_blocker);
          return;
        }
        set_.blockers.push_back(blocker);
      }
    }
    link.blocker_count = static_cast<std::uint32_t>(set_.blockers.size()) - link.first_blocker;
    link.visibility = link.blocker_count > 0 ? Visibility::kPartial : Visibility::kVisible;

    const Vec3 source_centre = Centroid(source.Vertices());
    const double gap = (source_centre - centre_).norm() - Radius(source, source_centre) - radius_;
    pending.refinement = gap < kNear * radius_ ? kNearRefinement : 0;
    set_.links.push_back(link);
    pending_.push_back(std::move(pending));
  }

  // Adds the mean and the mean square of the point form factors of the given links.
  void Average(const std::vector<CubaturePoint>& rule, std::span<const std::size_t> which) {
    for (const CubaturePoint& point : rule) {
      ReceiverPoint at;
      at.position = point.position;
      at.normal = patch_.normal;
      PointView view(forest_.scene(), at);
      for (const std::size_t i : which) {
        const double factor = PointFactor(view, set_.links[pending_[i].link]);
        pending_[i].mean += point.weight * factor;
        pending_[i].mean_square += point.weight * factor * factor;
      }
    }
  }

  double PointFactor(PointView& view, const Link& link) const {
    const Element& source = forest_[link.source];
    if (!view.FaceSource(source.patch)) return 0;
    const DirectionPolygon seen = view.SeeSource(source.Vertices());
    if (seen.empty()) return 0;
    std::vector<const Cone*>& cones = view.cone_stack();
    cones.clear();
    if (!view.FindBlockers(set_.Blockers(link), receiver_.patch, seen, cones)) return 0;
    return view.VisibleFormFactor(seen, cones);
  }

  const ElementForest& forest_;
  const Element& receiver_;
  ElementId id_;
  const Patch& patch_;
  Vec3 centre_;
  double radius_;
  LinkSet set_;
  std::vector<Pending> pending_;
};

}  // namespace

LinkSet FormLinks(const ElementForest& forest, ElementId receiver,
                  std::span<const LinkCandidate> candidates) {
  return Former(forest, receiver).Form(candidates);
}

}  // namespace penumbra
