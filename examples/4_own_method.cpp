// Example 4: a method of your own, outside the library's code, in one file.
//
// An occlusion method says how much a point sees of a light past what stands between. The library's own
// methods are exact but for one. The method of this example casts a single ray to the middle of the light:
// the light counts as seen as a whole or not at all. That gives hard shadows, in place of soft ones.
//
//   example_4_own_method

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "solver/base/check.h"
#include "solver/scene/named_scene.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/visibility/exact/occlusion_methods.h"
#include "solver/visibility/point/form_factor.h"

using namespace penumbra;

namespace {

// 1. Write the method: a class with one function. `source` is what the point sees of a light, as directions.
//    Each occluder is a cone of directions that something before the light covers.
class MiddleRay : public OcclusionMethod {
 public:
  double VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                           const Vec3& normal) const override {
    Vec3 middle = Vec3::Zero();
    for (int i = 0; i < source.size(); ++i) middle += source[i];
    const auto hides = [&](const Occluder& occluder) { return Covers(*occluder.cone, middle); };
    return std::any_of(occluders.begin(), occluders.end(), hides) ? 0 : FormFactor(source, normal);
  }

 private:
  static bool Covers(const Cone& cone, const Vec3& direction) {
    return cone.size > 0 && std::all_of(cone.normal.begin(), cone.normal.begin() + cone.size,
                                        [&](const Vec3& normal) { return normal.dot(direction) >= 0; });
  }
};

// 2. Describe the method: a name, a line of help, the options that it alone obeys, and how it is made.
OcclusionRegistry::Method MiddleRayMethod() {
  return {"middle-ray", "casts one ray to the middle of the light", {}, [](const OcclusionOptions&) {
            return std::make_unique<const MiddleRay>();
          }};
}

// Direct irradiance at a point of the plane z = 0, in the green channel [W/m^2].
double DirectIrradiance(const PointIrradiance& irradiance, double x) {
  ReceiverPoint at;
  at.position = Vec3(x, 0, 0);
  return irradiance.Anywhere(at).irradiance[1];
}

}  // namespace

int main() try {
  // 3. Add the method to the registry. From here on it is a method like any other: it has a name, and whoever
  //    lists the methods lists it, too.
  OcclusionMethods().Add(MiddleRayMethod());
  for (const OcclusionRegistry::Method& method : OcclusionMethods().methods())
    fmt::print("{:<16} {}\n", method.name, method.help);

  // 4. Ask for it by its name, and for an exact method to compare it with.
  const Scene scene = ReadNamedScene("floating-cube", SceneOptions());
  const std::unique_ptr<const OcclusionMethod> own = OcclusionMethods().Make("middle-ray", {}),
                                               exact = OcclusionMethods().Make("clipping", {});

  // 5. Use both for the direct light of the scene.
  const PatchVisibility none;  // what patches see of each other is of use for points on patches alone
  PointIrradianceOptions with_own, with_exact;
  with_own.method = own.get();
  with_exact.method = exact.get();
  const PointIrradiance by_own(scene, none, SourceSet::Emitters(scene), with_own);
  const PointIrradiance by_exact(scene, none, SourceSet::Emitters(scene), with_exact);

  // 6. Walk through a shadow. Exact light fades; the light of the single ray jumps.
  fmt::print("\n{:>8} {:>10} {:>12}\n", "x [m]", "clipping", "middle-ray");
  double largest = 0;
  for (double x = 0; x <= 1.6; x += 0.1) {
    const double fades = DirectIrradiance(by_exact, x), jumps = DirectIrradiance(by_own, x);
    fmt::print("{:8.2f} {:10.4f} {:12.4f}\n", x, fades, jumps);
    largest = std::max(largest, std::abs(fades - jumps));
  }
  fmt::print("largest difference {:.4f} W/m^2\n", largest);
  return largest > 0 ? 0 : 1;
} catch (const InputError& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
