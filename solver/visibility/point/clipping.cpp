#include "solver/visibility/point/clipping.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <vector>

#include "solver/base/scratch.h"
#include "solver/base/vector_dispatch.h"
#include "solver/visibility/point/form_factor.h"

namespace penumbra {
namespace {

// A vertex within this distance of a line, relative to the size of the source's image, lies on the line.
// Without this tolerance, coincident lines would cut off slivers that later lines cut again. The border of
// the visible part moves by at most this distance.
constexpr double kSnap = 8 * std::numeric_limits<double>::epsilon();

// Pieces up to this size, relative to the source's image, are artefacts: lines that should meet in one point
// meet in three.
constexpr double kDust = 4e4 * kSnap;

// In images smaller than this, the rounding of a line's distance exceeds kSnap, and the distance is computed
// with more digits.
constexpr double kFineImage = 0.25, kFinestImage = 1e-4;

// With more occluders, a piece is halved instead of cut along an occluder: each half has fewer occluders.
constexpr std::size_t kCrowd = 16;

constexpr int kMostCuts = 12;  // lines of a cone; each may add a vertex to the polygon that it cuts
constexpr int kLanes = 4;

// A group of lines or vertices, processed at once.
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));
using LaneBits = std::int64_t __attribute__((vector_size(kLanes * sizeof(std::int64_t))));

// By pointer: the convention for returning vectors by value depends on the processor.
[[gnu::always_inline]] inline void Load(const double* from, Lanes* lanes) {
  std::memcpy(lanes, from, sizeof *lanes);
}

// The bitwise or of all lanes.
[[gnu::always_inline]] inline std::uint32_t AnyOf(const LaneBits& bits) {
  static_assert(kLanes == 4);
  return static_cast<std::uint32_t>((bits[0] | bits[1]) | (bits[2] | bits[3]));
}

// A part of a source in the image.
struct Piece : ImagePolygon {
  std::array<EdgeLabel, kCapacity> label;  // of the edge from vertex i to the next vertex

  Piece() {}  // NOLINT: the array stays uninitialised
  Piece(const Piece& other) : ImagePolygon() { *this = other; }
  Piece& operator=(const Piece& other) {
    ImagePolygon::operator=(other);
    std::copy_n(other.label.begin(), size, label.begin());
    return *this;
  }
  // A piece with these labels; by default those of the source's edges.
  Piece(const ImagePolygon& polygon, std::span<const EdgeLabel> labels) : ImagePolygon(polygon) {
    for (int i = 0; i < size; ++i) label[i] = labels.empty() ? EdgeLabel::OfSource(i) : labels[i];
  }

  void Add(double px, double py, EdgeLabel label_to_next) {
    label[size] = label_to_next;
    ImagePolygon::Add(px, py);
  }
};

struct Bounds {
  double low_x, high_x, low_y, high_y;
};

Bounds BoundsOf(const ImagePolygon& piece) {
  Bounds b{piece.x[0], piece.x[0], piece.y[0], piece.y[0]};
  for (int i = 1; i < piece.size; ++i) {
    b.low_x = std::min(b.low_x, piece.x[i]);
    b.high_x = std::max(b.high_x, piece.x[i]);
    b.low_y = std::min(b.low_y, piece.y[i]);
    b.high_y = std::max(b.high_y, piece.y[i]);
  }
  return b;
}

// True if the width of the piece is at most about `width`.
bool IsSliver(const Piece& piece, double width) {
  double twice_area = 0, longest = 0;
  for (int i = 1; i < piece.size; ++i) {
    const double ax = piece.x[i - 1] - piece.x[0], ay = piece.y[i - 1] - piece.y[0],
                 bx = piece.x[i] - piece.x[0], by = piece.y[i] - piece.y[0];
    twice_area += ax * by - ay * bx;
    longest = std::max({longest, std::abs(bx), std::abs(by)});
  }
  return twice_area <= width * longest;
}

