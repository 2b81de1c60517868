#include "mesh/interpolants/closer_sources.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "solver/geometry/polygon.h"
#include "solver/geometry/polygon_distance.h"
#include "solver/transport/points/leaf_cells.h"
#include "solver/transport/sources/error_floors.h"

namespace penumbra {
namespace {

// A leaf is near a point if its distance is at most this times its radius. Leaves that are farther away are
// as fine as the surfaces of the scene need them.
constexpr double kNear = 2;

// Each part may cause an error of this fraction of the requested error. A point has some twenty parts close
// to it, whose errors have different signs.
constexpr double kPartOfError = 0.1;

// The parts under a point at the height of 1e-6 of a leaf are as small as the height.
constexpr int kMostQuarterings = 20;

// Light is looked up this much inside of a part's border, relative to its size: other light may begin there.
constexpr double kInside = 1e-6;

std::span<const Vec3> VerticesOf(const SourceSet::Node& node) {
  return {node.vertex.data(), static_cast<std::size_t>(node.size)};
}

// A place on a part, and its weight in the mean over the part.
struct WeightedPlace {
  Vec3 place;
  double weight = 0;
};

// Simpson's rule in both directions; the weights contain the area.
void AddPlacesOfQuadrilateral(const std::array<Vec3, 4>& v, std::vector<WeightedPlace>& places) {
  constexpr std::array<double, 3> kSimpson = {1, 4, 1};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const double s = 0.5 * i, t = 0.5 * k;
      const Vec3 along = (1 - t) * (v[1] - v[0]) + t * (v[2] - v[3]),
                 across = (1 - s) * (v[3] - v[0]) + s * (v[2] - v[1]);
      const Vec3 place = (1 - t) * ((1 - s) * v[0] + s * v[1]) + t * ((1 - s) * v[3] + s * v[2]);
      places.push_back({place, kSimpson[i] * kSimpson[k] * along.cross(across).norm()});
    }
}

// The midpoints of a triangle's edges give the mean of a quadratic. The corners tell how much it varies.
void AddPlacesOfTriangle(const std::array<Vec3, 4>& v, std::vector<WeightedPlace>& places) {
  for (std::size_t k = 0; k < 3; ++k) {
    places.push_back({v[k], 0});
    places.push_back({0.5 * (v[k] + v[(k + 1) % 3]), 1});
  }
}

// Divides the leaves of one patch for one point.
class LeafDivider {
 public:
  LeafDivider(const Scene& scene, PatchId patch, const CloserSources::ShownLight& light,
              const ReceiverPoint& at)
      : patch_(patch), material_(scene.MaterialOf(patch)), light_(light), at_(at) {
    normal_ = scene.patches[static_cast<std::size_t>(patch)].normal;
  }

  // Radiosities below `floor` count as `floor` where errors are relative.
  std::vector<SourcePart> Divide(const SourceSet::Node& leaf, double tolerance, const Rgb& floor) {
    tolerance_ = tolerance;
    floor_ = floor;
    parts_.clear();
    if (DistanceToPolygon(VerticesOf(leaf), normal_, at_.position) > kNear * leaf.radius) return {};
    for (int c = 0; c < 3; ++c)
      of_leaf_[c] = material_.reflectance[c] > 0
                        ? std::max(0.0, leaf.radiosity[c] - material_.emittance[c]) / material_.reflectance[c]
                        : 0;
    Add(SourcePolygon(VerticesOf(leaf)), 0);
    // A leaf that stays whole keeps its exact mean.
    return parts_.size() > 1 ? parts_ : std::vector<SourcePart>();
  }

 private:
  struct LightOnPart {
    Rgb mean = Rgb::Zero(), deviation = Rgb::Zero();  // [W/m^2]
  };

  void Add(const SourcePolygon& polygon, int divisions) {
    const LightOnPart light = LookAt(polygon);
    const Rgb radiosity = material_.emittance + material_.reflectance * light.mean;
    if (divisions < kMostQuarterings && ErrorOf(polygon, radiosity, light.deviation) > tolerance_) {
      for (const SourcePolygon& quarter : Quarters(polygon)) Add(quarter, divisions + 1);
      return;
    }
    parts_.push_back({polygon, radiosity});
  }

