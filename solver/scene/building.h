// solver/scene/building.h
//
// Generates scenes of buildings with R rows and C columns of furnished rooms, to measure how time and memory
// grow with the size of a scene. Each room has about 60 polygons, and doorways join neighbouring rooms. The
// rooms of a building differ; the room in row r and column c is the same in every building.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// The largest permitted number of rows of rooms, and of columns of rooms, in a generated building.
inline constexpr int kMostRooms = 32;

struct BuildingSize {
  int rows = 1, columns = 1;  // the building has `rows` rooms along y and `columns` rooms along x
};

// The number of rows R and of columns C in a scene name `building-RxC`; nullopt for other names. Throws
// InputError unless R and C are integers from 1 to kMostRooms.
std::optional<BuildingSize> BuildingNamed(std::string_view name);

// Returns the text of an OBJ file of the building. Lengths are in metres, z is up, and the origin is a corner
// of the first room. The fronts of walls, floors and ceilings look into the rooms. The walls of neighbouring
// rooms are 0.2 m apart, and doorways lead through these walls; no doorway leads outside. Furniture and lamps
// are closed boxes that stand on the floors and hang at the ceilings; the floors and ceilings have no holes
// below the boxes.
std::string BuildingObj(const BuildingSize& size);

// Returns the text of the MTL material library to which the OBJ file of BuildingObj() refers.
std::string BuildingMtl();

// Returns three cameras: two views of the first room, and one of the whole building from above.
std::vector<Camera> BuildingCameras(const BuildingSize& size);

}  // namespace penumbra
