// display/viewer/selection.h
//
// What is selected (thesis B.4.6): found by a click, drawn, told in words.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "display/camera.h"
#include "display/two_pass_display.h"
#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// The point of a front that the frame shows at the pixel (x, y); nothing for the background.
std::optional<ProbedPoint> PointAt(const Scene& scene, const IrradianceMesh& drawn,
                                   const RenderedFrame& frame, const PixelRays& rays, double x, double y);

// What a click on a point of a patch selects: with triangles shown the triangle; else the patch as a whole,
// or of an element that is selected already, the child there.
Selection SelectSurface(const OverlayContext& context, const ProbedPoint& at);

// What a click on a line selects: a link, or the tube of a link that is selected already; a discontinuity.
Selection SelectLine(const Selection& before, const Selection& picked);

// Whether the selection means something in the snapshot.
bool IsValid(const OverlayContext& context, const Selection& selection);

// The elements that belong to what is selected; empty for a triangle.
std::vector<ElementId> SelectedElements(const OverlayContext& context);

// The triangles of `drawn` that are left when only what is selected is drawn.
std::vector<std::uint32_t> IsolatedTriangles(const OverlayContext& context, const IrradianceMesh& drawn);

// What there is to tell about it, a line each.
std::vector<std::string> DescribeSelection(const OverlayContext& context);
std::string DescribePlace(const ProbedPoint& at, const Scene& scene);
std::vector<std::string> DescribeProbe(const ProbeResult& probe, const Scene& scene);

}  // namespace penumbra::viewer
