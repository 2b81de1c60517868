#include "solver/transport/sources/source_set.h"

#include <algorithm>
#include <optional>

#include "solver/geometry/polygon.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/sources/error_floors.h"
#include "solver/transport/sources/source_polygon.h"

namespace penumbra {
namespace {

using Node = SourceSet::Node;

SourceSet::Node MakeNode(std::span<const Vec3> vertices, const Rgb& radiosity) {
  SourceSet::Node node;
  node.size = static_cast<std::int32_t>(vertices.size());
  std::copy(vertices.begin(), vertices.end(), node.vertex.begin());
  node.radiosity = radiosity;
  return node;
}

// Appends the fragment as triangles and quadrilaterals.
void AppendFan(const Fragment& fragment, std::size_t number, std::vector<SourceSet::Node>& nodes) {
  for (const SourcePolygon& part : Fan(fragment.polygon)) {
    nodes.push_back(MakeNode(part.Vertices(), fragment.radiosity));
    nodes.back().fragment = static_cast<std::int32_t>(number);
  }
}

// A fragment, or a polygon whose four quarters precede it in the list.
struct JoinedFragment {
  SourcePolygon polygon;  // size 0: a fragment of more than four vertices
  std::size_t fragment = 0;
  std::size_t pieces = 1;  // number of pieces that form it, including itself; they precede it
};

// The fragments in their order. A polygon follows its last quarter if all four quarters exist: a quartered
// polygon that is far away or hidden as a whole is then handled as one.
std::vector<JoinedFragment> JoinFragments(std::span<const Fragment> fragments) {
  constexpr std::size_t kQuarters = 4;
  std::vector<JoinedFragment> pieces;
  std::vector<std::size_t> open;  // pieces that are no quarters so far
  for (std::size_t f = 0; f < fragments.size(); ++f) {
    const Polygon3& polygon = fragments[f].polygon;
    const bool may_join = polygon.size() <= 4;
    pieces.push_back({may_join ? SourcePolygon(polygon) : SourcePolygon(), f, 1});
    if (!may_join) {
      open.clear();
      continue;
    }
    open.push_back(pieces.size() - 1);
    while (open.size() >= kQuarters) {
      const std::size_t* last = &open[open.size() - kQuarters];
      const std::optional<SourcePolygon> whole = JoinQuarters(
          pieces[last[0]].polygon, pieces[last[1]].polygon, pieces[last[2]].polygon, pieces[last[3]].polygon);
      if (!whole) break;
      std::size_t count = 1;
      for (std::size_t k = 0; k < kQuarters; ++k) count += pieces[last[k]].pieces;
      open.resize(open.size() - kQuarters);
      pieces.push_back({*whole, 0, count});
      open.push_back(pieces.size() - 1);
    }
  }
  return pieces;
}

// Appends the pieces as nodes, parents before children. A parent's radiosity follows from its children.
void AppendPieces(std::span<const JoinedFragment> pieces, std::span<const Fragment> fragments,
                  std::size_t first, std::vector<SourceSet::Node>& nodes) {
  // In reverse order a polygon precedes its quarters: roots are found backwards and appended forwards.
  std::vector<std::size_t> roots;
  for (std::size_t i = pieces.size(); i > 0; i -= pieces[i - 1].pieces) roots.push_back(i - 1);
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
    const JoinedFragment& piece = pieces[*root];
    if (piece.pieces == 1) {
      AppendFan(fragments[piece.fragment], first + piece.fragment, nodes);
      continue;
    }
    const std::size_t at = nodes.size();
    nodes.push_back(MakeNode(piece.polygon.Vertices(), Rgb::Zero()));
    AppendPieces(pieces.subspan(*root + 1 - piece.pieces, piece.pieces - 1), fragments, first, nodes);
    nodes[at].skip = static_cast<std::int32_t>(nodes.size() - at);
  }
}

// Appends the subtree below `id`. If `join`, a subtree whose leaves all have the same radiosity becomes a
// single node.
void Append(const RadiositySolution& solution, std::span<const Fragment> fragments, ElementId id, bool join,
            std::vector<SourceSet::Node>& nodes) {
  const Element& element = solution.forest[id];
  const std::size_t at = nodes.size();
  nodes.push_back(MakeNode(element.Vertices(), solution.radiosity[id]));
  nodes.back().element = id;
  if (element.IsLeaf()) {
    const std::span<const Fragment> own = FragmentsOf(fragments, id);
    const std::size_t first = own.empty() ? 0 : static_cast<std::size_t>(own.data() - fragments.data());
    AppendPieces(JoinFragments(own), own, first, nodes);
    for (std::size_t i = at + 1; i < nodes.size(); ++i) nodes[i].element = id;
    // A piece that is the whole leaf replaces it; a subtree with one child would get a slope from rounding.
    if (nodes.size() > at + 1 && nodes.size() == at + 1 + static_cast<std::size_t>(nodes[at + 1].skip))
      nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(at));
    nodes[at].skip = static_cast<std::int32_t>(nodes.size() - at);
    return;
  }
  for (ElementId child = element.first_child; child < element.first_child + 4; ++child)
    Append(solution, fragments, child, join, nodes);
  const Rgb& first = nodes[at + 1].radiosity;
  const bool uniform =
      join && nodes.size() == at + 5 &&
      std::all_of(nodes.begin() + static_cast<std::ptrdiff_t>(at) + 1, nodes.end(),
                  [&](const SourceSet::Node& node) { return (node.radiosity == first).all(); });
  if (uniform) {
    nodes[at].radiosity = first;
    nodes.resize(at + 1);
  } else {
    nodes[at].skip = static_cast<std::int32_t>(nodes.size() - at);
  }
}

