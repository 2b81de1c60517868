#include "solver/transport/links/link_former.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "solver/transport/links/approximate_form_factor.h"
#include "solver/transport/links/cubature.h"
#include "solver/visibility/area/area_form_factor.h"
#include "solver/visibility/pair/tube_blockers.h"
#include "solver/visibility/point/clipping.h"
#include "solver/visibility/point/form_factor.h"
#include "solver/visibility/point/form_factor_batch.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra {
namespace {

// Receivers nearer to the source than this many of their own radii see the form factor bend towards the
// contact: the rule is refined there.
constexpr double kNear = 1.0;
constexpr int kNearRefinement = 1;

// A candidate that may shed light on the receiver.
struct Pending {
  std::size_t link = 0;
  std::vector<PatchId> blockers;  // as many of the link's as tell what is blocked
  Polygon3 lit;                   // the receiver's part before the source's plane; empty if that is all of it
  double lit_fraction = 1;        // of its area
  int refinement = 0;
  bool uniform = false;  // the source has one radiosity for good: its quarters need no factors of their own
  std::array<std::array<Vec3, 4>, 4> quarters;
  std::array<double, 4> mean{};  // of the factors of the quarters
  double mean_square = 0;        // of their sum
};

double Radius(const Element& element, const Vec3& centre) {
  double square = 0;
  for (const Vec3& v : element.Vertices()) square = std::max(square, (v - centre).squaredNorm());
  return std::sqrt(square);
}

// Form factors of one point to polygons that nothing hides, evaluated together. Each goes, times its weight,
// to places that must stay.
class ListedFactors {
 public:
  void Clear() {
    polygons_.Clear();
    results_.clear();
  }
  void Add(std::span<const Vec3> polygon, double weight, std::span<double> to) {
    polygons_.Add(polygon);
    results_.push_back({weight, to});
  }
  void Evaluate(const ReceiverPoint& at) {
    const std::size_t count = results_.size();
    // What the sums lose is nothing beside what the rule does.
    sums_.Find(polygons_, 0, count, at.position, at.normal);
    for (std::size_t i = 0; i < count; ++i)
      std::fill(results_[i].to.begin(), results_[i].to.end(),
                results_[i].weight * std::max(0.0, sums_.Factor(i)));
  }

 private:
  struct Result {
    double weight;
    std::span<double> to;
  };
  PolygonBatch polygons_;
  std::vector<Result> results_;
  FormFactorSums sums_;
};

class Former {
 public:
  Former(const ElementForest& forest, ElementId receiver, LinkFormFactors form_factors,
         const ExecutionContext& context)
      : forest_(forest),
        form_factors_(form_factors),
        context_(context),
        receiver_(forest[receiver]),
        id_(receiver),
        patch_(forest.scene().patches[receiver_.patch]),
        centre_(Centroid(receiver_.Vertices())),
        radius_(Radius(receiver_, centre_)) {}

  LinkSet Form(std::span<const LinkCandidate> candidates) {
    for (const LinkCandidate& candidate : candidates) {
      if (context_.Cancelled()) return {};
      Consider(candidate);
    }
    // Points outermost: what a point sees of a blocker serves all sources. Groups of equal rules share their
    // points.
    for (int refinement : {0, kNearRefinement}) {
      std::vector<std::size_t> whole;
      for (std::size_t i = 0; i < pending_.size(); ++i) {
        if (pending_[i].refinement != refinement) continue;
        if (context_.Cancelled()) return {};
        if (pending_[i].lit.empty()) {
          whole.push_back(i);
        } else {
          Average(Cubature(pending_[i].lit, refinement), {&i, 1});
        }
      }
      if (!whole.empty()) Average(Cubature(receiver_.Vertices(), refinement), whole);
    }
    for (const Pending& pending : pending_) {
      if (context_.Cancelled()) return {};
      Finish(pending);
    }
    return std::move(set_);
  }

