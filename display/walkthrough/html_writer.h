// display/walkthrough/html_writer.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// The writer of a page that shows the mesh in a browser, by WebGL 2: one HTML file that loads nothing else.
// The page evaluates the interpolants at every pixel, as the two-pass display does, and gives the same
// colours. It begins at the camera of the export. Without an exposure, the page meters each camera as
// MeterExposure() does.
MeshWriterRegistry::Method HtmlWriterMethod();

}  // namespace penumbra