  // The mean, and the largest deviation from it.
  LightOnPart LookAt(const SourcePolygon& polygon) {
    places_.clear();
    polygon.size == 3 ? AddPlacesOfTriangle(polygon.vertex, places_)
                      : AddPlacesOfQuadrilateral(polygon.vertex, places_);
    const Vec3 centre = Centroid(polygon.Vertices());
    LightOnPart light;
    values_.clear();
    double weight = 0;
    for (const WeightedPlace& place : places_) {
      const Vec3 inside = place.place + kInside * (centre - place.place);
      values_.push_back(light_(patch_, inside).value_or(of_leaf_));
      light.mean += place.weight * values_.back();
      weight += place.weight;
    }
    light.mean = weight > 0 ? Rgb(light.mean / weight) : of_leaf_;
    for (const Rgb& value : values_) light.deviation = light.deviation.max((value - light.mean).abs());
    return light;
  }

  // An estimate of the error of the point's irradiance, relative to the light of the part's surroundings.
  double ErrorOf(const SourcePolygon& polygon, const Rgb& radiosity, const Rgb& deviation) const {
    const std::span<const Vec3> vertices = polygon.Vertices();
    const bool is_above = std::any_of(vertices.begin(), vertices.end(),
                                      [&](const Vec3& v) { return at_.normal.dot(v - at_.position) > 0; });
    if (!is_above) return 0;
    double varies = 0;
    for (int c = 0; c < 3; ++c)
      if (const double around = std::max(radiosity[c], floor_[c]); around > 0)
        varies = std::max(varies, material_.reflectance[c] * deviation[c] / around);
    const double gap = DistanceToPolygon(vertices, normal_, at_.position);
    if (gap == 0) return varies;
    // The form factor, and how much it varies over the part: it falls with the distance squared, and two
    // cosines change about as fast.
    constexpr double kSteepness = 3;
    const Vec3 centre = Centroid(vertices);
    double radius = 0;
    for (const Vec3& v : vertices) radius = std::max(radius, (v - centre).norm());
    const double factor = std::min(1.0, VectorArea(vertices).norm() / (std::numbers::pi * gap * gap));
    return varies * factor * std::min(1.0, kSteepness * radius / gap);
  }

  const PatchId patch_;
  const Material& material_;
  const CloserSources::ShownLight& light_;
  const ReceiverPoint& at_;
  Vec3 normal_ = Vec3::Zero();
  double tolerance_ = 0;
  Rgb floor_ = Rgb::Zero(), of_leaf_ = Rgb::Zero();  // of_leaf_: the leaf's irradiance [W/m^2]
  std::vector<SourcePart> parts_;
  std::vector<WeightedPlace> places_;
  std::vector<Rgb> values_;
};

}  // namespace

CloserSources::CloserSources(const RadiositySolution& solution, const SourceSet& sources, ShownLight light,
                             double error)
    : scene_(solution.forest.scene()),
      sources_(sources),
      light_(std::move(light)),
      tolerance_(kPartOfError * error),
      floor_(kCellFloor * MeanReflected(solution)) {}

// Whether a leaf of the patch is near the point.
bool CloserSources::IsNear(PatchId patch, const Vec3& point) const {
  const Patch& of = scene_.patches[static_cast<std::size_t>(patch)];
  if (of.normal.dot(point - of.vertex[0]) <= 0) return false;
  const std::span<const SourceSet::Node> tree = sources_.Tree(patch);
  for (std::size_t i = 0; i < tree.size();) {
    const SourceSet::Node& node = tree[i];
    // No leaf is larger than a node above it.
    if ((node.centre - point).norm() - node.radius > kNear * node.radius) {
      i += static_cast<std::size_t>(node.skip);
      continue;
    }
    if (node.skip == 1 && DistanceToPolygon(VerticesOf(node), of.normal, point) <= kNear * node.radius)
      return true;
    ++i;
  }
  return false;
}

std::optional<DividedSources> CloserSources::At(const ReceiverPoint& at) const {
  DividedSources divided;
  for (std::size_t p = 0; p < scene_.patches.size(); ++p) {
    const auto patch = static_cast<PatchId>(p);
    if ((scene_.MaterialOf(patch).reflectance > 0).any() && IsNear(patch, at.position))
      divided.patches.push_back(patch);
  }
  if (divided.patches.empty()) return std::nullopt;
  divided.sources = sources_.Divided(divided.patches, [&](PatchId patch, const SourceSet::Node& leaf) {
    return LeafDivider(scene_, patch, light_, at).Divide(leaf, tolerance_, floor_);
  });
  return divided;
}

}  // namespace penumbra