 private:
  void Consider(const LinkCandidate& candidate) {
    const Element& source = forest_[candidate.source];
    const Patch& source_patch = forest_.scene().patches[source.patch];
    const std::optional<TubeEnds> ends =
        ClipToEachOther(receiver_.Vertices(), patch_, source.Vertices(), source_patch);
    if (!ends) return;

    Link link;
    link.receiver = id_;
    link.source = candidate.source;
    link.first_blocker = static_cast<std::uint32_t>(set_.blockers.size());
    Pending pending;
    if (!FindTubeBlockers(forest_.scene(), *ends, receiver_.patch, source.patch, candidate.blockers,
                          set_.blockers, pending.blockers))
      return;
    link.blocker_count = static_cast<std::uint32_t>(set_.blockers.size()) - link.first_blocker;
    link.visibility = link.blocker_count > 0 ? Visibility::kPartial : Visibility::kVisible;

    pending.link = set_.links.size();
    if (ends->receiver_clipped) {
      pending.lit = ends->receiver;
      pending.lit_fraction = std::min(1.0, VectorArea(ends->receiver).norm() / receiver_.area);
    }
    const Vec3 source_centre = Centroid(source.Vertices());
    const double gap = (source_centre - centre_).norm() - Radius(source, source_centre) - radius_;
    pending.refinement = gap < kNear * radius_ ? kNearRefinement : 0;
    pending.uniform = (forest_.scene().materials[source_patch.material].reflectance == 0).all();
    pending.quarters = Quarters(source);
    set_.links.push_back(link);
    pending_.push_back(std::move(pending));
  }

  void Finish(const Pending& pending) {
    Link& link = set_.links[pending.link];
    double total = 0, unevenness = 0;
    for (const double mean : pending.mean) total += mean;
    link.form_factor = pending.lit_fraction * total;
    link.variation = std::sqrt(
        std::max(0.0, pending.lit_fraction * pending.mean_square - link.form_factor * link.form_factor));
    if (form_factors_ == LinkFormFactors::kExact) link.form_factor = ExactFactor(link);
    if (form_factors_ == LinkFormFactors::kDisk) link.form_factor = DiskFactorOf(link, pending);
    if (pending.uniform || total <= 0) return;
    const double area = forest_[link.source].area;
    for (std::size_t q = 0; q < 4; ++q) {
      const std::span<const Vec3> quarter(pending.quarters[q].data(),
                                          static_cast<std::size_t>(forest_[link.source].size));
      const double share = pending.mean[q] / total, fraction = VectorArea(quarter).norm() / area;
      link.share[q] = static_cast<float>(share);
      if (fraction == 0) continue;  // no wider than a rounding
      unevenness += fraction * (share / fraction - 1) * (share / fraction - 1);
    }
    link.source_variation = static_cast<float>(std::sqrt(unevenness));
  }

  double DiskFactorOf(const Link& link, const Pending& pending) const {
    const Element& source = forest_[link.source];
    ReceiverPoint at;
    at.position = pending.lit.empty() ? centre_ : Centroid(pending.lit);
    at.normal = patch_.normal;
    PointView view(forest_.scene(), at);
    if (!view.FaceSource(source.patch)) return 0;
    const DirectionPolygon seen = view.SeeSource(source.Vertices());
    std::vector<Occluder>& occluders = view.occluder_stack();
    if (seen.empty() || !view.FindBlockers(set_.Blockers(link), receiver_.patch, seen, occluders)) return 0;
    const double whole = FormFactor(seen, at.normal);
    if (whole <= 0) return 0;
    const double disk = DiskFactor(at.position, at.normal, Centroid(source.Vertices()),
                                   forest_.scene().patches[source.patch].normal, source.area);
    return pending.lit_fraction * disk * view.VisibleFormFactor(seen, occluders) / whole;
  }

