#include "solver/transport/points/gathering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/base/lazy_table.h"
#include "solver/visibility/point/form_factor.h"
#include "solver/visibility/point/form_factor_batch.h"

namespace penumbra {
namespace {

using Node = SourceSet::Node;

std::span<const Vec3> Vertices(const Node& node) {
  return {node.vertex.data(), static_cast<std::size_t>(node.size)};
}

// A dim source may cause an error of this fraction of the tolerance for all light. A point has many sources,
// and their errors have different signs.
constexpr double kOneOfMany = 0.2;

// The remaining sources are left out if their light together is at most this fraction of the tolerance. An
// omitted source always reduces the light; aggregates have errors of both signs.
constexpr double kLeftOut = 0.25;

}  // namespace

struct Gathering::Buffers {
  Clipper clipper;
  LazyTable<Vec2> corner_images;  // of the current source in the current image, by corner
  // Polygons that GatherAggregates() has listed; their form factors are still to be added.
  PolygonBatch listed;
  std::vector<FactorTerm> listed_term;  // without factors
  FormFactorSums sums;
  std::vector<double> factors;
  // For the current source: the occluders of a leaf, the screens that may hide the source, the region of the
  // blockers, and the candidates.
  std::vector<Occluder> leaf_occluders;
  std::vector<PatchId> screen_patches;
  ConvexRegion region;
  std::vector<PatchId> candidates;

