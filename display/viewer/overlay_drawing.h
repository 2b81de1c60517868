// display/viewer/overlay_drawing.h
//
// The primitives of which overlays consist: lines, points and transparent triangles in space.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "display/image.h"
#include "display/viewer/view_state.h"
#include "solver/geometry/vec.h"

namespace penumbra::viewer {

using Colour = ScreenColour;
namespace colour {
inline constexpr Colour kWhite{255, 255, 255}, kPink{255, 130, 190}, kGreen{60, 220, 90},
    kViolet{200, 80, 255}, kYellow{255, 225, 40}, kBlue{80, 140, 255}, kRed{255, 70, 60},
    kGrey{150, 150, 150}, kOrange{255, 150, 40}, kCyan{60, 220, 230};
}  // namespace colour

struct OverlayLine {
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();  // the end points of the drawn line [m]
  Colour colour;
  float width = 1.2F;  // width of the line [pixels]
  Selection pick;      // the object that a click on the line selects
};

struct OverlayPoint {
  Vec3 at = Vec3::Zero();  // the position of the drawn point [m]
  Colour colour;
  float radius = 2.5F;  // radius of the drawn disc [pixels]
};

struct OverlayTriangle {
  std::array<Vec3, 3> vertex;  // the positions of the vertices of the drawn triangle [m]
  Colour colour;
  float opacity = 1;
};

// PaintOverlay() draws all triangles first, then all lines, then all points; primitives of one kind are drawn
// in the order in which they were added.
struct OverlayDrawing {
  std::vector<OverlayTriangle> triangles;
  std::vector<OverlayLine> lines;
  std::vector<OverlayPoint> points;

  void Line(const Vec3& a, const Vec3& b, Colour colour, float width = 1.2F, Selection pick = {}) {
    lines.push_back({a, b, colour, width, pick});
  }
  void Outline(std::span<const Vec3> polygon, Colour colour, float width = 1.2F, Selection pick = {}) {
    for (std::size_t i = 0; i < polygon.size(); ++i)
      Line(polygon[i], polygon[(i + 1) % polygon.size()], colour, width, pick);
  }
  void Fill(std::span<const Vec3> convex, Colour colour, float opacity) {
    for (std::size_t i = 2; i < convex.size(); ++i)
      triangles.push_back({{convex[0], convex[i - 1], convex[i]}, colour, opacity});
  }
  // Adds a line from a to b with an arrowhead at b. The arrowhead lies in the plane that contains the line
  // and the direction `beside`.
  void Arrow(const Vec3& a, const Vec3& b, const Vec3& beside, Colour colour, float width = 1.2F,
             Selection pick = {});
};

}  // namespace penumbra::viewer
