#include "display/viewer/overlay_painter.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "display/glm_conversion.h"
#include "display/unit_vectors.h"
#include "solver/base/parallel.h"

namespace penumbra::viewer {
namespace {

constexpr int kBandRows = 32;  // rows of the picture that a task paints

// Lines are cut where they come nearer to the eye than this part of their distance from it.
constexpr double kNearOfLine = 1e-3;

// A line of the picture: 1 / depth is affine along it.
struct ScreenLine {
  double x0, y0, z0, x1, y1, z1;
  Colour colour;
  float width;
};

// Depth along the view, and the point's place in the picture.
struct View {
  explicit View(const PixelRays& pixel_rays)
      : rays(pixel_rays),
        forward(Normalized(glm::cross(rays.dx, rays.dy))),
        dx(rays.dx / glm::dot(rays.dx, rays.dx)),
        dy(rays.dy / glm::dot(rays.dy, rays.dy)),
        x0(glm::dot(rays.corner, dx)),
        y0(glm::dot(rays.corner, dy)) {}

  double Depth(const glm::dvec3& p) const { return glm::dot(forward, p - rays.eye); }
  ScreenPoint Place(const glm::dvec3& p) const {
    const double inverse = 1 / Depth(p);
    const glm::dvec3 direction = (p - rays.eye) * inverse;
    return {glm::dot(direction, dx) - x0, glm::dot(direction, dy) - y0, inverse};
  }