  void Clear() {
    clipper.Clear();
    corner_images.Clear();
    ClearListed();
    sums.Clear();
    factors.clear();
    leaf_occluders.clear();
    screen_patches.clear();
    region.clear();
    candidates.clear();
  }
  void ClearListed() {
    listed.Clear();
    listed_term.clear();
  }
};

double SentBack(const Scene& scene, PatchId patch, PatchId source, double factor) {
  return (scene.MaterialOf(patch).reflectance * scene.MaterialOf(source).reflectance).maxCoeff() * factor *
         factor;
}

Gathering::Gathering(const Scene& scene, const SourceSet& sources, const ReceiverPoint& at,
                     const PointIrradianceOptions& options, IrradianceParts* parts)
    : scene_(scene),
      sources_(sources),
      at_(at),
      method_(options.method),
      parts_(parts),
      view_(scene, at, options.method ? *options.method : FastestExactMethod(), options.source_push_off),
      occluders_(view_.occluder_stack()),
      clipper_(buffers_->clipper) {}

Gathering::~Gathering() = default;

void Gathering::AllowAggregates(double tolerance, const Rgb& known, bool mostly_hidden) {
  tolerance_ = tolerance;
  known_ = known;
  mostly_hidden_ = mostly_hidden;
  buffers_->ClearListed();
}

// Makes `source` the current source. False if the point sees nothing of it.
bool Gathering::Face(PatchId source, DirectionPolygon* seen) {
  const Tree tree = sources_.Tree(source);
  if (tree.empty() || !view_.FaceSource(source)) return false;
  *seen = view_.SeeSource(Vertices(tree[0]));
  return !seen->empty();
}

void Gathering::AddSource(PatchId source, std::span<const PatchId> candidates, PatchId own) {
  DirectionPolygon seen;
  if (Face(source, &seen)) Gather(source, seen, candidates, own);
}

// True if the screens together hide all that is seen of the current source.
bool Gathering::HiddenBy(std::span<const Screen> screens, const DirectionPolygon& seen) {
  if (screens.empty()) return false;
  std::vector<PatchId>& patches = buffers_->screen_patches;
  patches.clear();
  for (const Screen& screen : screens) patches.push_back(screen.patch);
  occluders_.clear();
  if (!view_.FindBlockers(patches, kNoPatch, seen, occluders_)) return true;
  if (occluders_.size() < 2) return false;
  const Vec3 axis = ImageAxis(seen);
  if (axis.isZero(0)) return false;
  const ImageFrame frame(seen, axis);
  const ImagePolygon image = frame.Image(seen);
  const Clipper::Candidates all = clipper_.Begin(frame, image, occluders_);
  Clipper::Candidates own;
  const Overlap overlap = clipper_.Narrow(image, all, &own);
  if (overlap == Overlap::kPart) clipper_.CutOut(image, own, PieceOwner::Part(0));
  return overlap == Overlap::kAll || (overlap == Overlap::kPart && clipper_.Visible().Pieces() == 0);
}

void Gathering::AddSource(PatchId source, const PatchHierarchy& patches, std::span<const Screen> screens) {
  DirectionPolygon seen;
  if (!Face(source, &seen) || HiddenBy(screens, seen)) return;
  // Blockers lie between the point and the source's plane, within the view of the source.
  ConvexRegion& region = buffers_->region;
  std::vector<PatchId>& candidates = buffers_->candidates;
  region.clear();
  const Patch& patch = scene_.patches[static_cast<std::size_t>(source)];
  region.push_back({patch.normal, patch.normal.dot(patch.vertex[0])});
  if (!view_.SourceInContact())
    for (int i = 0; i < seen.size(); ++i) {
      const Vec3 m = EdgeNormal(seen[i], seen.Next(i));
      const double length = m.norm();
      if (length > 0) region.push_back({m / length, m.dot(at_.position) / length});
    }
  patches.Find(region, screens, candidates);
  Gather(source, seen, candidates, kNoPatch);
}

void Gathering::Gather(PatchId source, const DirectionPolygon& seen, std::span<const PatchId> candidates,
                       PatchId own) {
  const Rgb before = irradiance_;
  const std::size_t first_term = row_ ? row_->terms.size() : 0;
  factor_ = 0;
  occluders_.clear();
  if (!view_.FindBlockers(candidates, own, seen, occluders_)) return;
  const Tree tree = sources_.Tree(source);
  if (tolerance_ > 0) {
    source_normal_ = scene_.patches[static_cast<std::size_t>(source)].normal;
    whole_ = FormFactor(seen, at_.normal, CancellationAllowed());
    returned_ = std::max(returned_, SentBack(scene_, own, source, whole_));
    tolerance_here_ = ToleranceFor(tree[0].radiosity * whole_);
    unhindered_ += tree[0].radiosity * whole_;
  }
  if (occluders_.empty()) {
    GatherVisible(tree);
    if (tolerance_ > 0) so_far_ += whole_ * tree[0].radiosity;
  } else {
    GatherShadowed(tree, 0);
    if (tolerance_ > 0) so_far_ += irradiance_ - before;
  }
  if (row_) EndSourceOfRow(source, first_term);
  if (!parts_ || factor_ == 0) return;
  parts_->contributions.push_back({source, irradiance_ - before});
  parts_->direct += factor_ * sources_.Emittance(source);
}

void Gathering::EndSourceOfRow(PatchId source, std::size_t first_term) {
  AddListedSources();
  row_->returned = std::max(row_->returned, returned_);
  if (row_->terms.size() == first_term) return;
  row_->sources.push_back({source, static_cast<std::uint32_t>(first_term),
                           static_cast<std::uint32_t>(row_->terms.size()), static_cast<float>(whole_)});
}

// Adds the subtree at node i. The occluders may hide parts of the subtree.
void Gathering::GatherShadowed(Tree tree, std::size_t i) {
  const Node& node = tree[i];
  const auto skip = static_cast<std::size_t>(node.skip);
  const DirectionPolygon seen = view_.SeeSource(Vertices(node));
  if (seen.empty()) return;
  const Vec3 axis = ImageAxis(seen);
  if (axis.isZero(0)) {
    // The node surrounds the point and fits into no image; its children may fit.
    if (skip == 1) return GatherUnfit(node, seen);
    for (std::size_t child = i + 1; child < i + skip; child += static_cast<std::size_t>(tree[child].skip))
      GatherShadowed(tree, child);
    return;
  }
  const ImageFrame frame(seen, axis);
  const double factor_before = factor_;
  const Clipper::Candidates all = clipper_.Begin(frame, frame.Image(seen), occluders_);
  buffers_->corner_images.Begin(sources_.Corners().size());
  GatherNode(tree, i, frame, all);
  AddVisiblePieces(frame, factor_before);
}

// The image of a node's polygon.
ImagePolygon Gathering::ImageOf(const Node& node, const ImageFrame& frame) const {
  ImagePolygon polygon;
  if (!view_.SourceIsPlain()) {
    polygon = frame.Image(view_.SeeSource(Vertices(node)));
    return polygon;
  }
  LazyTable<Vec2>& images = buffers_->corner_images;
  for (int k = node.size; k-- > 0;) {  // counter-clockwise about a normal that points to the point
    const std::int32_t corner = node.corner[static_cast<std::size_t>(k)];
    const auto [image, is_new] = images[corner];
    if (is_new) image = frame.Image(sources_.Corners()[static_cast<std::size_t>(corner)] - view_.SourceEye());
    polygon.Add(image.x(), image.y());
  }
  return polygon;
}

// Adds the subtree at node i in the current image, with the candidates as occluders.
void Gathering::GatherNode(Tree tree, std::size_t i, const ImageFrame& frame,
                           const Clipper::Candidates& candidates) {
  const Node& node = tree[i];
  const auto skip = static_cast<std::size_t>(node.skip);
  const ImagePolygon image = ImageOf(node, frame);
  if (image.size == 0) return;
  Clipper::Candidates own;
  const Overlap overlap = clipper_.Narrow(image, candidates, &own);
  if (overlap == Overlap::kNone) {
    GatherVisible(tree.subspan(i, skip));
  } else if (overlap == Overlap::kPart && skip > 1 && tolerance_ > 0 && MayAggregate(node, false)) {
    clipper_.CutOut(image, own, PieceOwner::Group(sources_.IndexOf(node)));
  } else if (overlap == Overlap::kPart && skip == 1) {
    if (!method_ || parts_) clipper_.CutOut(image, own, PieceOwner::Part(node.first_leaf));
    if (method_) {
      clipper_.List(own, buffers_->leaf_occluders);
      Add(node.first_leaf,
          method_->VisibleFormFactor(view_.SeeSource(Vertices(node)), buffers_->leaf_occluders, at_.normal));
    }
  } else if (overlap == Overlap::kPart) {
    for (std::size_t child = i + 1; child < i + skip; child += static_cast<std::size_t>(tree[child].skip))
      GatherNode(tree, child, frame, own);
  }
  clipper_.Restore(candidates);
}

// Adds all leaves of a subtree that nothing hides.
void Gathering::GatherVisible(Tree nodes) {
  if (tolerance_ > 0) return GatherAggregates(nodes);
  if (parts_)
    for (const Node& node : nodes)
      if (node.skip == 1)
        AddGradient(node.first_leaf, FormFactorGradient(view_.SeeSource(Vertices(node)), at_.normal));
  if (!view_.SourceIsPlain()) {
    for (const Node& node : nodes)
      if (node.skip == 1) Add(node.first_leaf, FormFactor(view_.SeeSource(Vertices(node)), at_.normal));
    return;
  }
  const auto first = static_cast<std::size_t>(nodes[0].first_leaf);
  const auto count = static_cast<std::size_t>(nodes[0].leaf_count);
  FormFactorSums& sums = buffers_->sums;
  sums.Find(sources_.LeafPolygons(), first, first + count, view_.SourceEye(), at_.normal);
  // The sums are used if their loss of digits is small relative to the light of all leaves together.
  double turned = 0, together = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double radiosity = sources_.LeafRadiosities()[first + i].maxCoeff();
    turned += sums.SizeAdded(i) * radiosity;
    together += sums.Factor(i) * radiosity;
  }
  if (turned > 2 * std::numbers::pi * kFormFactorCancellation * together) {
    std::vector<double>& factors = buffers_->factors;
    factors.resize(count);
    FormFactors(sources_.LeafPolygons(), first, first + count, view_.SourceEye(), at_.normal, factors.data());
    for (std::size_t i = 0; i < count; ++i) Add(static_cast<std::int32_t>(first + i), factors[i]);
  } else {
    for (std::size_t i = 0; i < count; ++i) Add(static_cast<std::int32_t>(first + i), sums.Factor(i));
  }
}