// An occluder in the image. Lines and vertices are stored in groups of kLanes that are processed at once. The
// padding of the last group has no effect.
struct ImageCone {
  int padded = 0;  // a multiple of kLanes
  std::size_t occluder = 0;
  Bounds bounds;                             // of its vertices; infinite if some lie behind the point
  std::array<double, kMostCuts> a, b, h;     // its lines
  std::array<double, kMostCuts> vx, vy, vw;  // its vertices, homogeneous
};

// A cone that may cover a part of a piece, with the lines that may cut the piece.
struct Candidate {
  std::int32_t cone;
  std::uint32_t lines;
  std::int32_t count;  // number of the lines
};

// A piece that some candidates cover in part: candidates[first] to candidates[last - 1].
struct Work {
  Piece piece;
  std::size_t first, last;
  int halvings;  // that may still be made because of kCrowd
};

ImageCone MakeImageCone(const ImageFrame& frame, const Occluder& occluder, std::size_t index, Digits digits) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // If the relative height of a vertex above the image's horizon is at most this, the bounds are infinite.
  constexpr double kLeastHeight = 1e-9;
  const Cone& cone = *occluder.cone;
  ImageCone image;
  image.padded = (cone.size + kLanes - 1) / kLanes * kLanes;
  image.occluder = index;
  image.bounds = {kInfinity, -kInfinity, kInfinity, -kInfinity};
  bool behind = false;
  for (int k = 0; k < image.padded; ++k) {
    // The padding is a line with every point on its inner side.
    const bool is_line = k < cone.size;
    const ImageLine line = is_line ? frame.Line(cone, k, digits) : ImageLine{0, 0, kInfinity};
    image.a[k] = line.a;
    image.b[k] = line.b;
    image.h[k] = line.h;
    const int vertex = std::min(k, cone.size - 1);
    const Vec3 v = frame.Homogeneous(cone.direction[vertex]);
    image.vx[k] = v.x();
    image.vy[k] = v.y();
    image.vw[k] = v.z();
    behind = behind || v.z() <= kLeastHeight * (std::abs(v.x()) + std::abs(v.y()));
    const double scale = 1 / v.z(), x = scale * v.x(), y = scale * v.y();
    image.bounds.low_x = std::min(image.bounds.low_x, x);
    image.bounds.high_x = std::max(image.bounds.high_x, x);
    image.bounds.low_y = std::min(image.bounds.low_y, y);
    image.bounds.high_y = std::max(image.bounds.high_y, y);
  }
  if (behind) image.bounds = {-kInfinity, kInfinity, -kInfinity, kInfinity};
  return image;
}

}  // namespace

struct Clipper::Impl {
  std::vector<ImageCone> cones;
  std::vector<Candidate> candidates;
  std::vector<Work> stack;
  std::size_t depth = 0;  // number of entries in use; the others keep their memory
  ImageEdges visible;
  std::span<const Occluder> occluders;
  PieceOwner owner = PieceOwner::Part(0);  // of the pieces found
  double snap = 0, dust = 0;

  bool Beside(const ImageCone& cone, const ImagePolygon& piece) const;
  Overlap Classify(Candidate& candidate, const ImagePolygon& piece, const Bounds& bounds) const;
  void Split(const Piece& piece, const ImageLine& line, EdgeLabel label, Piece* inside, Piece* outside) const;
  Overlap Narrow(const ImagePolygon& piece, std::size_t first, std::size_t last);
  void Sort(const Piece& piece, std::size_t first, std::size_t last, int halvings);
  void Halve(const Work& work, int halvings);
  void CutOut(Work& work);
  void Run();
};

Clipper::Clipper() : impl_(std::make_unique<Impl>()) {}
Clipper::~Clipper() = default;