  const PixelRays& rays;
  glm::dvec3 forward, dx, dy;
  double x0, y0;
};

// The part of the line before the eye and within the picture, with a margin.
std::optional<ScreenLine> ToScreen(const View& view, const OverlayLine& line, int width, int height) {
  glm::dvec3 a = ToGlm(line.a), b = ToGlm(line.b);
  const double da = view.Depth(a), db = view.Depth(b);
  const double near = kNearOfLine * std::max(std::abs(da), std::abs(db));
  if (da < near && db < near) return std::nullopt;
  if (da < near) a += (near - da) / (db - da) * (b - a);
  if (db < near) b += (near - db) / (da - db) * (a - b);
  const ScreenPoint p = view.Place(a), q = view.Place(b);
  double t0 = 0, t1 = 1;
  const auto clip = [&](double from, double to, double low, double high) {
    const double delta = to - from;
    if (delta == 0) return from >= low && from <= high;
    const double u = (low - from) / delta, v = (high - from) / delta;
    t0 = std::max(t0, std::min(u, v));
    t1 = std::min(t1, std::max(u, v));
    return t0 <= t1;
  };
  const double margin = static_cast<double>(line.width) + 2;
  if (!clip(p.x, q.x, -margin, width + margin) || !clip(p.y, q.y, -margin, height + margin))
    return std::nullopt;
  const auto at = [&](double t, double from, double to) { return from + t * (to - from); };
  return ScreenLine{at(t0, p.x, q.x), at(t0, p.y, q.y), at(t0, p.inverse_depth, q.inverse_depth),
                    at(t1, p.x, q.x), at(t1, p.y, q.y), at(t1, p.inverse_depth, q.inverse_depth),
                    line.colour,      line.width};
}

void Blend(Srgb8Image* picture, int x, int y, Colour colour, double opacity) {
  std::uint8_t* pixel = picture->pixels.data() + 3 * picture->Index(x, y);
  const std::uint8_t rgb[3] = {colour.red, colour.green, colour.blue};
  for (int c = 0; c < 3; ++c)
    pixel[c] = static_cast<std::uint8_t>(std::lround(pixel[c] + opacity * (rgb[c] - pixel[c])));
}

// Steps along the longer side; across it, a pixel is covered by how far it lies within the line's width.
void PaintLine(const ScreenLine& line, int row_begin, int row_end, const DepthMap& depth,
               Srgb8Image* picture) {
  const bool steep = std::abs(line.y1 - line.y0) > std::abs(line.x1 - line.x0);
  double u0 = steep ? line.y0 : line.x0, v0 = steep ? line.x0 : line.y0, z0 = line.z0;
  double u1 = steep ? line.y1 : line.x1, v1 = steep ? line.x1 : line.y1, z1 = line.z1;
  if (u0 > u1) {
    std::swap(u0, u1);
    std::swap(v0, v1);
    std::swap(z0, z1);
  }
  const double length = u1 - u0;
  const double slope = length > 0 ? (v1 - v0) / length : 0;
  const double half = 0.5 * static_cast<double>(line.width) * std::sqrt(1 + slope * slope);
  int begin = static_cast<int>(std::floor(u0)), end = static_cast<int>(std::floor(u1)) + 1;
  if (steep) {
    begin = std::max(begin, row_begin);
    end = std::min(end, row_end);
  } else {
    begin = std::max(begin, 0);
    end = std::min(end, picture->width);
    if (std::abs(slope) > 1e-6) {  // the columns in which the line crosses the band
      const double ua = u0 + (row_begin - half - 1 - v0) / slope, ub = u0 + (row_end + half + 1 - v0) / slope;
      begin = std::max(begin, static_cast<int>(std::floor(std::clamp(std::min(ua, ub), -1e9, 1e9))));
      end = std::min(end, static_cast<int>(std::ceil(std::clamp(std::max(ua, ub), -1e9, 1e9))) + 1);
    }
  }
  for (int u = begin; u < end; ++u) {
    const double t = length > 0 ? std::clamp((u + 0.5 - u0) / length, 0.0, 1.0) : 0;
    const double v = v0 + t * (v1 - v0), z = z0 + t * (z1 - z0);
    const int first = static_cast<int>(std::floor(v - half - 0.5)),
              last = static_cast<int>(std::ceil(v + half));
    for (int w = first; w <= last; ++w) {
      const int x = steep ? w : u, y = steep ? u : w;
      if (x < 0 || x >= picture->width || y < row_begin || y >= row_end) continue;
      const double covered = std::clamp(half + 0.5 - std::abs(w + 0.5 - v), 0.0, 1.0);
      if (covered > 0 && z >= static_cast<double>(depth.Threshold(x, y)))
        Blend(picture, x, y, line.colour, covered);
    }
  }
}

void PaintPoint(const ScreenPoint& at, const OverlayPoint& point, int row_begin, int row_end,
                const DepthMap& depth, Srgb8Image* picture) {
  const int cx = static_cast<int>(std::floor(at.x)), cy = static_cast<int>(std::floor(at.y));
  if (cx < 0 || cx >= picture->width || cy < 0 || cy >= picture->height ||
      at.inverse_depth < static_cast<double>(depth.Threshold(cx, cy)))
    return;
  const double radius = static_cast<double>(point.radius);
  const int reach = static_cast<int>(std::ceil(radius)) + 1;
  for (int y = std::max(row_begin, cy - reach); y < std::min(row_end, cy + reach + 1); ++y)
    for (int x = std::max(0, cx - reach); x < std::min(picture->width, cx + reach + 1); ++x) {
      const double covered = std::clamp(radius + 0.5 - std::hypot(x + 0.5 - at.x, y + 0.5 - at.y), 0.0, 1.0);
      if (covered > 0) Blend(picture, x, y, point.colour, covered);
    }
}

// A triangle by homogeneous edge functions, as the rasteriser has them: wherever its vertices lie.
void PaintTriangle(const View& view, const OverlayTriangle& triangle, int row_begin, int row_end,
                   const DepthMap& depth, Srgb8Image* picture) {
  const PixelRays& rays = view.rays;
  const std::array<glm::dvec3, 3> vertex = {ToGlm(triangle.vertex[0]), ToGlm(triangle.vertex[1]),
                                            ToGlm(triangle.vertex[2])};
  const std::array<glm::dvec3, 3> p = {vertex[0] - rays.eye, vertex[1] - rays.eye, vertex[2] - rays.eye};
  const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
  const double height = glm::dot(normal, p[0]);
  if (height == 0) return;
  std::array<glm::dvec3, 4> plane = {glm::cross(p[0], p[1]), glm::cross(p[1], p[2]), glm::cross(p[2], p[0]),
                                     normal / height};
  for (int k = 0; k < 3; ++k) plane[static_cast<std::size_t>(k)] *= height > 0 ? 1.0 : -1.0;
  // Where all vertices lie before the eye, only the box around them is walked.
  double low_x = 0, high_x = picture->width, low_y = row_begin, high_y = row_end;
  if (std::all_of(vertex.begin(), vertex.end(), [&](const glm::dvec3& v) {
        return view.Depth(v) > kNearOfLine * glm::length(v - rays.eye);
      })) {
    double box[4] = {1e30, -1e30, 1e30, -1e30};
    for (const glm::dvec3& v : vertex) {
      const ScreenPoint at = view.Place(v);
      box[0] = std::min(box[0], at.x);
      box[1] = std::max(box[1], at.x);
      box[2] = std::min(box[2], at.y);
      box[3] = std::max(box[3], at.y);
    }
    low_x = std::max(low_x, std::floor(box[0]));
    high_x = std::min(high_x, std::ceil(box[1]));
    low_y = std::max(low_y, std::floor(box[2]));
    high_y = std::min(high_y, std::ceil(box[3]));
  }
  for (int y = static_cast<int>(low_y); y < static_cast<int>(high_y); ++y)
    for (int x = static_cast<int>(low_x); x < static_cast<int>(high_x); ++x) {
      const glm::dvec3 direction = rays.Direction(x + 0.5, y + 0.5);
      const double inverse = glm::dot(plane[3], direction);
      if (inverse <= 0 || inverse < static_cast<double>(depth.Threshold(x, y))) continue;
      if (glm::dot(plane[0], direction) < 0 || glm::dot(plane[1], direction) < 0 ||
          glm::dot(plane[2], direction) < 0)
        continue;
      Blend(picture, x, y, triangle.colour, static_cast<double>(triangle.opacity));
    }
}

}  // namespace

DepthMap::DepthMap(const PixelRays& rays, int width, int height)
    : rays_(rays),
      width_(width),
      height_(height),
      inverse_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0F) {}