bool Gathering::IsNegligible(const Rgb& light) const {
  return (light <= kLeftOut * Tolerance() * so_far_).all();
}

// In a slot, errors of samples have the same sign and add up from wall to wall. Measured for a tolerance of 5
// %: the error in a slot is 5.7 % with the factor 1 - r, and 3.8 % with (1 - r)^2.
double Gathering::Tolerance() const { return (1 - returned_) * (1 - returned_) * tolerance_; }

double AggregateTolerance(double tolerance, double returned, const Rgb& light, const Rgb& known) {
  double of_many = std::numeric_limits<double>::infinity();
  for (int c = 0; c < 3; ++c)
    if (light[c] > 0) of_many = std::min(of_many, kOneOfMany * known[c] / light[c]);
  return (1 - returned) * (1 - returned) * tolerance * of_many;
}

// The allowed error of a source, relative to its unoccluded light.
double Gathering::ToleranceFor(const Rgb& light) const {
  const double of_many = AggregateTolerance(tolerance_, returned_, light, so_far_.max(known_));
  return mostly_hidden_ ? of_many : std::max(Tolerance(), of_many);
}

// The relative change of the form factor per area over a node, squared; 1 near the node. A first-order
// correction leaves an error of the spread times this.
double Gathering::Nearness(const Node& node) const {
  // A form factor per area depends on distance^-2 and on two cosines, which together change about as fast.
  constexpr double kSteepness = 3;
  const double gap = (node.centre - at_.position).norm() - node.radius;
  const double reach = gap > 0 ? kSteepness * node.radius / gap : 1;
  return std::min(1.0, reach * reach);
}

