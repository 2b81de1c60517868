#include "solver/transport/links/push_pull.h"

#include <algorithm>
#include <cmath>

#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

// Elements in one task of gathering.
constexpr std::size_t kGatherGrain = 256;

// The radiosity of a link's source as seen by its receiver: the mean of its children's radiosities, weighted
// by the shares.
Rgb SourceRadiosity(const ElementForest& forest, const Link& link, std::span<const Rgb> radiosity) {
  const ElementId first = forest[link.source].first_child;
  if (first == kNoElement) return radiosity[static_cast<std::size_t>(link.source)];
  Rgb sum = Rgb::Zero();
  for (std::size_t q = 0; q < 4; ++q)
    sum += static_cast<double>(link.share[q]) * radiosity[static_cast<std::size_t>(first) + q];
  return sum;
}

}  // namespace

PushPull::PushPull(RadiositySolution& solution) : solution_(solution) { Update(); }

void PushPull::Update() {
  scale_.clear();
  const ElementForest& forest = solution_.forest;
  const std::size_t count = forest.size(), patches = forest.scene().patches.size();
  first_link_.assign(count + 1, 0);
  for (const Link& link : solution_.links.links) ++first_link_[static_cast<std::size_t>(link.receiver) + 1];
  for (std::size_t e = 0; e < count; ++e) first_link_[e + 1] += first_link_[e];

  // Children have larger numbers than their parents, so the order is parents first.
  first_of_patch_.assign(patches + 1, 0);
  for (const Element& element : forest.elements())
    ++first_of_patch_[static_cast<std::size_t>(element.patch) + 1];
  for (std::size_t p = 0; p < patches; ++p) first_of_patch_[p + 1] += first_of_patch_[p];
  std::vector<std::size_t> next(first_of_patch_.begin(), first_of_patch_.end() - 1);
  order_.resize(count);
  for (std::size_t e = 0; e < count; ++e)
    order_[next[static_cast<std::size_t>(forest.elements()[e].patch)]++] = static_cast<ElementId>(e);
  leaves_.clear();
  for (const ElementId id : order_)
    if (forest[id].IsLeaf()) leaves_.push_back(id);

  const std::size_t before = solution_.radiosity.size();
  solution_.irradiance.resize(count, Rgb::Zero());
  solution_.radiosity.resize(count, Rgb::Zero());
  solution_.radiosity_spread.resize(count, 0);
  solution_.spread_below.resize(count, 0);
  for (std::size_t e = before; e < count; ++e) {
    const Element& element = forest.elements()[e];
    if (element.parent == kNoElement) {
      solution_.radiosity[e] = forest.scene().MaterialOf(element.patch).emittance;
    } else {
      solution_.irradiance[e] = solution_.irradiance[static_cast<std::size_t>(element.parent)];
      solution_.radiosity[e] = solution_.radiosity[static_cast<std::size_t>(element.parent)];
    }
  }
}

Rgb PushPull::Gathered(ElementId receiver, std::span<const Rgb> radiosity) const {
  Rgb sum = Rgb::Zero();
  for (std::size_t i = FirstLink(receiver); i < EndLink(receiver); ++i) {
    const Link& link = solution_.links.links[i];
    sum += link.form_factor * SourceRadiosity(solution_.forest, link, radiosity);
  }
  return sum;
}

void PushPull::Balance(std::span<const double> closure) {
  scale_.clear();
  const std::vector<Rgb> sum = Transport(std::vector<Rgb>(solution_.forest.size(), Rgb::Ones()));
  scale_.assign(solution_.forest.size(), 1);
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    const auto leaf = static_cast<std::size_t>(leaves_[i]);
    if (sum[leaf][0] > 0) scale_[leaf] = closure[i] / sum[leaf][0];
  }
}

// Adds the irradiance of parents to that of their children, and scales leaves (Balance).
void PushPull::Push(std::size_t patch, std::span<Rgb> irradiance) const {
  for (const ElementId id : ElementsOf(patch)) {
    const ElementId first = solution_.forest[id].first_child;
    if (first == kNoElement) {
      if (!scale_.empty()) irradiance[static_cast<std::size_t>(id)] *= scale_[static_cast<std::size_t>(id)];
      continue;
    }
    for (std::size_t q = 0; q < 4; ++q)
      irradiance[static_cast<std::size_t>(first) + q] += irradiance[static_cast<std::size_t>(id)];
  }
}

// Sets the values of inner elements to the area-weighted means of the leaves below.
template <class Value>
void PushPull::Average(std::size_t patch, std::vector<Value>& values) const {
  const std::span<const ElementId> elements = ElementsOf(patch);
  for (auto id = elements.rbegin(); id != elements.rend(); ++id) {
    const ElementId first = solution_.forest[*id].first_child;
    if (first == kNoElement) continue;
    Value sum = Value::Zero();
    double area = 0;
    for (ElementId child = first; child < first + 4; ++child) {
      sum += solution_.forest[child].area * values[static_cast<std::size_t>(child)];
      area += solution_.forest[child].area;
    }
    values[static_cast<std::size_t>(*id)] =
        area > 0 ? Value(sum / area) : values[static_cast<std::size_t>(first)];
  }
}

