#include "solver/transport/points/leaf_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/transport/links/cubature.h"
#include "solver/transport/points/nearest_patches.h"

namespace penumbra {
namespace {

// The error at receivers that a piece of constant light causes, per change of radiosity: the second moment
// over the piece, 1/12, times the fraction of the view, 1/2.
constexpr double kMoment = 1.0 / 24;
// Upper bounds of (width of a piece) / (distance to the nearest patch). A piece that touches a patch fills
// half of the view of points there, with the value of its near side (kMostNear). For a width along the patch,
// this holds only for points closer than the length of the piece (kMostBeside).
constexpr double kMostNear = 6, kMostBeside = 1;
// Largest number of pieces in each direction that replace the linear function of a part.
constexpr int kMostPieces = 4;
// Largest number of halvings of a part: near a corner of three patches, light depends on the angle at every
// distance.
constexpr int kMostHalved = 40;

// A vertex within this distance of a cut, relative to the part's diameter, lies on the cut. A choice, far
// above rounding, and below the size of any useful piece.
constexpr double kOnCut = 1e-9;
// Edges are parallel if the cosine of the angle between them is at least this: up to 5e-5 rad, over which
// light does not change.
constexpr double kParallel = 1 - 1e-9;
// A second direction of cuts must be more than 60 degrees from the first; its cosine is below this.
constexpr double kMostCosine = 0.5;

// A convex part of the leaf, in which irradiance is a linear function of position.
struct Part {
  Polygon3 polygon;
  Vec3 centre = Vec3::Zero();
  Rgb mean = Rgb::Zero();
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();  // one row for each channel [W/m^3]
  int halved = 0;
};

// A direction in which a part may be cut, across the middle of its extent.
struct Direction {
  Vec3 normal = Vec3::Zero();  // unit, in the leaf's plane
  double low = 0, high = 0;    // of normal . p [m]
  int pieces = 1;              // number of pieces that the error requires
  double error = 0;            // with the largest number of pieces
};

class Divider {
 public:
  Divider(const RadiositySolution& solution, const PointIrradiance& exact, ElementId leaf,
          const LeafCellOptions& options)
      : scene_(solution.forest.scene()),
        exact_(exact),
        leaf_(leaf),
        element_(solution.forest[leaf]),
        normal_(scene_.patches[static_cast<std::size_t>(element_.patch)].normal),
        material_(scene_.MaterialOf(element_.patch)),
        options_(options),
        near_(scene_, element_.Vertices(), exact.SeenFrom(leaf)) {}

  LeafCells Divide(std::vector<Polygon3> start) {
    for (Polygon3& polygon : start) Divide(Sampled(std::move(polygon), 0));
    return std::move(cells_);
  }

 private:
  Part Sampled(Polygon3 polygon, int halved) const {
    Part part;
    part.halved = halved;
    const std::vector<CubaturePoint> rule = Cubature(polygon);
    part.polygon = std::move(polygon);
    part.centre = Centroid(part.polygon);
    ReceiverPoint at;
    at.normal = normal_;
    Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d moment = normal_ * normal_.transpose();
    double size = 0;
    for (const CubaturePoint& point : rule) size = std::max(size, (point.position - part.centre).norm());
    for (const CubaturePoint& point : rule) {
      at.position = point.position;
      const Rgb value = exact_.OnPatch(element_.patch, at).irradiance;
      const Vec3 off = (point.position - part.centre) / size;
      part.mean += point.weight * value;
      slope += point.weight * value.matrix() * off.transpose();
      moment += point.weight * off * off.transpose();
    }
    // The centroid of the rule's points is the part's centroid, so mean and slope are independent.
    part.gradient = moment.ldlt().solve(slope.transpose()).transpose() / size;
    return part;
  }

  void Divide(const Part& part) {
    std::vector<Direction> directions = Directions(part);
    std::sort(directions.begin(), directions.end(),
              [](const Direction& a, const Direction& b) { return a.error > b.error; });
    const double snap = kOnCut * Diameter(part.polygon);
    if (!directions.empty() && directions[0].error > options_.error && part.halved < kMostHalved &&
        VectorArea(part.polygon).norm() > options_.min_area) {
      std::vector<Polygon3> halves = {part.polygon};
      Cut(directions[0], 2, snap, halves);
      if (halves.size() == 2) {
        for (Polygon3& half : halves) Divide(Sampled(std::move(half), part.halved + 1));
        return;
      }
    }
    std::vector<Polygon3> pieces = {part.polygon};
    std::vector<Vec3> across;
    for (const Direction& direction : directions) {
      const bool other = across.empty() || std::abs(across[0].dot(direction.normal)) < kMostCosine;
      if (across.size() == 2 || !other) continue;
      Cut(direction, direction.pieces, snap, pieces);
      across.push_back(direction.normal);
    }
    for (Polygon3& piece : pieces) Add(part, std::move(piece));
    cells_.parts.push_back(part.polygon);
  }