// True if the whole cone lies on the outer side of an edge of the piece.
[[gnu::always_inline]] inline bool Clipper::Impl::Beside(const ImageCone& cone,
                                                         const ImagePolygon& piece) const {
  for (int i = 0; i < piece.size; ++i) {
    const int j = i + 1 == piece.size ? 0 : i + 1;
    const double dx = piece.x[j] - piece.x[i], dy = piece.y[j] - piece.y[i];
    // The direction of an edge of this length is arbitrary.
    if (std::abs(dx) + std::abs(dy) <= dust) continue;
    const double h = dy * piece.x[i] - dx * piece.y[i];
    LaneBits before{};
    for (int group = 0; group < cone.padded; group += kLanes) {
      Lanes x, y, w;
      Load(&cone.vx[group], &x);
      Load(&cone.vy[group], &y);
      Load(&cone.vw[group], &w);
      before |= dx * y - dy * x + h * w > 0;
    }
    if (AnyOf(before) == 0) return true;
  }
  return false;
}

// How the candidate covers the piece. For kPart, keeps those of its lines that cut the piece.
[[gnu::always_inline]] inline Overlap Clipper::Impl::Classify(Candidate& candidate, const ImagePolygon& piece,
                                                              const Bounds& bounds) const {
  const ImageCone& cone = cones[candidate.cone];
  if (cone.bounds.low_x >= bounds.high_x - snap || cone.bounds.high_x <= bounds.low_x + snap ||
      cone.bounds.low_y >= bounds.high_y - snap || cone.bounds.high_y <= bounds.low_y + snap)
    return Overlap::kNone;
  std::uint32_t cutting = 0;
  for (int group = 0; group < cone.padded; group += kLanes) {
    Lanes a, b, h;
    Load(&cone.a[group], &a);
    Load(&cone.b[group], &b);
    Load(&cone.h[group], &h);
    Lanes lowest = a * piece.x[0] + b * piece.y[0] + h, highest = lowest;
    for (int i = 1; i < piece.size; ++i) {
      const Lanes height = a * piece.x[i] + b * piece.y[i] + h;
      lowest = height < lowest ? height : lowest;
      highest = height > highest ? height : highest;
    }
    constexpr std::uint32_t kCuts = (1 << kLanes) - 1;
    const std::uint32_t bits =
        AnyOf(((lowest < -snap) & LaneBits{1, 2, 4, 8}) | ((highest <= snap) & LaneBits{16, 32, 64, 128}));
    if (bits > kCuts) return Overlap::kNone;  // outside a line
    cutting |= bits << group;
  }
  const int count = std::popcount(cutting);
  candidate.lines = cutting;
  candidate.count = count;
  if (cutting == 0) return Overlap::kAll;
  // The piece crosses one line and lies inside all others, so the cone covers a part of the piece.
  if (count == 1) return Overlap::kPart;
  return Beside(cone, piece) ? Overlap::kNone : Overlap::kPart;
}

// Splits the piece at a line into `inside` and `outside`. The new edges get the label.
void Clipper::Impl::Split(const Piece& piece, const ImageLine& line, EdgeLabel label, Piece* inside,
                          Piece* outside) const {
  std::array<double, Piece::kCapacity> height;
  for (int i = 0; i < piece.size; ++i) {
    const double h = line.a * piece.x[i] + line.b * piece.y[i] + line.h;
    height[i] = std::abs(h) <= snap ? 0 : h;
  }
  inside->size = outside->size = 0;
  for (int i = 0; i < piece.size; ++i) {
    const int j = i + 1 == piece.size ? 0 : i + 1;
    const double ha = height[i], hb = height[j], x = piece.x[i], y = piece.y[i];
    // A vertex on the line is the start of the new edge in the part that the next edge leaves.
    if (ha >= 0) inside->Add(x, y, hb < 0 && ha == 0 ? label : piece.label[i]);
    if (ha <= 0) outside->Add(x, y, hb > 0 && ha == 0 ? label : piece.label[i]);
    if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) {
      const double t = ha / (ha - hb);
      const double cx = x + t * (piece.x[j] - x), cy = y + t * (piece.y[j] - y);
      inside->Add(cx, cy, ha > 0 ? label : piece.label[i]);
      outside->Add(cx, cy, ha > 0 ? piece.label[i] : label);
    }
  }
}

