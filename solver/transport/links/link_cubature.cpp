#include "solver/transport/links/link_cubature.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/transport/links/cubature.h"
#include "solver/visibility/point/clipping.h"
#include "solver/visibility/point/form_factor.h"
#include "solver/visibility/point/form_factor_batch.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra {
namespace {

// For receivers whose distance from the source is below this times their radius, the form factor is strongly
// curved near the contact, and the rule is refined.
constexpr double kNear = 1.0;
constexpr int kNearRefinement = 1;

// Sums over the sample points of one link's receiver.
struct PointSums {
  int refinement = 0;
  bool uniform = false;  // the source's radiosity stays constant: no factors of its quarters are needed
  std::array<std::array<Vec3, 4>, 4> quarters;
  std::array<double, 4> mean{};  // of the quarters' factors
  double mean_square = 0;        // of the sum of the quarters' factors
};

double Radius(const Element& element, const Vec3& centre) {
  double square = 0;
  for (const Vec3& v : element.Vertices()) square = std::max(square, (v - centre).squaredNorm());
  return std::sqrt(square);
}

// Unoccluded form factors of one point to many polygons, evaluated together. Each result, times its weight,
// is stored at an address that must stay valid.
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
    // The errors of the sums are negligible relative to the errors of the rule.
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

class LinkCubature {
 public:
  LinkCubature(ReceiverLinks& links, const ExecutionContext& context, const OcclusionMethod* occlusion)
      : links_(links),
        occlusion_(occlusion),
        forest_(links.forest),
        context_(context),
        receiver_(forest_[links.receiver]),
        patch_(forest_.scene().patches[receiver_.patch]),
        centre_(Centroid(receiver_.Vertices())),
        radius_(Radius(receiver_, centre_)) {}

  void Find() {
    sums_.reserve(links_.set.links.size());
    for (const Link& link : links_.set.links) sums_.push_back(Begin(link));
    // Points form the outer loop: one view of a blocker serves all sources. Links with the same rule share
    // the points.
    for (const int refinement : {0, kNearRefinement}) {
      std::vector<std::size_t> whole;
      for (std::size_t i = 0; i < sums_.size(); ++i) {
        if (sums_[i].refinement != refinement) continue;
        if (context_.Cancelled()) return;
        if (links_.views[i].lit.empty()) {
          whole.push_back(i);
        } else {
          Average(Cubature(links_.views[i].lit, refinement), {&i, 1});
        }
      }
      if (!whole.empty()) Average(Cubature(receiver_.Vertices(), refinement), whole);
    }
    for (std::size_t i = 0; i < sums_.size(); ++i)
      Finish(sums_[i], links_.views[i].lit_fraction, &links_.set.links[i]);
  }

 private:
  PointSums Begin(const Link& link) const {
    const Element& source = forest_[link.source];
    const Material& material = forest_.scene().materials[forest_.scene().patches[source.patch].material];
    const Vec3 source_centre = Centroid(source.Vertices());
    const double gap = (source_centre - centre_).norm() - Radius(source, source_centre) - radius_;
    PointSums sums;
    sums.refinement = gap < kNear * radius_ ? kNearRefinement : 0;
    sums.uniform = (material.reflectance == 0).all();
    sums.quarters = Quarters(source);
    return sums;
  }

  // Adds the means and the mean squares of the point form factors of the given links.
  void Average(const std::vector<CubaturePoint>& rule, std::span<const std::size_t> which) {
    for (const CubaturePoint& point : rule) {
      if (context_.Cancelled()) return;
      ReceiverPoint at;
      at.position = point.position;
      at.normal = patch_.normal;
      PointView view(forest_.scene(), at, occlusion_ ? *occlusion_ : FastestExactMethod());
      factors_.assign(which.size(), {});
      listed_.Clear();
      for (std::size_t k = 0; k < which.size(); ++k) FindFactors(view, which[k], &factors_[k]);
      listed_.Evaluate(at);
      for (std::size_t k = 0; k < which.size(); ++k) {
        PointSums& sums = sums_[which[k]];
        double sum = 0;
        for (std::size_t q = 0; q < 4; ++q) {
          sums.mean[q] += point.weight * factors_[k][q];
          sum += factors_[k][q];
        }
        sums.mean_square += point.weight * sum * sum;
      }
    }
  }