void PushPull::Light(ElementId leaf, const Rgb& irradiance) {
  const Material& material = solution_.forest.scene().MaterialOf(solution_.forest[leaf].patch);
  solution_.irradiance[leaf] = irradiance.max(0.0);
  solution_.radiosity[leaf] = material.emittance + material.reflectance * solution_.irradiance[leaf];
}

void PushPull::Pull() {
  ParallelFor(first_of_patch_.size() - 1, 1, [&](std::size_t p) {
    Average(p, solution_.irradiance);
    Average(p, solution_.radiosity);
  });
}

// Sets the light of a patch from the gathered irradiance of its elements. Returns the largest change of a
// leaf's radiosity.
Rgb PushPull::LightPatch(std::size_t patch, std::span<Rgb> pushed, std::span<const Rgb> correction) {
  Push(patch, pushed);
  Rgb change = Rgb::Zero();
  for (const ElementId id : ElementsOf(patch)) {
    if (!solution_.forest[id].IsLeaf()) continue;
    const auto e = static_cast<std::size_t>(id);
    const Rgb before = solution_.radiosity[e];
    Light(id, correction.empty() ? pushed[e] : Rgb(pushed[e] + correction[e]));
    change = change.max((solution_.radiosity[e] - before).abs());
  }
  Average(patch, solution_.irradiance);
  Average(patch, solution_.radiosity);
  return change;
}

Rgb PushPull::Sweep(IterationScheme scheme, std::span<const Rgb> correction) {
  const std::size_t patches = first_of_patch_.size() - 1;
  std::vector<Rgb> pushed(solution_.forest.size());
  std::vector<Rgb> change(patches);
  if (scheme == IterationScheme::kJacobi) {
    ParallelFor(pushed.size(), kGatherGrain,
                [&](std::size_t e) { pushed[e] = Gathered(static_cast<ElementId>(e), solution_.radiosity); });
    ParallelFor(patches, 1, [&](std::size_t p) { change[p] = LightPatch(p, pushed, correction); });
  } else {
    for (std::size_t p = 0; p < patches; ++p) {
      const std::span<const ElementId> elements = ElementsOf(p);
      ParallelFor(elements.size(), kGatherGrain, [&](std::size_t i) {
        pushed[static_cast<std::size_t>(elements[i])] = Gathered(elements[i], solution_.radiosity);
      });
      change[p] = LightPatch(p, pushed, correction);
    }
  }
  Rgb largest = Rgb::Zero();
  for (const Rgb& c : change) largest = largest.max(c);
  return largest;
}

std::vector<Rgb> PushPull::Transport(std::span<const Rgb> radiosity) const {
  std::vector<Rgb> irradiance(solution_.forest.size());
  ParallelFor(irradiance.size(), kGatherGrain,
              [&](std::size_t e) { irradiance[e] = Gathered(static_cast<ElementId>(e), radiosity); });
  ParallelFor(first_of_patch_.size() - 1, 1, [&](std::size_t p) {
    Push(p, irradiance);
    Average(p, irradiance);
  });
  return irradiance;
}

void PushPull::UpdateSpreads() {
  RadiositySolution& s = solution_;
  ParallelFor(first_of_patch_.size() - 1, 1, [&](std::size_t p) {
    const std::span<const ElementId> elements = ElementsOf(p);
    for (auto id = elements.rbegin(); id != elements.rend(); ++id) {
      const Element& element = s.forest[*id];
      double variance = 0, below_variance = 0, area = 0;
      for (ElementId child = element.first_child; !element.IsLeaf() && child < element.first_child + 4;
           ++child) {
        const double a = s.forest[child].area;
        const double deviation = (s.radiosity[child] - s.radiosity[*id]).abs().maxCoeff();
        const double below = s.radiosity_spread[child];
        variance += a * (deviation * deviation + below * below);
        below_variance += a * below * below;
        area += a;
      }
      s.spread_below[*id] = area > 0 ? std::sqrt(below_variance / area) : 0;
      s.radiosity_spread[*id] = area > 0 ? std::sqrt(variance / area) : 0;
    }
  });
}

double PushPull::LargestReflected() const {
  double largest = 0;
  for (const ElementId leaf : leaves_) {
    const Material& material = solution_.forest.scene().MaterialOf(solution_.forest[leaf].patch);
    largest = std::max(largest, (solution_.radiosity[leaf] - material.emittance).maxCoeff());
  }
  return largest;
}

void ReplaceIrradiance(std::span<const Rgb> element, std::span<const Rgb> fragment,
                       RadiositySolution& solution) {
  PENUMBRA_CHECK(element.size() == solution.forest.size() && fragment.size() == solution.fragments.size());
  PushPull light(solution);
  for (const ElementId leaf : light.leaves()) light.Light(leaf, element[static_cast<std::size_t>(leaf)]);
  light.Pull();
  light.UpdateSpreads();
  for (std::size_t i = 0; i < fragment.size(); ++i) {
    Fragment& piece = solution.fragments[i];
    const Material& material = solution.forest.scene().MaterialOf(solution.forest[piece.leaf].patch);
    piece.irradiance = fragment[i].max(0.0);
    piece.radiosity = material.emittance + material.reflectance * piece.irradiance;
  }
}

}  // namespace penumbra