// How the candidates [first, last) cover the piece. Pushes those that cover a part.
PENUMBRA_VECTOR_CLONES
Overlap Clipper::Impl::Narrow(const ImagePolygon& piece, std::size_t first, std::size_t last) {
  const Bounds bounds = BoundsOf(piece);
  if (piece.size < 3 || (bounds.high_x - bounds.low_x <= dust && bounds.high_y - bounds.low_y <= dust))
    return Overlap::kAll;
  const std::size_t top = candidates.size();
  for (std::size_t c = first; c < last; ++c) {
    Candidate candidate = candidates[c];
    const Overlap overlap = Classify(candidate, piece, bounds);
    if (overlap == Overlap::kAll) {
      candidates.resize(top);
      return Overlap::kAll;
    }
    if (overlap == Overlap::kPart) candidates.push_back(candidate);
  }
  return candidates.size() == top ? Overlap::kNone : Overlap::kPart;
}

// Drops the piece if the candidates [first, last) hide it, keeps it if none covers a part, and otherwise puts
// it on the stack.
void Clipper::Impl::Sort(const Piece& piece, std::size_t first, std::size_t last, int halvings) {
  const std::size_t top = candidates.size();
  switch (Narrow(piece, first, last)) {
    case Overlap::kAll:
      break;
    case Overlap::kNone:
      if (IsSliver(piece, snap)) break;
      visible.AddPiece(piece.x.data(), piece.y.data(), piece.label.data(), piece.size, owner);
      break;
    case Overlap::kPart: {
      if (depth == stack.size()) stack.emplace_back();
      Work& work = stack[depth++];
      work.piece = piece;
      work.first = top;
      work.last = candidates.size();
      work.halvings = halvings;
    }
  }
}

// Cuts the piece across the middle of its longer side.
void Clipper::Impl::Halve(const Work& work, int halvings) {
  const Bounds b = BoundsOf(work.piece);
  const bool along_x = b.high_x - b.low_x > b.high_y - b.low_y;
  Piece low, high;
  Split(work.piece,
        along_x ? ImageLine{1, 0, -0.5 * (b.low_x + b.high_x)} : ImageLine{0, 1, -0.5 * (b.low_y + b.high_y)},
        EdgeLabel::Inner(), &high, &low);
  const std::size_t first = work.first, last = work.last;  // the stack may be reallocated from here on
  Sort(high, first, last, halvings);
  Sort(low, first, last, halvings);
}

// Cuts one candidate out of the piece, and tests the remaining pieces against the other candidates.
void Clipper::Impl::CutOut(Work& work) {
  // Fewer lines give fewer pieces.
  const std::size_t first = work.first, last = work.last;
  std::size_t chosen = first;
  for (std::size_t c = first + 1; c < last; ++c)
    if (candidates[c].count < candidates[chosen].count) chosen = c;
  std::swap(candidates[first], candidates[chosen]);
  const Candidate cutter = candidates[first];
  const int halvings = work.halvings;
  Piece start = work.piece, inside, outside;  // the stack may be reallocated from here on
  Piece *rest = &start, *next = &inside;
  for (std::uint32_t lines = cutter.lines; lines != 0 && rest->size >= 3; lines &= lines - 1) {
    const int k = std::countr_zero(lines);
    const ImageCone& cone = cones[cutter.cone];
    Split(*rest, {cone.a[k], cone.b[k], cone.h[k]}, EdgeLabel::OfOccluder(cone.occluder, k), next, &outside);
    std::swap(rest, next);
    Sort(outside, first + 1, last, halvings);
  }
}