// True if a subtree may count as one polygon: if nothing hides it, with its mean radiosity and moment;
// otherwise with the best linear fit of its radiosities. The error must be small relative to the light of the
// subtree or of the whole source.
bool Gathering::MayAggregate(const Node& node, bool visible) const {
  double error = visible ? node.spread : node.residual;
  if (error <= tolerance_here_) return true;
  const Vec3 to = node.centre - at_.position;
  const double distance = to.norm(), gap = distance - node.radius;
  if (gap <= 0) return false;
  if (visible) {
    error *= Nearness(node);
    if (error <= tolerance_here_) return true;
  }
  const double high = std::min(1.0, (at_.normal.dot(to) + node.radius) / distance),
               deep = std::min(1.0, (source_normal_.dot(-to) + node.radius) / distance);
  return error * node.area * high * deep <= tolerance_here_ * whole_ * std::numbers::pi * gap * gap;
}

// Adds a subtree that nothing hides, with aggregates where they are allowed.
void Gathering::GatherAggregates(Tree nodes) {
  const bool plain = view_.SourceIsPlain();
  Buffers& buffers = *buffers_;
  for (std::size_t i = 0; i < nodes.size();) {
    const Node& node = nodes[i];
    if (node.skip > 1 && !MayAggregate(node, true)) {
      ++i;
      continue;
    }
    i += static_cast<std::size_t>(node.skip);
    FactorTerm term;
    term.node = static_cast<std::int32_t>(sources_.IndexOf(node));
    term.by_spread = 1;
    // A node well above the horizon needs no clipping.
    if (plain || (!view_.SourceInContact() && at_.normal.dot(node.centre - at_.position) > node.radius)) {
      if (node.skip > 1) {
        Eigen::Map<Eigen::Vector3f>(term.moment.data()) = FirstMoment(node).cast<float>();
        term.by_spread = static_cast<float>(Nearness(node));
      }
      buffers.listed.Add(Vertices(node));
      buffers.listed_term.push_back(term);
    } else {
      const double factor = FormFactor(view_.SeeSource(Vertices(node)), at_.normal, CancellationAllowed());
      factor_ += factor;
      term.factor = factor;
      Add(term);
    }
  }
}

