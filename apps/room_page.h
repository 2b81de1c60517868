// apps/room_page.h
//
// The page that `penumbra grid -o FILE.html` writes: the light of a room on one sheet of paper.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "display/photometry.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene.h"

namespace penumbra {

struct RoomPage {
  const Scene& scene;
  const PipelineReport& report;   // the report on the solve of the solution
  const std::vector<Rgb>& light;  // irradiance at the points of the grid [W/m^2]
  std::size_t left_out = 0;       // the number of points that no light can reach
  LightUnit unit = LightUnit::kWatts;
  std::string title;  // a title of one line that tells what was asked for
  std::string map;    // the drawing of the grid, as SVG
};

// An HTML file without references to other files: mean, minimum, maximum and uniformities of the light, the
// map, the error of the solution, the luminaires with area and flux, and the materials with area and
// reflectance. Fluxes are in lumens and reflectances are weighted as the eye sees them for LightUnit::kLux;
// otherwise, both are given for red, green and blue. Equal input gives equal bytes.
std::string RoomPageHtml(const RoomPage& page);

}  // namespace penumbra