  double ExactFactor(const Link& link) const {
    const Element& source = forest_[link.source];
    const auto part = [](const Element& element) {
      return AreaPart{element.patch, {element.Vertices().begin(), element.Vertices().end()}};
    };
    const std::span<const PatchId> blockers = set_.Blockers(link);
    AreaFormFactorOptions options;
    options.tolerance = kExactLinkTolerance;
    options.max_points = kExactLinkPoints;
    options.context = &context_;
    const PatchHierarchy between(forest_.scene(), {blockers.begin(), blockers.end()});
    return AreaFormFactor(forest_.scene(), between, part(receiver_), part(source), options).factor;
  }

  // Adds the means and the mean squares of the point form factors of the given links.
  void Average(const std::vector<CubaturePoint>& rule, std::span<const std::size_t> which) {
    for (const CubaturePoint& point : rule) {
      if (context_.Cancelled()) return;
      ReceiverPoint at;
      at.position = point.position;
      at.normal = patch_.normal;
      PointView view(forest_.scene(), at);
      factors_.assign(which.size(), {});
      listed_.Clear();
      for (std::size_t k = 0; k < which.size(); ++k) FindFactors(view, pending_[which[k]], &factors_[k]);
      listed_.Evaluate(at);
      for (std::size_t k = 0; k < which.size(); ++k) {
        Pending& pending = pending_[which[k]];
        double sum = 0;
        for (std::size_t q = 0; q < 4; ++q) {
          pending.mean[q] += point.weight * factors_[k][q];
          sum += factors_[k][q];
        }
        pending.mean_square += point.weight * sum * sum;
      }
    }
  }

  // The form factors of a point to the quarters of a source, those that nothing hides once they are
  // evaluated.
  void FindFactors(PointView& view, const Pending& pending, std::array<double, 4>* factor) {
    const Link& link = set_.links[pending.link];
    const Element& source = forest_[link.source];
    if (!view.FaceSource(source.patch)) return;
    std::vector<Occluder>& occluders = view.occluder_stack();
    occluders.clear();
    if (!pending.blockers.empty()) {
      const DirectionPolygon whole = view.SeeSource(source.Vertices());
      if (whole.empty() || !view.FindBlockers(pending.blockers, receiver_.patch, whole, occluders)) return;
    }
    const bool clear = occluders.empty();
    const bool listed = clear && view.SourceIsPlain();
    if (pending.uniform) {
      if (listed)
        listed_.Add(source.Vertices(), 0.25, *factor);
      else
        factor->fill(0.25 * view.VisibleFormFactor(view.SeeSource(source.Vertices()), occluders));
      return;
    }
    std::array<DirectionPolygon, 4> seen;
    for (std::size_t q = 0; q < 4; ++q) {
      const std::span<const Vec3> quarter(pending.quarters[q].data(), static_cast<std::size_t>(source.size));
      if (listed) {
        listed_.Add(quarter, 1, {factor->data() + q, 1});
      } else {
        seen[q] = view.SeeSource(quarter);
        if (clear) (*factor)[q] = FormFactor(seen[q], patch_.normal);
      }
    }
    if (!clear)
      VisibleFormFactors(view.SeeSource(source.Vertices()), seen, occluders, patch_.normal, *factor);
  }

  const ElementForest& forest_;
  LinkFormFactors form_factors_;
  const ExecutionContext& context_;
  const Element& receiver_;
  ElementId id_;
  const Patch& patch_;
  Vec3 centre_;
  double radius_;
  LinkSet set_;
  std::vector<Pending> pending_;
  std::vector<std::array<double, 4>> factors_;  // of a point to the quarters of each source
  ListedFactors listed_;
};

}  // namespace

LinkSet FormLinks(const ElementForest& forest, ElementId receiver, std::span<const LinkCandidate> candidates,
                  LinkFormFactors form_factors, const ExecutionContext& context) {
  return Former(forest, receiver, form_factors, context).Form(candidates);
}

}  // namespace penumbra