void Clipper::Impl::Run() {
  while (depth > 0) {
    Work& work = stack[--depth];
    candidates.resize(work.last);  // those above belong to finished pieces
    if (work.piece.size + kMostCuts > Piece::kCapacity) {
      Halve(work, work.halvings);  // so that cuts cannot exceed the capacity of a piece
    } else if (work.halvings > 0 && work.last - work.first > kCrowd) {
      Halve(work, work.halvings - 1);
    } else {
      CutOut(work);
    }
  }
}

void Clipper::Clear() {
  impl_->cones.clear();
  impl_->candidates.clear();
  impl_->depth = 0;
  impl_->visible.Clear();
  impl_->occluders = {};
}

Clipper::Candidates Clipper::Begin(const ImageFrame& frame, const ImagePolygon& whole,
                                   std::span<const Occluder> occluders) {
  Impl& impl = *impl_;
  impl.occluders = occluders;
  double reach = 0;
  for (int i = 0; i < whole.size; ++i) reach = std::max({reach, std::abs(whole.x[i]), std::abs(whole.y[i])});
  impl.snap = kSnap * reach;
  impl.dust = kDust * reach;
  impl.visible.Clear();
  impl.cones.clear();
  impl.candidates.clear();
  const Digits digits = reach < kFinestImage ? Digits::kQuadruple
                        : reach < kFineImage ? Digits::kExtended
                                             : Digits::kDouble;
  for (std::size_t i = 0; i < occluders.size(); ++i) {
    impl.cones.push_back(MakeImageCone(frame, occluders[i], i, digits));
    impl.candidates.push_back({static_cast<std::int32_t>(i), 0, 0});
  }
  return {0, occluders.size()};
}

Overlap Clipper::Narrow(const ImagePolygon& polygon, const Candidates& candidates, Candidates* own) {
  own->first = impl_->candidates.size();
  const Overlap overlap = impl_->Narrow(polygon, candidates.first, candidates.last);
  own->last = impl_->candidates.size();
  return overlap;
}

void Clipper::Restore(const Candidates& candidates) { impl_->candidates.resize(candidates.last); }

void Clipper::CutOut(const ImagePolygon& polygon, const Candidates& candidates, PieceOwner owner,
                     std::span<const EdgeLabel> label) {
  Impl& impl = *impl_;
  impl.owner = owner;
  if (candidates.empty()) {
    const Piece piece(polygon, label);
    impl.visible.AddPiece(piece.x.data(), piece.y.data(), piece.label.data(), piece.size, owner);
    return;
  }
  impl.stack.resize(std::max<std::size_t>(impl.stack.size(), 1));
  Work& work = impl.stack[0];
  work.piece = Piece(polygon, label);
  work.first = candidates.first;
  work.last = candidates.last;
  // If candidates were evenly distributed, this number of halvings would leave a few for each piece.
  work.halvings = static_cast<int>(std::bit_width((candidates.last - candidates.first) / 2));
  impl.depth = 1;
  impl.Run();
}

void Clipper::List(const Candidates& candidates, std::vector<Occluder>& occluders) const {
  occluders.clear();
  for (std::size_t c = candidates.first; c < candidates.last; ++c)
    occluders.push_back(impl_->occluders[impl_->cones[impl_->candidates[c].cone].occluder]);
}

ImageEdges& Clipper::Visible() { return impl_->visible; }

namespace {

// The objects that clipping of one source needs.
struct Workshop {
  Clipper clipper;
  std::vector<ImagePart> parts;

