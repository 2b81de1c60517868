#include "solver/transport/sources/source_set.h"

#include <algorithm>

#include "solver/geometry/polygon.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/sources/error_floors.h"

namespace penumbra {
namespace {

SourceSet::Node MakeNode(std::span<const Vec3> vertices, const Rgb& radiosity) {
  SourceSet::Node node;
  node.size = static_cast<std::int32_t>(vertices.size());
  std::copy(vertices.begin(), vertices.end(), node.vertex.begin());
  node.radiosity = radiosity;
  return node;
}

// Appends the fragment as triangles and quadrilaterals.
void AppendFan(const Fragment& fragment, std::size_t number, std::vector<SourceSet::Node>& nodes) {
  const Polygon3& p = fragment.polygon;
  for (std::size_t i = 2; i < p.size(); i += 2) {
    const std::array<Vec3, 4> quadrilateral = {p[0], p[i - 1], p[i], p[std::min(i + 1, p.size() - 1)]};
    nodes.push_back(MakeNode({quadrilateral.data(), i + 1 < p.size() ? 4U : 3U}, fragment.radiosity));
    nodes.back().fragment = static_cast<std::int32_t>(number);
  }
}

// A fragment, or a triangle whose four quarters precede it in the list.
struct CellTriangle {
  std::array<Vec3, 3> corner;
  std::size_t fragment = 0;
  std::size_t pieces = 1;  // number of pieces that form it, including itself; they precede it
};

// True if a, b, c and `middle` are the quarters of a triangle, in the order of the triangle's corners.
bool AreQuarters(const CellTriangle& a, const CellTriangle& b, const CellTriangle& c,
                 const CellTriangle& middle) {
  return a.corner[1] == b.corner[0] && b.corner[2] == c.corner[1] && c.corner[0] == a.corner[2] &&
         middle.corner[0] == b.corner[2] && middle.corner[1] == a.corner[2] &&
         middle.corner[2] == a.corner[1];
}

// The fragments in their order. A triangle follows its last quarter if all four quarters exist: a quartered
// triangle that is far away or hidden as a whole is then handled as one.
std::vector<CellTriangle> JoinQuarters(std::span<const Fragment> fragments) {
  std::vector<CellTriangle> pieces;
  std::vector<std::size_t> open;  // pieces that are no quarters so far
  for (std::size_t f = 0; f < fragments.size(); ++f) {
    const Polygon3& polygon = fragments[f].polygon;
    const bool triangle = polygon.size() == 3;
    pieces.push_back({{polygon[0], polygon[1], polygon[2]}, f, 1});
    if (!triangle) {
      open.clear();
      continue;
    }
    open.push_back(pieces.size() - 1);
    constexpr std::size_t kQuarters = 4;
    while (open.size() >= kQuarters) {
      const std::size_t* last = &open[open.size() - kQuarters];
      const CellTriangle &a = pieces[last[0]], &b = pieces[last[1]], &c = pieces[last[2]],
                         &middle = pieces[last[3]];
      if (!AreQuarters(a, b, c, middle)) break;
      const CellTriangle whole = {
          {a.corner[0], b.corner[1], c.corner[2]}, 0, 1 + a.pieces + b.pieces + c.pieces + middle.pieces};
      open.resize(open.size() - kQuarters);
      pieces.push_back(whole);
      open.push_back(pieces.size() - 1);
    }
  }
  return pieces;
}

// Appends the pieces as nodes, parents before children. A parent's radiosity follows from its children.
void AppendPieces(std::span<const CellTriangle> pieces, std::span<const Fragment> fragments,
                  std::size_t first, std::vector<SourceSet::Node>& nodes) {
  // In reverse order a triangle precedes its quarters: roots are found backwards and appended forwards.
  std::vector<std::size_t> roots;
  for (std::size_t i = pieces.size(); i > 0; i -= pieces[i - 1].pieces) roots.push_back(i - 1);
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
    const CellTriangle& piece = pieces[*root];
    if (piece.pieces == 1) {
      AppendFan(fragments[piece.fragment], first + piece.fragment, nodes);
      continue;
    }
    const std::size_t at = nodes.size();
    nodes.push_back(MakeNode(piece.corner, Rgb::Zero()));
    AppendPieces(pieces.subspan(*root + 1 - piece.pieces, piece.pieces - 1), fragments, first, nodes);
    nodes[at].skip = static_cast<std::int32_t>(nodes.size() - at);
  }
}

// Appends the subtree below `id`. A subtree whose leaves all have the same radiosity becomes a single node.
void Append(const RadiositySolution& solution, std::span<const Fragment> fragments, ElementId id,
            std::vector<SourceSet::Node>& nodes) {
  const Element& element = solution.forest[id];
  const std::size_t at = nodes.size();
  nodes.push_back(MakeNode(element.Vertices(), solution.radiosity[id]));
  if (element.IsLeaf()) {
    const std::span<const Fragment> own = FragmentsOf(fragments, id);
    const std::size_t first = own.empty() ? 0 : static_cast<std::size_t>(own.data() - fragments.data());
    AppendPieces(JoinQuarters(own), own, first, nodes);
    // A single fragment replaces its leaf; a subtree of one node would get a slope from rounding.
    if (nodes.size() == at + 2) nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(at));
    nodes[at].skip = static_cast<std::int32_t>(nodes.size() - at);
    return;
  }
  for (ElementId child = element.first_child; child < element.first_child + 4; ++child)
    Append(solution, fragments, child, nodes);
  const Rgb& first = nodes[at + 1].radiosity;
  const bool uniform =
      nodes.size() == at + 5 &&
      std::all_of(nodes.begin() + static_cast<std::ptrdiff_t>(at) + 1, nodes.end(),
                  [&](const SourceSet::Node& node) { return (node.radiosity == first).all(); });
  if (uniform) {
    nodes[at].radiosity = first;
    nodes.resize(at + 1);
  } else {
    nodes[at].skip = static_cast<std::int32_t>(nodes.size() - at);
  }
}

}  // namespace

