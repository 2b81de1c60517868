#include "display/viewer/overlay_drawing.h"

namespace penumbra::viewer {

void OverlayDrawing::Arrow(const Vec3& a, const Vec3& b, const Vec3& beside, Colour colour, float width,
                           Selection pick) {
  constexpr double kBarb = 0.05;  // of the length
  Line(a, b, colour, width, pick);
  const Vec3 back = kBarb * (a - b);
  Vec3 aside = beside - beside.dot(back) / back.squaredNorm() * back;
  if (!(aside.norm() > 1e-9)) aside = back.unitOrthogonal();
  aside *= 0.4 * back.norm() / aside.norm();
  Line(b, b + back + aside, colour, width, pick);
  Line(b, b + back - aside, colour, width, pick);
}

}  // namespace penumbra::viewer