  // The form factors of a point to the quarters of a source. Unoccluded quarters are listed and evaluated
  // later.
  void FindFactors(PointView& view, std::size_t which, std::array<double, 4>* factor) {
    const PointSums& sums = sums_[which];
    const Element& source = forest_[links_.set.links[which].source];
    if (!view.FaceSource(source.patch)) return;
    std::vector<Occluder>& occluders = view.occluder_stack();
    occluders.clear();
    const std::vector<PatchId>& blockers = links_.views[which].blockers;
    if (!blockers.empty()) {
      const DirectionPolygon whole = view.SeeSource(source.Vertices());
      if (whole.empty() || !view.FindBlockers(blockers, receiver_.patch, whole, occluders)) return;
    }
    const bool clear = occluders.empty();
    const bool listed = clear && view.SourceIsPlain();
    if (sums.uniform) {
      if (listed)
        listed_.Add(source.Vertices(), 0.25, *factor);
      else
        factor->fill(0.25 * view.VisibleFormFactor(view.SeeSource(source.Vertices()), occluders));
      return;
    }
    std::array<DirectionPolygon, 4> seen;
    for (std::size_t q = 0; q < 4; ++q) {
      const std::span<const Vec3> quarter(sums.quarters[q].data(), static_cast<std::size_t>(source.size));
      if (listed) {
        listed_.Add(quarter, 1, {factor->data() + q, 1});
      } else {
        seen[q] = view.SeeSource(quarter);
        if (clear) (*factor)[q] = FormFactor(seen[q], patch_.normal);
      }
    }
    if (clear) return;
    if (occlusion_)
      for (std::size_t q = 0; q < 4; ++q) (*factor)[q] = view.VisibleFormFactor(seen[q], occluders);
    else
      VisibleFormFactors(view.SeeSource(source.Vertices()), seen, occluders, patch_.normal, *factor);
  }

  void Finish(const PointSums& sums, double lit_fraction, Link* link) const {
    double total = 0, unevenness = 0;
    for (const double mean : sums.mean) total += mean;
    link->form_factor = lit_fraction * total;
    link->variation =
        std::sqrt(std::max(0.0, lit_fraction * sums.mean_square - link->form_factor * link->form_factor));
    if (sums.uniform || total <= 0) return;
    const Element& source = forest_[link->source];
    for (std::size_t q = 0; q < 4; ++q) {
      const std::span<const Vec3> quarter(sums.quarters[q].data(), static_cast<std::size_t>(source.size));
      const double share = sums.mean[q] / total, fraction = VectorArea(quarter).norm() / source.area;
      link->share[q] = static_cast<float>(share);
      if (fraction == 0) continue;  // the lit part is as narrow as rounding
      unevenness += fraction * (share / fraction - 1) * (share / fraction - 1);
    }
    link->source_variation = static_cast<float>(std::sqrt(unevenness));
  }

  ReceiverLinks& links_;
  const OcclusionMethod* occlusion_;  // null: the fastest exact method
  const ElementForest& forest_;
  const ExecutionContext& context_;
  const Element& receiver_;
  const Patch& patch_;
  Vec3 centre_;
  double radius_;
  std::vector<PointSums> sums_;                 // for each link
  std::vector<std::array<double, 4>> factors_;  // of a point to the quarters of each source
  ListedFactors listed_;
};

}  // namespace

void FindByCubature(ReceiverLinks* links, const ExecutionContext& context, const OcclusionMethod* occlusion) {
  LinkCubature(*links, context, occlusion).Find();
}

}  // namespace penumbra
