// display/viewer/selection.h
//
// The selection (thesis B.4.6): picking by a click, validity, description.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "display/camera.h"
#include "display/two_pass_display.h"
#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// The point of a front at the frame's pixel (x, y); nothing for the background.
std::optional<ProbedPoint> PointAt(const Scene& scene, const IrradianceMesh& drawn,
                                   const RenderedFrame& frame, const PixelRays& rays, double x, double y);

// The selection by a click on a point of a patch: the triangle, if triangles are shown; otherwise the patch
// as a whole or, if an element at the point is already selected, its child at the point.
Selection SelectSurface(const OverlayContext& context, const ProbedPoint& at);

// The selection by a click on a line: a link; the tube of a link that is already selected; or a
// discontinuity.
Selection SelectLine(const Selection& before, const Selection& picked);

// True if the snapshot contains the selected object.
bool IsValid(const OverlayContext& context, const Selection& selection);

// The elements of the selected object; empty for a triangle.
std::vector<ElementId> SelectedElements(const OverlayContext& context);

// The triangles of `drawn` that remain when the picture shows only the selection.
std::vector<std::uint32_t> IsolatedTriangles(const OverlayContext& context, const IrradianceMesh& drawn);

// A description of the selected object, one string per line.
std::vector<std::string> DescribeSelection(const OverlayContext& context);
std::string DescribePlace(const ProbedPoint& at, const Scene& scene);
std::vector<std::string> DescribeProbe(const ProbeResult& probe, const Scene& scene);

}  // namespace penumbra::viewer