// The first-order correction to an aggregate, for a slope of 1: radiosity and form factor per area both vary
// over the node.
Vec3 Gathering::FirstMoment(const Node& node) const {
  const Vec3 r = node.centre - at_.position;
  const double d2 = r.squaredNorm();
  // Within two radii, the form factor per area is not linear over the node.
  constexpr double kFarSquared = 4;
  if (d2 < kFarSquared * node.radius * node.radius) return Vec3::Zero();
  const double high = at_.normal.dot(r), deep = -source_normal_.dot(r);
  // The gradient of high * deep / (pi d^4) along the source's plane.
  const Vec3 gradient = deep / (std::numbers::pi * d2 * d2) * (at_.normal - 4 * high / d2 * r);
  return node.second_moment * gradient;
}

// Adds the polygons listed by GatherAggregates(). Form factors here may be less exact than elsewhere.
void Gathering::AddListedSources() {
  if (tolerance_ == 0) return;
  Buffers& buffers = *buffers_;
  const std::size_t count = buffers.listed_term.size();
  if (count == 0) return;
  buffers.sums.Find(buffers.listed, 0, count, view_.SourceEye(), at_.normal);
  for (std::size_t i = 0; i < count; ++i) {
    buffers.listed_term[i].factor = buffers.sums.Factor(i);
    Add(buffers.listed_term[i]);
  }
  buffers.ClearListed();
}

// Adds a leaf that fits into no image.
void Gathering::GatherUnfit(const Node& leaf, const DirectionPolygon& seen) {
  if (method_) Add(leaf.first_leaf, method_->VisibleFormFactor(seen, occluders_, at_.normal));
  if (method_ && !parts_) return;
  std::vector<ImagePart> parts;
  SplitForImages(seen, at_.normal, parts);
  for (const ImagePart& part : parts) {
    const ImageFrame frame(part.polygon, part.axis);
    const double factor_before = factor_;
    const ImagePolygon image = frame.Image(part.polygon);
    const Clipper::Candidates all = clipper_.Begin(frame, image, occluders_);
    Clipper::Candidates own;
    if (clipper_.Narrow(image, all, &own) == Overlap::kAll) continue;
    clipper_.CutOut(image, own, PieceOwner::Part(leaf.first_leaf), part.label);
    AddVisiblePieces(frame, factor_before);
  }
}

// Adds the pieces that the clipper has left of leaves that are covered in part.
void Gathering::AddVisiblePieces(const ImageFrame& frame, double factor_before) {
  ImageEdges& visible = clipper_.Visible();
  if (visible.Pieces() == 0) return;
  if (parts_) AddGradientOfPieces(frame);
  if (method_) return;
  const ImageEdges::Sum sum = visible.FormFactorSum(frame, at_.normal);
  const double together = std::abs(sum.value) + 2 * std::numbers::pi * (factor_ - factor_before);
  const bool cancels = sum.angles > CancellationAllowed() * together;
  for (std::size_t p = 0; p < visible.Pieces(); ++p) {
    const double factor = cancels ? visible.PieceByQuadrature(frame, at_.normal, p)
                                  : 0.5 * std::numbers::inv_pi * visible.PieceSum(p);
    const PieceOwner owner = visible.Owner(p);
    if (!owner.IsGroup()) {
      Add(owner.Number(), std::max(0.0, factor));
    } else {
      // Of a node that a shadow crosses, often the brighter part is visible, so the mean radiosity would be
      // too dark.
      const Node& node = sources_.NodeAt(static_cast<std::size_t>(owner.Number()));
      const double visible_factor = std::max(0.0, factor);
      factor_ += visible_factor;
      FactorTerm term;
      term.node = owner.Number();
      term.factor = visible_factor;
      term.by_residual = 1;
      Eigen::Map<Eigen::Vector3f>(term.moment.data()) =
          (visible_factor * OffsetToward(node, frame.Direction(visible.Centroid(p)))).cast<float>();
      Add(term);
    }
  }
}