// Appends a copy of the subtree at node i of the patch's tree, with its leaves divided.
void AppendDivided(PatchId patch, std::span<const Node> tree, std::size_t i,
                   const SourceSet::DivideLeaf& divide, std::vector<SourceSet::Node>& nodes) {
  const Node& node = tree[i];
  const std::size_t at = nodes.size(), end = i + static_cast<std::size_t>(node.skip);
  nodes.push_back(MakeNode({node.vertex.data(), static_cast<std::size_t>(node.size)}, node.radiosity));
  if (node.skip == 1)
    for (const SourcePart& part : divide(patch, node))
      nodes.push_back(MakeNode(part.polygon.Vertices(), part.radiosity));
  for (std::size_t child = i + 1; child < end; child += static_cast<std::size_t>(tree[child].skip))
    AppendDivided(patch, tree, child, divide, nodes);
  nodes[at].skip = static_cast<std::int32_t>(nodes.size() - at);
}

}  // namespace

SourceSet SourceSet::Divided(std::span<const PatchId> patches, const DivideLeaf& divide) const {
  SourceSet set;
  set.emittance_ = emittance_;
  std::vector<char> is_given(PatchCount(), 0);
  for (const PatchId patch : patches) is_given[static_cast<std::size_t>(patch)] = 1;
  for (std::size_t p = 0; p < PatchCount(); ++p) {
    set.first_.push_back(set.nodes_.size());
    const auto patch = static_cast<PatchId>(p);
    if (is_given[p] != 0 && !Tree(patch).empty()) AppendDivided(patch, Tree(patch), 0, divide, set.nodes_);
  }
  set.first_.push_back(set.nodes_.size());
  set.Measure();
  return set;
}

SourceSet SourceSet::FromSolution(const RadiositySolution& solution) {
  return FromSolution(solution, solution.fragments);
}

SourceSet SourceSet::FromSolution(const RadiositySolution& solution, std::span<const Fragment> fragments) {
  return Make(solution, fragments, UniformSubtrees::kJoin);
}

SourceSet SourceSet::ForAnyLight(const RadiositySolution& solution) {
  return Make(solution, solution.fragments, UniformSubtrees::kJoinIfBlack);
}

SourceSet SourceSet::Make(const RadiositySolution& solution, std::span<const Fragment> fragments,
                          UniformSubtrees uniform) {
  SourceSet set;
  for (std::size_t p = 0; p < solution.forest.scene().patches.size(); ++p) {
    set.first_.push_back(set.nodes_.size());
    const Material& material = solution.forest.scene().MaterialOf(static_cast<PatchId>(p));
    set.emittance_.push_back(material.emittance);
    const ElementId root = ElementForest::Root(static_cast<PatchId>(p));
    const bool join = uniform == UniformSubtrees::kJoin || (material.reflectance == 0).all();
    if ((solution.radiosity[root] != 0).any()) Append(solution, fragments, root, join, set.nodes_);
  }
  set.first_.push_back(set.nodes_.size());
  set.Measure();
  return set;
}

SourceSet SourceSet::WithLight(const Light& light) const {
  SourceSet set = *this;
  set.TakeLight(light);
  return set;
}

void SourceSet::TakeLight(const Light& light) {
  emittance_.assign(light.emittance.begin(), light.emittance.end());
  for (std::size_t l = 0; l < leaf_node_.size(); ++l) {
    Node& node = nodes_[static_cast<std::size_t>(leaf_node_[l])];
    node.radiosity = node.fragment >= 0 && !light.fragment.empty()
                         ? light.fragment[static_cast<std::size_t>(node.fragment)]
                         : light.element[static_cast<std::size_t>(node.element)];
    leaf_radiosity_[l] = node.radiosity;
  }
  MeasureSubtrees();
  CompactLight();
}

void SourceSet::TakeSpreads(const SourceSet& other) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i].spread = std::max(nodes_[i].spread, other.nodes_[i].spread);
    nodes_[i].residual = std::max(nodes_[i].residual, other.nodes_[i].residual);
  }
  CompactLight();
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
  CompactLight();
}

