#include "solver/visibility/exact/vertex_tracing.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <optional>

#include "solver/visibility/exact/exact_image.h"
#include "solver/visibility/point/form_factor.h"

namespace penumbra {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Image = ExactImage<Kernel>;
using Direction = Kernel::Direction_2;

// The paper's formula is used if its error, relative to the form factor of the unoccluded source, is below
// this.
constexpr double kFormulaError = 1e-13;

// A direction at a vertex: along the line of an edge, or opposite to it.
struct Ray {
  std::int32_t edge = 0;
  bool against = false;

  bool operator==(const Ray&) const = default;
};

// A border of a visible span: a ray from the place with the visible region on its left or on its right.
struct Border {
  std::int32_t line = 0;  // smallest number of the edges on the ray
  std::int32_t place = 0;
  bool ascending = false;  // the ray meets places with higher numbers
  bool left = false;
};

// Finds all borders of visible spans in an image.
class Tracer {
 public:
  explicit Tracer(const Image& image) : image_(image), lines_(image.edges().size()) {}

  void Trace(std::vector<Border>& borders) {
    for (std::size_t p = 0; p < image_.places().size(); ++p)
      TracePlace(static_cast<std::int32_t>(p), borders);
  }

 private:
  // The end (change -1) or the start (change +1) of a span about a vertex, counter-clockwise.
  struct End {
    Ray ray;
    bool of_source = false;
    int change = 0;
  };
  struct LineRays {
    std::array<std::optional<Direction>, 2> direction;
    std::optional<bool> ascending;  // along the line
  };
  enum class Cover { kNone, kAll, kSpan };

  const Direction& DirectionOf(const Ray& ray) {
    LineRays& line = lines_[static_cast<std::size_t>(ray.edge)];
    if (!line.direction[0]) {
      line.direction[0] = image_.edges()[static_cast<std::size_t>(ray.edge)].line.direction();
      line.direction[1] = -*line.direction[0];
    }
    return *line.direction[ray.against ? 1 : 0];
  }

  bool Ascends(const Ray& ray) {
    LineRays& line = lines_[static_cast<std::size_t>(ray.edge)];
    if (!line.ascending) {
      const Direction& along = DirectionOf({ray.edge, false});
      const auto x = CGAL::sign(along.dx());
      line.ascending = x == CGAL::POSITIVE || (x == CGAL::ZERO && along.dy() > 0);
    }
    return *line.ascending != ray.against;
  }

  // The sign of the turn from the line of one edge to the line of another.
  int Turn(std::int32_t from, std::int32_t to) {
    const auto& edges = image_.edges();
    return CGAL::sign(CGAL::determinant(
        edges[static_cast<std::size_t>(from)].line.a(), edges[static_cast<std::size_t>(from)].line.b(),
        edges[static_cast<std::size_t>(to)].line.a(), edges[static_cast<std::size_t>(to)].line.b()));
  }

  // The directions about a place that an outline covers: a half circle at an edge, a sector at a corner.
  Cover CoverAbout(const Image::Outline& outline, std::int32_t place, Ray& begin, Ray& end) {
    if (!outline.box.Meets(image_.places()[static_cast<std::size_t>(place)].box)) return Cover::kNone;
    std::int32_t in = -1, out = -1;
    for (std::int32_t e = outline.first; e < outline.last; ++e) {
      const int side = image_.SideOf(e, place);
      if (side < 0) return Cover::kNone;
      if (side > 0) continue;
      if (in < 0) {
        in = out = e;
        continue;
      }
      if (Turn(e, in) > 0) in = e;
      if (Turn(out, e) > 0) out = e;
    }
    if (in < 0) return Cover::kAll;
    begin = {out, false};
    end = {in, true};
    return Cover::kSpan;
  }

  void TracePlace(std::int32_t place, std::vector<Border>& borders);

