// display/viewer/selection.h
//
// Functions on the viewer's selection (thesis B.4.6): selecting an object by a click, and describing the
// selected object.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "display/camera.h"
#include "display/two_pass_display.h"
#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// The point of a patch's front that is visible at pixel (x, y) of the frame; nullopt if the pixel shows the
// background.
std::optional<ProbedPoint> PointAt(const Scene& scene, const IrradianceMesh& drawn,
                                   const RenderedFrame& frame, const PixelRays& rays, double x, double y);

// The new selection after a click on a point of a patch. If the viewer shows triangles, or if a triangle is
// already selected, the click selects the triangle at the point. If no triangle is to be selected, the click
// selects a quadtree element. If an element that contains the point is already selected, the click selects
// this element's child at the point; otherwise, the root element of the patch.
Selection SelectSurface(const OverlayContext& context, const ProbedPoint& at);

// The new selection after a click on an overlay line. `picked` is the link or discontinuity that the line
// shows. If the picked link is already selected, the link's tube (convex hull of source and receiver) is
// selected instead.
Selection SelectLine(const Selection& before, const Selection& picked);

// True if the current Snapshot (state of the solver) contains the selected object.
bool IsValid(const OverlayContext& context, const Selection& selection);

// The patches of an object or of a material. REQUIRES: `part` is one.
std::vector<PatchId> PatchesOf(const Scene& scene, const Selection& part);

// The elements of the selected object; empty for a triangle.
std::vector<ElementId> SelectedElements(const OverlayContext& context);

// The indices of the triangles of `drawn` that are drawn if the picture shows only the selection.
std::vector<std::uint32_t> IsolatedTriangles(const OverlayContext& context, const IrradianceMesh& drawn);

// A description of the selected object, one string per line.
std::vector<std::string> DescribeSelection(const OverlayContext& context);
std::string DescribePlace(const ProbedPoint& at, const Scene& scene);
std::vector<std::string> DescribeProbe(const ProbeResult& probe, const Scene& scene);

}  // namespace penumbra::viewer
