// display/walkthrough/html_writer.h

#pragma once

#include "display/mesh_writer.h"

namespace penumbra {

// The mesh writer for an HTML page that shows the mesh in a browser by WebGL 2; the page is a single file
// that loads no other file. The HTML page evaluates the quadratic interpolants at every pixel, as the
// two-pass display does, and gives the same colours. The first view of the HTML page is MeshExport::camera.
// If MeshExport::exposure is not set, the HTML page determines an exposure for each camera as MeterExposure()
// does.
MeshWriterRegistry::Method HtmlWriterMethod();

}  // namespace penumbra