// From the node's centre to the place of the node that is seen in the direction [m], but no farther than the
// node's linear fit is positive.
Vec3 Gathering::OffsetToward(const Node& node, const Vec3& direction) const {
  const double fall = source_normal_.dot(direction);
  if (fall >= 0 || view_.SourceInContact()) return Vec3::Zero();
  const Vec3 to_centre = node.centre - at_.position;
  Vec3 offset = source_normal_.dot(to_centre) / fall * direction - to_centre;
  const double length = offset.norm();
  if (length > node.radius) offset *= node.radius / length;  // by rounding, at grazing angles
  const Rgb change = (node.slope * offset).array();
  double positive = 1;
  for (int c = 0; c < 3; ++c)
    if (change[c] < -node.radiosity[c]) positive = std::min(positive, -node.radiosity[c] / change[c]);
  return positive * offset;
}

// The largest allowed ratio of the angles of a sum to the sum; digits are lost in proportion to the ratio.
// With a tolerance, fewer digits suffice.
double Gathering::CancellationAllowed() const {
  constexpr double kNegligible = 1e-3;  // of the tolerance
  constexpr double kPerDigit = kFormFactorCancellation / kFormFactorError;
  return std::max(kFormFactorCancellation, kNegligible * tolerance_ * kPerDigit);
}

void Gathering::AddGradientOfPieces(const ImageFrame& frame) {
  const ImageEdges& visible = clipper_.Visible();
  for (std::size_t p = 0; p < visible.Pieces(); ++p) {
    const std::int32_t leaf = visible.Owner(p).Number();
    const DirectionPolygon whole = view_.SeeSource(sources_.LeafVertices(leaf));
    Vec3 gradient = Vec3::Zero();
    for (std::size_t i = visible.Begin(p); i < visible.Begin(p + 1); ++i) {
      const EdgeLabel label = visible.Label(i);
      if (label.IsInner()) continue;
      const Vec3 from = frame.Direction(visible.Start(i)),
                 to = frame.Direction(visible.Start(i) + visible.Difference(i));
      if (label.IsOfSource()) {
        const int edge = label.SourceEdge();
        gradient += EdgeGradient(whole[edge], whole.Next(edge), from, to, at_.normal);
        continue;
      }
      const Cone& cone = *occluders_[label.Occluder()].cone;
      gradient += EdgeGradient(cone.direction[label.Plane()], cone.end[label.Plane()], from, to, at_.normal);
    }
    AddGradient(leaf, gradient);
  }
}

void Gathering::Add(std::int32_t leaf, double factor) {
  factor_ += factor;
  if (!factors_.empty()) factors_[static_cast<std::size_t>(leaf)] += factor;
  irradiance_ += factor * sources_.LeafRadiosities()[static_cast<std::size_t>(leaf)];
  if (!row_) return;
  FactorTerm term;
  term.node = sources_.NodeOfLeaf(leaf);
  term.factor = factor;
  term.by_spread = 1;
  Record(term);
}

void Gathering::Add(const FactorTerm& term) {
  const Node& node = sources_.NodeAt(static_cast<std::size_t>(term.node));
  irradiance_ += term.factor * node.radiosity;
  if (node.skip > 1)
    irradiance_ +=
        (node.slope * Eigen::Map<const Eigen::Vector3f>(term.moment.data()).cast<double>()).array();
  if (row_) Record(term);
}

// Appends the term to the row, or joins it with the last term if both belong to one node.
void Gathering::Record(const FactorTerm& term) {
  if (term.factor == 0) return;
  FactorTerm* const last = row_->terms.empty() ? nullptr : &row_->terms.back();
  if (!last || last->node != term.node) {
    row_->terms.push_back(term);
    return;
  }
  last->factor += term.factor;
  for (std::size_t k = 0; k < term.moment.size(); ++k) last->moment[k] += term.moment[k];
}

void Gathering::AddGradient(std::int32_t leaf, const Vec3& gradient) {
  const Rgb& radiosity = sources_.LeafRadiosities()[static_cast<std::size_t>(leaf)];
  parts_->gradient += radiosity.matrix() * gradient.transpose();
}

}  // namespace penumbra
