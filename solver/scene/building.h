// solver/scene/building.h
//
// Buildings of any size, for measuring how times and memory grow: R by C furnished rooms of about 60 polygons
// each, joined by doorways, every room different and the same in every building.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// The most rooms along either side.
inline constexpr int kMostRooms = 32;

struct BuildingSize {
  int rows = 1, columns = 1;  // along y and x
};

// The size that `building-RxC` names; nothing for other names. Throws InputError unless R and C are whole
// numbers from 1 to kMostRooms.
std::optional<BuildingSize> BuildingNamed(std::string_view name);

// The building as OBJ. Lengths in metres, z up; the first room's corner is the origin. Rooms look inwards and
// have walls 0.2 m apart, through which doorways lead to the neighbours; nothing leads outside. Furniture and
// lamps are closed boxes on the uncut floors and ceilings.
std::string BuildingObj(const BuildingSize& size);

// The material library that it names.
std::string BuildingMtl();

// Two views of the first room and one of the whole from above.
std::vector<Camera> BuildingCameras(const BuildingSize& size);

}  // namespace penumbra