SourceSet SourceSet::FromSolution(const RadiositySolution& solution) {
  return FromSolution(solution, solution.fragments);
}

SourceSet SourceSet::FromSolution(const RadiositySolution& solution, std::span<const Fragment> fragments) {
  SourceSet set;
  for (std::size_t p = 0; p < solution.forest.scene().patches.size(); ++p) {
    set.first_.push_back(set.nodes_.size());
    set.emittance_.push_back(solution.forest.scene().MaterialOf(static_cast<PatchId>(p)).emittance);
    const ElementId root = ElementForest::Root(static_cast<PatchId>(p));
    if ((solution.radiosity[root] != 0).any()) Append(solution, fragments, root, set.nodes_);
  }
  set.first_.push_back(set.nodes_.size());
  set.Measure();
  return set;
}

SourceSet SourceSet::Emitters(const Scene& scene) {
  SourceSet set;
  for (const Patch& patch : scene.patches) {
    set.first_.push_back(set.nodes_.size());
    const Rgb& emittance = scene.materials[patch.material].emittance;
    set.emittance_.push_back(emittance);
    if ((emittance != 0).any()) set.nodes_.push_back(MakeNode(patch.Vertices(), emittance));
  }
  set.first_.push_back(set.nodes_.size());
  set.Measure();
  return set;
}

void SourceSet::Measure() {
  NumberLeaves();
  NumberCorners();
  MeasurePolygons();
  MeasureSubtrees();
}

void SourceSet::NumberLeaves() {
  std::vector<std::int32_t> before(nodes_.size() + 1, 0);  // number of leaves before each node
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    node.first_leaf = before[i];
    before[i + 1] = before[i] + (node.skip == 1 ? 1 : 0);
    if (node.skip != 1) continue;
    leaf_polygons_.Add({node.vertex.data(), static_cast<std::size_t>(node.size)});
    leaf_radiosity_.push_back(node.radiosity);
    leaf_node_.push_back(static_cast<std::int32_t>(i));
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    nodes_[i].leaf_count = before[i + static_cast<std::size_t>(nodes_[i].skip)] - before[i];
}

// Numbers the corners. Equal corners of parents, children and neighbours are equal to the bit.
void SourceSet::NumberCorners() {
  struct Corner {
    const Vec3* place;
    std::int32_t* number;
  };
  const auto before = [](const Corner& a, const Corner& b) {
    return std::lexicographical_compare(a.place->data(), a.place->data() + 3, b.place->data(),
                                        b.place->data() + 3);
  };
  std::vector<Corner> corners;
  for (std::size_t p = 0; p + 1 < first_.size(); ++p) {
    corners.clear();
    for (std::size_t i = first_[p]; i < first_[p + 1]; ++i)
      for (std::size_t k = 0; k < static_cast<std::size_t>(nodes_[i].size); ++k)
        corners.push_back({&nodes_[i].vertex[k], &nodes_[i].corner[k]});
    std::sort(corners.begin(), corners.end(), before);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (i == 0 || before(corners[i - 1], corners[i])) corners_.push_back(*corners[i].place);
      *corners[i].number = static_cast<std::int32_t>(corners_.size() - 1);
    }
  }
}

