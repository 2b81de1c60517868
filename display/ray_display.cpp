#include "display/ray_display.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "display/camera.h"
#include "display/glm_conversion.h"
#include "mesh/interpolants/mesh_locator.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/base/random.h"
#include "solver/geometry/polygon.h"

namespace penumbra {
namespace {

constexpr std::size_t kPixelsPerTask = 32;
constexpr std::size_t kPixelsPerReport = 8192;  // between two looks at the context

// Rounding errors of eye + t * direction, in units of epsilon times the largest coordinate on the way: three
// for the direction, four for the quotient t, two for the product and the sum.
constexpr double kMeetingRounding = 9;

// Where the ray meets the plane of the patch that Embree found: in binary64, from the plane itself.
RayPoint MeetPlane(const Scene& scene, const RayCaster::Hit& hit, const Vec3& eye, const Vec3& direction) {
  const Patch& patch = scene.patches[static_cast<std::size_t>(hit.patch)];
  double along = patch.normal.dot(patch.vertex[0] - eye) / patch.normal.dot(direction);
  if (!(along > 0)) along = hit.distance;  // so near edge-on that the quotient is nothing but rounding
  RayPoint point;
  point.patch = hit.patch;
  point.position = eye + along * direction;
  const double largest = MaxAbs(eye) + along * MaxAbs(direction);
  point.uncertainty = kMeetingRounding * std::numeric_limits<double>::epsilon() * largest;
  return point;
}

}  // namespace

RayShader RayShade(const Scene& scene, const PointIrradiance& irradiance) {
  return [&scene, &irradiance](const RayPoint& point) {
    const Vec3& normal = scene.patches[static_cast<std::size_t>(point.patch)].normal;
    return irradiance.OnPatch(point.patch, {point.position, normal, Vec3::Zero(), point.uncertainty})
        .irradiance;
  };
}

RayShader LerpShade(const Scene& scene, const IrradianceMesh& mesh) {
  const auto locator = std::make_shared<const MeshLocator>(scene, mesh);
  return [locator, &mesh](const RayPoint& point) -> Rgb {
    std::optional<MeshLocator::Location> at = locator->Find(point.patch, point.position);
    // Embree's floats decide which patch is met, and seen edge-on they may err by any distance in its plane:
    // the nearest point of the patch answers then.
    if (!at) at = locator->Find(point.patch, point.position, std::numeric_limits<double>::infinity());
    return at ? IrradianceAt(mesh, *at).max(0.0).eval() : Rgb::Zero().eval();
  };
}

RayDisplay::RayDisplay(const Scene& scene, RayShader shader, int samples)
    : scene_(scene), rays_(scene), shader_(std::move(shader)) {
  PENUMBRA_CHECK(samples > 0);
  picture_.samples = samples;
}

RaySample RayDisplay::Sample(const PixelRays& rays, double x, double y) const {
  const Vec3 eye = ToEigen(rays.eye), direction = ToEigen(rays.Direction(x, y));
  const RayCaster::Hit hit = rays_.CastToFront(eye, direction);
  RaySample sample;
  if (hit.patch == kNoPatch) return sample;
  const Material& material = scene_.MaterialOf(hit.patch);
  sample.radiosity = material.emittance;
  if ((material.reflectance > 0).any())
    sample.radiosity += material.reflectance * shader_(MeetPlane(scene_, hit, eye, direction));
  sample.kind = (material.emittance > 0).any() ? PixelKind::kEmitter : PixelKind::kSurface;
  return sample;
}

const SampledPicture& RayDisplay::Render(const Camera& camera, int width, int height,
                                         const ExecutionContext& context) {
  const PixelRays rays = MakePixelRays(camera, width, height);
  const int samples = picture_.samples;
  picture_.linear.Resize(samples * width, height);
  for (std::vector<float>& plane : picture_.linear.channel) std::fill(plane.begin(), plane.end(), 0.0f);
  picture_.kind.assign(picture_.linear.PixelCount(), PixelKind::kBackground);

  const auto across = static_cast<std::size_t>(width), per_pixel = static_cast<std::size_t>(samples);
  const auto shade = [&](std::size_t pixel, std::size_t sample) {
    const double x = static_cast<double>(pixel % across) + AdditiveRecurrence(sample, kR2Alpha[0]);
    const double y = static_cast<double>(pixel / across) + AdditiveRecurrence(sample, kR2Alpha[1]);
    const RaySample sampled = Sample(rays, x, y);
    const std::size_t at = pixel * per_pixel + sample;
    picture_.linear.Set(at, ToPixel(sampled.radiosity));
    picture_.kind[at] = sampled.kind;
  };
  const std::size_t pixels = across * static_cast<std::size_t>(height);
  for (std::size_t begin = 0; begin < pixels && !context.Cancelled(); begin += kPixelsPerReport) {
    const std::size_t count = std::min(kPixelsPerReport, pixels - begin);
    ParallelFor(count, kPixelsPerTask, [&](std::size_t i) {
      for (std::size_t sample = 0; sample < per_pixel; ++sample) shade(begin + i, sample);
    });
    context.Report("render", static_cast<double>(begin + count) / static_cast<double>(pixels));
  }
  return picture_;
}

}  // namespace penumbra
