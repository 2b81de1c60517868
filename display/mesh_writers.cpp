#include "display/mesh_writers.h"

#include "display/glb_writer.h"
#include "display/ply_writer.h"
#include "display/vtu_writer.h"
#include "display/walkthrough/html_writer.h"

namespace penumbra {

MeshWriterRegistry& MeshWriters() {
  static MeshWriterRegistry registry(
      "mesh writer", {VtuWriterMethod(), PlyWriterMethod(), GlbWriterMethod(), HtmlWriterMethod()});
  return registry;
}

}  // namespace penumbra
