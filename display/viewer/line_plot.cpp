#include "display/viewer/line_plot.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "display/viewer/settings.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra::viewer {
namespace {

// A point is in a patch's plane, and an end that was typed on its face, within this part of the diagonal, as
// for the command probe.
constexpr double kOnPlane = 1e-6;
// Normals of one plane agree within about 0.1 degrees.
constexpr double kSameNormal = 1 - 1e-6;

// True if the point, which is in the plane of the patch, lies within its edges or at most `reach` outside.
bool Contains(const Patch& patch, const Vec3& point, double reach) {
  const std::span<const Vec3> corners = patch.Vertices();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 edge = corners[(i + 1) % corners.size()] - corners[i];
    const Vec3 inwards = patch.normal.cross(edge).normalized();
    if (inwards.dot(point - corners[i]) < -reach) return false;
  }
  return true;
}

// The patches of one plane that look to the same side.
std::vector<PatchId> PatchesOfPlane(const Scene& scene, PatchId patch) {
  const Patch& of = scene.patches[static_cast<std::size_t>(patch)];
  const double reach = kOnPlane * scene.Diagonal();
  std::vector<PatchId> found;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    const Patch& other = scene.patches[p];
    if (other.normal.dot(of.normal) >= kSameNormal &&
        std::abs(of.normal.dot(other.vertex[0] - of.vertex[0])) <= reach)
      found.push_back(static_cast<PatchId>(p));
  }
  return found;
}

}  // namespace

LinePlot PlotAlong(const LightState& light, const MeshState* mesh, const PlotLine& line,
                   const ExecutionContext& context) {
  const Scene& scene = light.scene();
  const std::vector<PatchId> plane = PatchesOfPlane(scene, line.patch);
  const double reach = kOnPlane * scene.Diagonal();
  LinePlot plot;
  plot.line = line;
  plot.samples.resize(kLineSamples);
  ParallelFor(plot.samples.size(), 4, [&](std::size_t i) {
    if (context.Cancelled()) return;
    LinePlot::Sample& sample = plot.samples[i];
    const double t = static_cast<double>(i) / (kLineSamples - 1);
    sample.position = (1 - t) * line.ends[0] + t * line.ends[1];
    sample.distance = t * (line.ends[1] - line.ends[0]).norm();
    for (const PatchId p : plane) {
      const Patch& patch = scene.patches[static_cast<std::size_t>(p)];
      if (!Contains(patch, sample.position, reach)) continue;
      ReceiverPoint at;
      at.position = sample.position;
      at.normal = patch.normal;
      sample.on_face = true;
      sample.exact = light.Exact().OnPatch(p, at).irradiance;
      if (mesh)
        if (const auto place = mesh->Locator().Find(p, sample.position, reach))
          sample.interpolated = Rgb(IrradianceAt(mesh->mesh(), *place).max(0.0));
      break;
    }
  });
  return plot;
}

std::string LinePlotCsv(const LinePlot& plot) {
  std::string csv = "distance,x,y,z,exact_r,exact_g,exact_b,interp_r,interp_g,interp_b\n";
  for (const LinePlot::Sample& s : plot.samples) {
    if (!s.on_face) continue;
    const Rgb interpolated =
        s.interpolated.value_or(Rgb(Rgb::Constant(std::numeric_limits<double>::quiet_NaN())));
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", s.distance, s.position.x(), s.position.y(),
                       s.position.z(), s.exact[0], s.exact[1], s.exact[2], interpolated[0], interpolated[1],
                       interpolated[2]);
  }
  return csv;
}

std::string TextOf(const std::optional<PlotLine>& line) {
  if (!line) return "none";
  const Vec3 &a = line->ends[0], &b = line->ends[1];
  return fmt::format("{},{},{} {},{},{}", a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
}

std::optional<PlotLine> ParseLine(const Scene& scene, const std::string& text) {
  if (text == "none") return std::nullopt;
  PlotLine line;
  std::istringstream words(text);
  std::string end[2], more;
  if (!(words >> end[0] >> end[1]) || (words >> more))
    throw InputError(fmt::format("'{}' is neither x,y,z x,y,z nor none", text));
  for (std::size_t k = 0; k < 2; ++k) {
    std::istringstream numbers(end[k]);
    std::string number;
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::getline(numbers, number, ',')) throw InputError(fmt::format("'{}' is not x,y,z", end[k]));
      line.ends[k][axis] = NumberFrom(number, -1e12, 1e12);
    }
    if (std::getline(numbers, number)) throw InputError(fmt::format("'{}' is not x,y,z", end[k]));
  }
  const double reach = kOnPlane * scene.Diagonal();
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    const Patch& patch = scene.patches[p];
    const auto in_plane = [&](const Vec3& v) {
      return std::abs(patch.normal.dot(v - patch.vertex[0])) <= reach;
    };
    if (!in_plane(line.ends[0]) || !in_plane(line.ends[1]) || !Contains(patch, line.ends[0], reach)) continue;
    line.patch = static_cast<PatchId>(p);
    return line;
  }
  throw InputError("no face of the scene contains the line; both ends must lie in the plane of one");
}

}  // namespace penumbra::viewer
