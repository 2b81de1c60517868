// solver/scene/triangle_table_reader.h

#pragma once

#include "solver/scene/scene_reader.h"

namespace penumbra {

// The reader of files whose names end in .triangles: a table with a triangle in each line, the nine
// coordinates of its corners [m], counter-clockwise seen from the front, then reflectance and emittance
// [W/m^2], separated by commas.
SceneReaderRegistry::Method TriangleTableReaderMethod();

}  // namespace penumbra
