// solver/scene/building.h
//
// Generates buildings of any size, for measuring the growth of time and memory: R by C furnished rooms of
// about 60 polygons each, joined by doorways. The rooms of a building differ; the room in row r and column c
// is the same in every building.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// The largest number of rows, and the largest number of columns.
inline constexpr int kMostRooms = 32;

struct BuildingSize {
  int rows = 1, columns = 1;  // along y and x
};

// The size in a name `building-RxC`; nullopt for other names. Throws InputError unless R and C are integers
// from 1 to kMostRooms.
std::optional<BuildingSize> BuildingNamed(std::string_view name);

// The text of the building's OBJ file. Lengths are in metres, z is up, and the origin is a corner of the
// first room. The faces of rooms face inwards. The walls of neighbouring rooms are 0.2 m apart, and doorways
// lead through them; no doorway leads outside. Furniture and lamps are closed boxes on the uncut floors and
// ceilings.
std::string BuildingObj(const BuildingSize& size);

// The text of the material library that BuildingObj() refers to.
std::string BuildingMtl();

// Two views of the first room, and one of the whole building from above.
std::vector<Camera> BuildingCameras(const BuildingSize& size);

}  // namespace penumbra