// Sets the centres, radii and areas of the nodes' polygons.
void SourceSet::MeasurePolygons() {
  for (Node& node : nodes_) {
    const std::span<const Vec3> polygon(node.vertex.data(), static_cast<std::size_t>(node.size));
    node.centre = Centroid(polygon);
    for (const Vec3& v : polygon) node.radius = std::max(node.radius, (v - node.centre).norm());
    node.area = VectorArea(polygon).norm();
  }
}

// The mean of radiosity - emittance over all leaves, weighted by area.
Rgb SourceSet::MeanReflected() const {
  Rgb reflected = Rgb::Zero();
  double area = 0;
  for (std::size_t p = 0; p + 1 < first_.size(); ++p)
    for (const Node& node : Tree(static_cast<PatchId>(p))) {
      if (node.skip != 1) continue;
      reflected += node.area * (node.radiosity - emittance_[p]);
      area += node.area;
    }
  return area > 0 ? Rgb(reflected / area) : reflected;
}

namespace {

// Area-weighted sums over leaves of radiosities and positions. Positions are relative to a nearby point: far
// from the origin, their squares would lose all digits.
struct Moments {
  double area = 0;
  Rgb sum = Rgb::Zero(), squares = Rgb::Zero();
  Vec3 place = Vec3::Zero();
  Eigen::Matrix3d sum_of_places = Eigen::Matrix3d::Zero(), squares_of_places = Eigen::Matrix3d::Zero();

  static Moments Of(const SourceSet::Node& leaf, const Vec3& origin) {
    const Vec3 place = leaf.centre - origin;
    const Rgb sum = leaf.area * leaf.radiosity;
    return {leaf.area,
            sum,
            sum * leaf.radiosity,
            leaf.area * place,
            sum.matrix() * place.transpose(),
            leaf.area * place * place.transpose()};
  }
  Moments& operator+=(const Moments& other) {
    area += other.area;
    sum += other.sum;
    squares += other.squares;
    place += other.place;
    sum_of_places += other.sum_of_places;
    squares_of_places += other.squares_of_places;
    return *this;
  }
};

// The slope of the best linear fit to radiosities with this moment. Zero across a region that is much
// narrower than long, or whose leaves lie in a row.
Eigen::Matrix3d Slope(const Eigen::Matrix3d& moment, const Moments& leaves) {
  constexpr double kNarrow = 1e-9;  // threshold for the squared width
  const Eigen::Matrix3d squares =
      leaves.squares_of_places - leaves.place * leaves.place.transpose() / leaves.area;
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> decomposition;
  decomposition.setThreshold(kNarrow);
  decomposition.compute(squares);
  return moment * decomposition.pseudoInverse();
}

}  // namespace

// Sets the means, spreads and linear fits of the inner nodes.
void SourceSet::MeasureSubtrees() {
  const Rgb dark = kErrorFloor * MeanReflected();
  std::vector<Moments> moments(nodes_.size());
  for (std::size_t p = 0; p + 1 < first_.size(); ++p)
    for (std::size_t i = first_[p + 1]; i-- > first_[p];) {
      Node& node = nodes_[i];
      Moments& own = moments[i];
      if (node.skip == 1) {
        own = Moments::Of(node, nodes_[first_[p]].centre);
        continue;
      }
      for (std::size_t child = i + 1; child < i + static_cast<std::size_t>(node.skip);
           child += static_cast<std::size_t>(nodes_[child].skip))
        own += moments[child];
      node.radiosity = own.sum / own.area;
      node.moment = own.sum_of_places - node.radiosity.matrix() * own.place.transpose();
      node.slope = Slope(node.moment, own);
      const Rgb variance = (own.squares / own.area - node.radiosity.square()).max(0.0),
                by_slope = node.slope.cwiseProduct(node.moment).rowwise().sum().array() / own.area;
      const Rgb around = node.radiosity.max(dark);
      for (int c = 0; c < 3; ++c) {
        if (around[c] <= 0) continue;
        node.spread = std::max(node.spread, std::sqrt(variance[c]) / around[c]);
        node.residual =
            std::max(node.residual, std::sqrt(std::max(0.0, variance[c] - by_slope[c])) / around[c]);
      }
    }
}

}  // namespace penumbra