  std::vector<Direction> Directions(const Part& part) const {
    std::vector<Direction> directions;
    if ((material_.reflectance == 0).all() || near_.patches().empty()) return directions;
    const Rgb around = (material_.emittance + material_.reflectance * part.mean).max(options_.dark);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& v : part.polygon) nearest = std::min(nearest, near_.Distance(v));
    const std::size_t n = part.polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 edge = part.polygon[(i + 1) % n] - part.polygon[i];
      const double length = edge.norm();
      if (length == 0) continue;
      Direction direction;
      direction.normal = normal_.cross(edge / length);
      const bool known = std::any_of(directions.begin(), directions.end(), [&](const Direction& d) {
        return std::abs(d.normal.dot(direction.normal)) > kParallel;
      });
      if (known) continue;
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Vec3& v : part.polygon) {
        low = std::min(low, direction.normal.dot(v));
        high = std::max(high, direction.normal.dot(v));
      }
      const double width = high - low, at = direction.normal.dot(part.centre);
      direction.low = low;
      direction.high = high;
      double change = 0;  // relative change of radiosity over the width
      for (int c = 0; c < 3; ++c)
        if (material_.reflectance[c] > 0 && around[c] > 0)
          change = std::max(change, material_.reflectance[c] / around[c] *
                                        std::abs(part.gradient.row(c).dot(direction.normal)) * width);
      // The fraction of the width that leads away from the nearest patches.
      const double below = near_.Distance(part.centre + (low - at) * direction.normal),
                   above = near_.Distance(part.centre + (high - at) * direction.normal);
      const double away = width > 0 ? std::min(1.0, std::abs(above - below) / width) : 0;
      const double distance = std::min({nearest, below, above}),
                   most = kMostBeside + (kMostNear - kMostBeside) * away;
      const auto error = [&](double parts) {
        const double piece = width / parts;
        return kMoment * change / parts * (most * distance > piece ? piece / distance : most);
      };
      while (direction.pieces < kMostPieces && error(direction.pieces) > options_.error)
        direction.pieces *= 2;
      direction.error = error(kMostPieces);
      directions.push_back(direction);
    }
    return directions;
  }

  // Cuts the polygons across the direction into the strips that divide the direction's extent into `pieces`.
  static void Cut(const Direction& direction, int pieces, double snap, std::vector<Polygon3>& polygons) {
    for (int k = 1; k < pieces; ++k) {
      const double at = direction.low + (direction.high - direction.low) * k / pieces;
      std::vector<Polygon3> cut;
      for (Polygon3& polygon : polygons) {
        const Vec3 on = polygon[0] + (at - direction.normal.dot(polygon[0])) * direction.normal;
        Polygon3 above = ClipToHalfSpace(polygon, direction.normal, on, snap);
        Polygon3 below = ClipToHalfSpace(polygon, -direction.normal, on, snap);
        if (above.empty() || below.empty()) {
          cut.push_back(std::move(polygon));
          continue;
        }
        cut.push_back(std::move(below));
        cut.push_back(std::move(above));
      }
      polygons = std::move(cut);
    }
  }

  void Add(const Part& part, Polygon3 polygon) {
    Fragment fragment;
    fragment.leaf = leaf_;
    fragment.area = VectorArea(polygon).norm();
    const Rgb off = (part.gradient * (Centroid(polygon) - part.centre)).array();
    fragment.irradiance = (part.mean + off).max(0.0);
    fragment.radiosity = material_.emittance + material_.reflectance * fragment.irradiance;
    fragment.polygon = std::move(polygon);
    cells_.pieces.push_back(std::move(fragment));
  }

  const Scene& scene_;
  const PointIrradiance& exact_;
  ElementId leaf_;
  const Element& element_;
  const Vec3& normal_;
  const Material& material_;
  LeafCellOptions options_;
  const NearestPatches near_;
  LeafCells cells_;
};

}  // namespace

Rgb MeanReflected(const RadiositySolution& solution) {
  const Scene& scene = solution.forest.scene();
  Rgb sum = Rgb::Zero();
  double area = 0;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    const auto patch = static_cast<PatchId>(p);
    sum += scene.patches[p].area * scene.MaterialOf(patch).reflectance *
           solution.irradiance[ElementForest::Root(patch)];
    area += scene.patches[p].area;
  }
  return area > 0 ? Rgb(sum / area) : sum;
}

Rgb LeafCells::Mean() const {
  Rgb mean = Rgb::Zero();
  double area = 0;
  for (const Fragment& piece : pieces) {
    mean += piece.area * piece.irradiance;
    area += piece.area;
  }
  return area > 0 ? Rgb(mean / area) : mean;
}

LeafCells CutLeaf(const RadiositySolution& solution, const PointIrradiance& exact, ElementId leaf,
                  std::vector<Polygon3> start, const LeafCellOptions& options) {
  return Divider(solution, exact, leaf, options).Divide(std::move(start));
}

}  // namespace penumbra