DepthMap::DepthMap(const PixelRays& rays, const RenderedFrame& frame, const IrradianceMesh& mesh)
    : DepthMap(rays, frame.width, frame.height) {
  constexpr double kRounding = 1e-5;  // of float barycentrics and of lines' own coordinates, relative
  const auto width = static_cast<std::size_t>(frame.width);
  const std::span<const std::uint32_t> ids = frame.triangle;
  ParallelFor(static_cast<std::size_t>(frame.height), 8, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < frame.width;) {
      const std::uint32_t id = ids[row * width + static_cast<std::size_t>(x)];
      if (id == kNoTriangle) {
        ++x;
        continue;
      }
      const auto& at = mesh.triangles[id].vertex;
      const glm::dvec3 a = ToGlm(mesh.positions[at[0]]), b = ToGlm(mesh.positions[at[1]]),
                       c = ToGlm(mesh.positions[at[2]]);
      const glm::dvec3 normal = glm::cross(b - a, c - a);
      // 1 / depth = (normal . direction) / (normal . (a - eye)).
      const glm::dvec3 plane = normal / glm::dot(normal, a - rays.eye);
      const double slope = std::abs(glm::dot(plane, rays.dx)) + std::abs(glm::dot(plane, rays.dy));
      for (; x < frame.width && ids[row * width + static_cast<std::size_t>(x)] == id; ++x) {
        const double inverse = glm::dot(plane, rays.Direction(x + 0.5, y + 0.5));
        inverse_[Index(x, y)] =
            static_cast<float>(std::max(0.0, inverse * (1 - kRounding) - std::min(slope, 0.5 * inverse)));
      }
    }
  });
}

ScreenPoint Project(const PixelRays& rays, const Vec3& point) { return View(rays).Place(ToGlm(point)); }

void PaintOverlay(const OverlayDrawing& drawing, const DepthMap& depth, Srgb8Image* picture) {
  const View view(depth.rays());
  std::vector<ScreenLine> lines;
  lines.reserve(drawing.lines.size());
  for (const OverlayLine& line : drawing.lines)
    if (const auto on_screen = ToScreen(view, line, picture->width, picture->height))
      lines.push_back(*on_screen);
  const auto bands = static_cast<std::size_t>((picture->height + kBandRows - 1) / kBandRows);
  std::vector<std::vector<std::uint32_t>> in_band(bands);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double margin = static_cast<double>(lines[i].width) + 2;
    const double low = std::min(lines[i].y0, lines[i].y1) - margin;
    const double high = std::max(lines[i].y0, lines[i].y1) + margin;
    const int first = std::max(0, static_cast<int>(std::floor(low / kBandRows)));
    const int last = std::min(static_cast<int>(bands) - 1, static_cast<int>(std::floor(high / kBandRows)));
    for (int b = first; b <= last; ++b)
      in_band[static_cast<std::size_t>(b)].push_back(static_cast<std::uint32_t>(i));
  }
  ParallelFor(bands, 1, [&](std::size_t band) {
    const int begin = static_cast<int>(band) * kBandRows, end = std::min(begin + kBandRows, picture->height);
    for (const OverlayTriangle& triangle : drawing.triangles)
      PaintTriangle(view, triangle, begin, end, depth, picture);
    for (const std::uint32_t i : in_band[band]) PaintLine(lines[i], begin, end, depth, picture);
    for (const OverlayPoint& point : drawing.points)
      if (const glm::dvec3 at = ToGlm(point.at); view.Depth(at) > 0)
        PaintPoint(view.Place(at), point, begin, end, depth, picture);
  });
}

Selection PickLine(const OverlayDrawing& drawing, const DepthMap& depth, double x, double y) {
  const View view(depth.rays());
  Selection picked;
  double nearest = kPickDistance;
  for (const OverlayLine& line : drawing.lines) {
    if (!line.pick) continue;
    const auto on_screen = ToScreen(view, line, depth.width(), depth.height());
    if (!on_screen) continue;
    const glm::dvec2 pointer(x, y), a(on_screen->x0, on_screen->y0),
        d(on_screen->x1 - on_screen->x0, on_screen->y1 - on_screen->y0);
    const double square = glm::dot(d, d);
    const double t = square > 0 ? std::clamp(glm::dot(d, pointer - a) / square, 0.0, 1.0) : 0.0;
    const glm::dvec2 at = a + t * d;
    const double distance = glm::length(at - pointer);
    if (distance >= nearest) continue;
    const int px = static_cast<int>(std::floor(at.x)), py = static_cast<int>(std::floor(at.y));
    if (px < 0 || px >= depth.width() || py < 0 || py >= depth.height()) continue;
    if (on_screen->z0 + t * (on_screen->z1 - on_screen->z0) < static_cast<double>(depth.Threshold(px, py)))
      continue;
    nearest = distance;
    picked = line.pick;
  }
  return picked;
}

}  // namespace penumbra::viewer
