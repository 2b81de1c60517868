#include "mesh/refinement/refinement_step.h"

#include <algorithm>
#include <array>
#include <unordered_set>

#include "mesh/discontinuities/discontinuity_line.h"

namespace penumbra {
namespace {

// The factor by which halving a leaf reduces the error, where the irradiance is smooth, and across a bend
// without an edge.
constexpr double kSmoothGain = 8, kBentGain = 4;
// A discontinuity helps a triangle if its jumps alone explain at least this fraction of the error. Estimates
// of jumps are accurate to a factor of two, and other jumps may add to them.
constexpr double kTelling = 0.35;
// Triangles that the division of a leaf adds to those that it makes anew, and triangles that an edge adds to
// a leaf.
constexpr double kDivisionCost = 6, kEdgeCost = 2;
// A step is postponed if other steps have left less than this fraction of the area that it would mend.
constexpr double kWorthTaking = 0.5;

using Corners = std::array<Vec2, 3>;

Corners CornersOf(const PatchTriangulation& patch, std::size_t t) {
  const auto& v = patch.triangles[t].vertex;
  return {patch.in_plane[v[0]], patch.in_plane[v[1]], patch.in_plane[v[2]]};
}

double Area(const Corners& c) { return 0.5 * Cross2(c[1] - c[0], c[2] - c[0]); }

// True if the segment crosses the interior of the triangle.
bool Crosses(const OmittedPart& part, const Corners& corners) {
  const double length = (part.to - part.from).norm();
  const LineInterval inside =
      ClipLine(part.from, (part.to - part.from) / length, Polygon2(corners.begin(), corners.end()), 0);
  return std::max(inside.t0, 0.0) < std::min(inside.t1, length);
}

// The steps of one patch, whose first triangle has the number `base`.
class StepFinder {
 public:
  StepFinder(const IrradianceMesh& mesh, const PatchTriangulation& patch, std::size_t base,
             std::span<const TriangleError> errors, double floor, double error)
      : mesh_(mesh), patch_(patch), base_(base), errors_(errors), floor_(floor), error_(error) {
    told_.resize(patch.triangles.size());
  }

  // REQUIRES: called before AddDivisions(), which depends on the triangles that discontinuities cross.
  void AddDiscontinuities(const OmittedOfPatch& omitted, std::vector<RefinementStep>& steps) {
    for (const OmittedDiscontinuity& d : omitted.omitted) {
      RefinementStep step;
      step.patch = patch_.patch;
      step.discontinuity = d.number;
      step.cost = kEdgeCost * static_cast<double>(d.leaves);
      for (const OmittedPart& part : d.parts)
        for (std::uint32_t t = patch_.first_triangle[part.leaf]; t < patch_.first_triangle[part.leaf + 1];
             ++t) {
          if (!Errs(t)) continue;
          const Corners corners = CornersOf(patch_, t);
          if (!Crosses(part, corners)) continue;
          if (ErrorOnPiece(part, corners) < kTelling * errors_[base_ + t].max * Brightness(t)) continue;
          told_[t] = true;
          step.mended.push_back({static_cast<std::uint32_t>(base_ + t), Area(corners)});
        }
      if (!step.mended.empty()) steps.push_back(std::move(step));
    }
  }

  void AddDivisions(std::vector<RefinementStep>& steps) {
    for (std::size_t i = 0; i < patch_.leaves.size(); ++i) {
      RefinementStep step;
      step.patch = patch_.patch;
      step.leaf = patch_.leaves[i];
      // The triangulation has split a leaf that was crowded.
      const std::size_t first = i;
      while (i + 1 < patch_.leaves.size() && patch_.leaves[i + 1] == step.leaf) ++i;
      const std::uint32_t begin = patch_.first_triangle[first], end = patch_.first_triangle[i + 1];
      for (std::uint32_t t = begin; t < end; ++t) {
        if (!Errs(t)) continue;
        // Half the area counts for triangles that one division does not mend.
        const bool at_once = errors_[base_ + t].max <= (told_[t] ? kBentGain : kSmoothGain) * error_;
        step.mended.push_back(
            {static_cast<std::uint32_t>(base_ + t), (at_once ? 1 : 0.5) * Area(CornersOf(patch_, t))});
      }
      step.cost = end - begin + kDivisionCost;
      if (!step.mended.empty()) steps.push_back(std::move(step));
    }
  }

 private:
  bool Errs(std::size_t t) const { return errors_[base_ + t].max > error_; }
  // Jumps are those of the brightest channel; therefore this is the irradiance of the brightest channel.
  double Brightness(std::size_t t) const {
    return std::max(mesh_.irradiance[base_ + t].At(1.0 / 3, 1.0 / 3).maxCoeff(), floor_);
  }

  const IrradianceMesh& mesh_;
  const PatchTriangulation& patch_;
  const std::size_t base_;
  const std::span<const TriangleError> errors_;
  const double floor_, error_;
  std::vector<bool> told_;  // triangles whose error a discontinuity explains
};

double Unmended(const RefinementStep& step, const std::unordered_set<std::uint32_t>& taken) {
  double area = 0;
  for (const RefinementStep::Mended& m : step.mended)
    if (!taken.contains(m.triangle)) area += m.area;
  return area;
}

}  // namespace

std::vector<RefinementStep> FindRefinementSteps(const IrradianceMesh& mesh,
                                                std::span<const PatchTriangulation> triangulations,
                                                std::span<const TriangleError> errors,
                                                std::span<const OmittedOfPatch> omitted, double error,
                                                double floor) {
  std::vector<RefinementStep> steps;
  std::size_t base = 0;
  for (std::size_t p = 0; p < triangulations.size(); ++p) {
    StepFinder finder(mesh, triangulations[p], base, errors, floor, error);
    if (p < omitted.size()) finder.AddDiscontinuities(omitted[p], steps);
    finder.AddDivisions(steps);
    base += triangulations[p].triangles.size();
  }
  return steps;
}

std::vector<std::size_t> ChooseRefinementSteps(std::span<const RefinementStep> steps, double area) {
  std::vector<double> whole(steps.size());
  std::vector<std::size_t> order(steps.size()), chosen;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    order[i] = i;
    whole[i] = Unmended(steps[i], {});
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return whole[a] / steps[a].cost > whole[b] / steps[b].cost;
  });
  std::unordered_set<std::uint32_t> taken;
  double mended = 0;
  for (const std::size_t i : order) {
    if (mended >= area) break;
    const double left = Unmended(steps[i], taken);
    if (left < kWorthTaking * whole[i]) continue;
    for (const RefinementStep::Mended& m : steps[i].mended) taken.insert(m.triangle);
    mended += left;
    chosen.push_back(i);
  }
  return chosen;
}

}  // namespace penumbra