  void Clear() {
    clipper.Clear();
    parts.clear();
  }
};

// Calls use(frame, clipper) for each image of the source; the clipper holds the visible pieces.
template <class Use>
void ForEachImage(const DirectionPolygon& source, std::span<const Occluder> occluders, const Vec3& normal,
                  const Use& use) {
  const Scratch<Workshop> workshop;
  Clipper& clipper = workshop->clipper;
  SplitForImages(source, normal, workshop->parts);
  for (const ImagePart& part : workshop->parts) {
    const ImageFrame frame(part.polygon, part.axis);
    const ImagePolygon image = frame.Image(part.polygon);
    const Clipper::Candidates all = clipper.Begin(frame, image, occluders);
    Clipper::Candidates own;
    if (clipper.Narrow(image, all, &own) == Overlap::kAll) continue;
    clipper.CutOut(image, own, PieceOwner::Part(0), part.label);
    use(frame, clipper);
  }
}

}  // namespace

void ForEachVisiblePiece(const DirectionPolygon& source, std::span<const Occluder> occluders,
                         const Vec3& normal, const std::function<void(std::span<const Vec3>)>& visit) {
  std::vector<Vec3> directions;
  ForEachImage(source, occluders, normal, [&](const ImageFrame& frame, Clipper& clipper) {
    const ImageEdges& visible = clipper.Visible();
    for (std::size_t p = 0; p < visible.Pieces(); ++p) {
      directions.clear();
      for (std::size_t e = visible.Begin(p); e < visible.Begin(p + 1); ++e)
        directions.push_back(frame.Direction(visible.Start(e)));
      visit(directions);
    }
  });
}

namespace {

// Adds the form factors of the visible pieces of the image to the factors of their owners.
void AddVisible(ImageEdges& visible, const ImageFrame& frame, const Vec3& normal, std::span<double> factors) {
  const ImageEdges::Sum sum = visible.FormFactorSum(frame, normal);
  const bool cancels = sum.angles > kFormFactorCancellation * std::abs(sum.value);
  for (std::size_t p = 0; p < visible.Pieces(); ++p)
    factors[static_cast<std::size_t>(visible.Owner(p).Number())] +=
        cancels ? visible.PieceByQuadrature(frame, normal, p)
                : visible.PieceSum(p) * (0.5 * std::numbers::inv_pi);
}

}  // namespace

void VisibleFormFactors(const DirectionPolygon& whole, std::span<const DirectionPolygon> parts,
                        std::span<const Occluder> occluders, const Vec3& normal, std::span<double> factors) {
  const Vec3 axis = ImageAxis(whole);
  if (axis.isZero(0)) {
    for (std::size_t i = 0; i < parts.size(); ++i)
      factors[i] = Clipping().VisibleFormFactor(parts[i], occluders, normal);
    return;
  }
  std::fill(factors.begin(), factors.end(), 0.0);
  const Scratch<Workshop> workshop;
  Clipper& clipper = workshop->clipper;
  const ImageFrame frame(whole, axis);
  const Clipper::Candidates all = clipper.Begin(frame, frame.Image(whole), occluders);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const ImagePolygon image = frame.Image(parts[i]);
    Clipper::Candidates own;
    if (clipper.Narrow(image, all, &own) != Overlap::kAll)
      clipper.CutOut(image, own, PieceOwner::Part(static_cast<std::int32_t>(i)));
    clipper.Restore(all);
  }
  AddVisible(clipper.Visible(), frame, normal, factors);
  for (double& factor : factors) factor = std::max(0.0, factor);
}

double Clipping::VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                                   const Vec3& normal) const {
  double factor = 0;
  ForEachImage(source, occluders, normal, [&](const ImageFrame& frame, Clipper& clipper) {
    AddVisible(clipper.Visible(), frame, normal, {&factor, 1});
  });
  return std::max(0.0, factor);
}

const OcclusionMethod& FastestExactMethod() {
  static const Clipping method;
  return method;
}

OcclusionRegistry::Method ClippingMethod() {
  return {"clipping",
          "cuts the shadow of each blocker out of the source; exact, and the fastest",
          {},
          [](const OcclusionOptions&) { return std::make_unique<const Clipping>(); }};
}

}  // namespace penumbra