  const Image& image_;
  std::vector<LineRays> lines_;
  std::vector<End> ends_;
};

void Tracer::TracePlace(std::int32_t place, std::vector<Border>& borders) {
  ends_.clear();
  Ray begin, end;
  const bool inside = CoverAbout(image_.source(), place, begin, end) == Cover::kAll;
  if (!inside) {
    ends_.push_back({begin, true, 1});
    ends_.push_back({end, true, -1});
  }
  for (const Image::Outline& outline : image_.occluders()) {
    switch (CoverAbout(outline, place, begin, end)) {
      case Cover::kNone:
        break;
      case Cover::kAll:
        return;
      case Cover::kSpan:
        ends_.push_back({begin, false, 1});
        ends_.push_back({end, false, -1});
        break;
    }
  }

  // Spans that contain the angle zero are open at the start.
  int in_source = inside ? 1 : 0, occluders = 0;
  for (std::size_t k = 0; k < ends_.size(); k += 2)
    if (DirectionOf(ends_[k + 1].ray) < DirectionOf(ends_[k].ray))
      ++(ends_[k].of_source ? in_source : occluders);

  std::sort(ends_.begin(), ends_.end(), [&](const End& a, const End& b) {
    return !(a.ray == b.ray) && DirectionOf(a.ray) < DirectionOf(b.ray);
  });
  for (std::size_t k = 0; k < ends_.size();) {
    const bool before = in_source > 0 && occluders == 0;
    const Ray ray = ends_[k].ray;
    std::int32_t line = ray.edge;
    for (; k < ends_.size() && (ends_[k].ray == ray || DirectionOf(ends_[k].ray) == DirectionOf(ray)); ++k) {
      (ends_[k].of_source ? in_source : occluders) += ends_[k].change;
      line = std::min(line, ends_[k].ray.edge);
    }
    const bool after = in_source > 0 && occluders == 0;
    if (before != after) borders.push_back({line, place, Ascends(ray), after});
  }
}

// Adds the contributions of the borders by the formula of Stark and Riesenfeld, eqs (6) to (9), to `sum`.
// False if the error may exceed `error`.
//
// The paper's F(x, y, m) = A x / 2 arctan(A y) + C (y - m x) / 2 arctan(C (x + m y)) is even in the direction
// (dx, dy) = (1, m) of the border. Starts and ends of spans are equal in number, so the first term cancels at
// each vertex. For the second term, let m be the unit normal of the plane through the border and the point,
// and n the receiver's normal. For any vector d towards the vertex,
// C (y - m x) = n . m,    arctan(C (x + m y)) = atan2(d . (m x n), d . n).
// The arctan is the angle on the great circle of the border from its highest point to the vertex; Lambert's
// term of an edge is the difference of these angles at its ends. This form contains no slope, so vertical
// borders and vertices on the horizon need no special case. The form fails for a border whose plane is close
// to the horizon.
bool AddByFormula(const Image& image, const std::vector<Border>& borders, const Vec3& normal, double error,
                  double& sum) {
  constexpr double kUnit = 0.5 * std::numeric_limits<double>::epsilon();
  if (error < kUnit) return false;  // out of reach
  const Vec3 base = image.plane().Base();
  std::int32_t line = -1;
  Vec3 axis = Vec3::Zero(), rise = Vec3::Zero();
  double cosine = 0, sine = 0, bound = 0, total = 0;
  for (const Border& border : borders) {
    if (border.line != line) {
      line = border.line;
      axis = image.NormalOf(image.edges()[static_cast<std::size_t>(line)].line).normalized();
      rise = axis.cross(normal);
      cosine = normal.dot(axis);
      sine = rise.norm();
      if (cosine == 0) continue;
      if (sine == 0) return false;
    }
    if (cosine == 0) continue;
    const Vec3 vertex =
        base + image.plane().Lift(image.places()[static_cast<std::size_t>(border.place)].offset);
    const double angle = std::atan2(vertex.dot(rise), vertex.dot(normal));
    total += border.left ? -cosine * angle : cosine * angle;
    bound += (4 * kUnit + 2 * Image::kNormalError) * std::abs(angle) +
             std::abs(cosine) / sine * (5 * kUnit + 2 * image.offset_error());
    if (!(bound * 0.5 * std::numbers::inv_pi <= error)) return false;
  }
  sum += total * 0.5 * std::numbers::inv_pi;
  return true;
}

// Adds the contributions of the edges of the visible region. On each line, a border that leaves a vertex and
// the border that returns from the next vertex form an edge. Lambert's terms alone would lose the digits of a
// small source. Each edge therefore stands for a triangle with one corner of the source; no such triangle is
// larger than the source.
void AddByEdges(const Image& image, const std::vector<Border>& borders, const Vec3& normal, double& sum) {
  const Vec3 base = image.plane().Base();
  for (std::size_t k = 0; k < borders.size(); k += 2) {
    PENUMBRA_CHECK(k + 1 < borders.size());
    const Border &from = borders[k], &to = borders[k + 1];
    PENUMBRA_CHECK(from.line == to.line && from.ascending && !to.ascending && from.left != to.left);
    const Vec2 p = image.places()[static_cast<std::size_t>(from.place)].offset,
               q = image.places()[static_cast<std::size_t>(to.place)].offset;
    const bool counter_clockwise = Cross2(p, q) > 0;
    const std::array<Vec3, 3> offset = {Vec3::Zero(), image.plane().Lift(counter_clockwise ? p : q),
                                        image.plane().Lift(counter_clockwise ? q : p)};
    const double factor = FormFactor(base, offset, normal);
    sum += counter_clockwise == from.left ? factor : -factor;
  }
}

}  // namespace

double VertexTracing::VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                                        const Vec3& normal) const {
  return Trace(source, occluders, normal).form_factor;
}

TracedFormFactor VertexTracing::Trace(const DirectionPolygon& source, std::span<const Occluder> occluders,
                                      const Vec3& normal) const {
  TracedFormFactor result;
  const double error = kFormulaError * FormFactor(source, normal);
  double sum = 0;
  Image::ForEachPart(source, occluders, normal, 0, [&](const Image& image) {
    if (image.empty()) return;
    std::vector<Border> borders;
    Tracer(image).Trace(borders);
    result.borders += static_cast<std::int64_t>(borders.size());
    std::int32_t last = -1;
    for (const Border& border : borders) {
      if (border.place != last) ++result.vertices;
      last = border.place;
    }
    std::sort(borders.begin(), borders.end(), [](const Border& a, const Border& b) {
      return std::array{a.line, a.place, a.ascending ? 1 : 0} <
             std::array{b.line, b.place, b.ascending ? 1 : 0};
    });
    if (AddByFormula(image, borders, normal, error, sum))
      result.formula_borders += static_cast<std::int64_t>(borders.size());
    else
      AddByEdges(image, borders, normal, sum);
  });
  result.form_factor = std::max(0.0, sum);
  return result;
}

OcclusionRegistry::Method VertexTracingMethod() {
  return {"vertex-tracing",
          "adds up the visible corners of the source (Stark and Riesenfeld 1999); exact",
          {},
          [](const OcclusionOptions&) { return std::make_unique<const VertexTracing>(); }};
}

}  // namespace penumbra