void SourceSet::CompactLight() {
  light_.resize(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    NodeLight& light = light_[i];
    Eigen::Map<Rgb>(light.radiosity.data()) = nodes_[i].radiosity;
    using RowByRow = Eigen::Matrix<float, 3, 3, Eigen::RowMajor>;
    Eigen::Map<RowByRow>(light.slope.data()) = nodes_[i].slope.cast<float>();
    light.spread = static_cast<float>(nodes_[i].spread);
    light.residual = static_cast<float>(nodes_[i].residual);
  }
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

// The integral of x x^T over the polygon of a node, relative to the origin [m^4].
Eigen::Matrix3d SquaresOver(const SourceSet::Node& node, const Vec3& origin) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  const Vec3 a = node.vertex[0] - origin;
  for (std::size_t k = 2; k < static_cast<std::size_t>(node.size); ++k) {
    const Vec3 b = node.vertex[k - 1] - origin, c = node.vertex[k] - origin, sum = a + b + c;
    const double area = 0.5 * (b - a).cross(c - a).norm();
    squares +=
        area / 12 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  return squares;
}

// Integrals over leaves of radiosities and positions. Positions are relative to a nearby point: far
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
            SquaresOver(leaf, origin)};
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

// What turns the moment of radiosities that are constant on each leaf into the slope of the linear function
// that is nearest to them in the square mean over the polygon. Zero across a region that is much narrower
// than long.
Eigen::Matrix3d InverseOf(const Eigen::Matrix3d& second_moment) {
  constexpr double kNarrow = 1e-9;  // threshold for the squared width
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> decomposition;
  decomposition.setThreshold(kNarrow);
  decomposition.compute(second_moment);
  return decomposition.pseudoInverse();
}

}  // namespace

// Sets the means, spreads and linear fits of the inner nodes.
void SourceSet::MeasureSubtrees() {
  const Rgb dark = kErrorFloor * MeanReflected();
  std::vector<Moments> moments(nodes_.size());
  const bool is_measured = !inverse_moment_.empty();  // for an earlier light
  inverse_moment_.resize(nodes_.size());
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
      node.second_moment = own.squares_of_places - own.place * own.place.transpose() / own.area;
      if (!is_measured) inverse_moment_[i] = InverseOf(node.second_moment);
      node.slope = node.moment * inverse_moment_[i];
      const Rgb variance = (own.squares / own.area - node.radiosity.square()).max(0.0),
                by_slope = node.slope.cwiseProduct(node.moment).rowwise().sum().array() / own.area;
      const Rgb around = node.radiosity.max(dark);
      node.spread = node.residual = 0;
      for (int c = 0; c < 3; ++c) {
        if (around[c] <= 0) continue;
        node.spread = std::max(node.spread, std::sqrt(variance[c]) / around[c]);
        node.residual =
            std::max(node.residual, std::sqrt(std::max(0.0, variance[c] - by_slope[c])) / around[c]);
      }
    }
}

namespace {

bool SamePolygon(const Node& a, const Node& b) {
  return a.size == b.size && std::equal(a.vertex.begin(), a.vertex.begin() + a.size, b.vertex.begin());
}

// Maps the subtree at node i of one tree to the subtree with the same polygon at node j of the other.
void MapSubtree(std::span<const Node> from, std::size_t i, std::span<const Node> to, std::size_t j,
                std::int32_t first, std::int32_t* map) {
  map[i] = first + static_cast<std::int32_t>(j);
  const std::size_t end = i + static_cast<std::size_t>(from[i].skip),
                    other_end = j + static_cast<std::size_t>(to[j].skip);
  std::size_t at = j + 1;  // children mostly correspond in order
  for (std::size_t a = i + 1; a < end; a += static_cast<std::size_t>(from[a].skip)) {
    std::size_t b = at;
    while (b < other_end && !SamePolygon(from[a], to[b])) b += static_cast<std::size_t>(to[b].skip);
    if (b >= other_end) continue;
    MapSubtree(from, a, to, b, first, map);
    at = b + static_cast<std::size_t>(to[b].skip);
  }
}

}  // namespace

std::vector<std::int32_t> MapNodes(const SourceSet& from, const SourceSet& to) {
  std::vector<std::int32_t> map(from.NodeCount(), -1);
  for (std::size_t p = 0; p < from.PatchCount(); ++p) {
    const auto patch = static_cast<PatchId>(p);
    const std::span<const Node> a = from.Tree(patch), b = to.Tree(patch);
    if (a.empty() || b.empty() || !SamePolygon(a[0], b[0])) continue;
    MapSubtree(a, 0, b, 0, static_cast<std::int32_t>(to.IndexOf(b[0])), &map[from.IndexOf(a[0])]);
  }
  return map;
}

}  // namespace penumbra
