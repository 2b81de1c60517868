// display/viewer/view_state.h
//
// All parameters of the window's picture except the state of the solution. The window's picture is a function
// of the Snapshot (state of the solution) and the ViewState.

#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "display/opengl_passes.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene.h"

namespace penumbra::viewer {

// The modes in which faces are drawn, with the same meaning as in the command `penumbra render`.
enum class DrawMode : std::uint8_t { kFlat, kGouraud, kGouraudMesh, kInterpolant, kExact, kLerp, kRho };

// True for drawing modes that cast rays. Until all rays of the picture have been cast, the two-pass display
// draws the picture.
inline bool CastsRays(DrawMode mode) { return mode == DrawMode::kExact || mode == DrawMode::kLerp; }

// The kind of mesh that a drawing mode shows.
MeshKind MeshOf(DrawMode mode);

// The back ends that draw the two passes of the display.
enum class Backend : std::uint8_t { kSoftware, kOpenGl };

enum class Navigation : std::uint8_t { kArcball, kWalk };

enum class SelectionKind : std::uint8_t { kNone, kElement, kLink, kTube, kTriangle, kDiscontinuity };

struct Selection {
  SelectionKind kind = SelectionKind::kNone;
  // The selected object: an ElementId, or an index in LinkSet::links, in IrradianceMesh::triangles or in the
  // list of discontinuities.
  std::int64_t index = -1;

  bool operator==(const Selection&) const = default;
  explicit operator bool() const { return kind != SelectionKind::kNone; }
};

// A point on the front of a patch that the user probes.
struct ProbedPoint {
  PatchId patch = kNoPatch;
  Vec3 position = Vec3::Zero();

  bool operator==(const ProbedPoint& other) const {
    return patch == other.patch && position == other.position;
  }
};

// The settings of the overlays, which are drawn over the faces (thesis B.4).
struct OverlaySettings {
  std::set<std::string, std::less<>> shown;  // names of the overlay switches that are on
  int mesh_depth = 20;                       // deepest quadtree level of elements that is drawn
  double link_min_irradiance = 0;            // smallest irradiance of a link that is shown [W/m^2]
  int link_limit = 5000;       // largest number of links that are shown; stronger links come first
  double graph_scale = 0.001;  // height of graphs and probes [m per W/m^2]
  int grid_density = 12;       // number of grid cells per side of a graph over a whole element
  // If true, graphs have fewer grid cells on triangles that fill a small part of their element.
  bool dynamic_grid = true;
  bool hidden_lines = false;  // if true, overlay lines behind faces are also drawn

  bool Shows(std::string_view name) const { return shown.contains(name); }
  bool operator==(const OverlaySettings&) const = default;
};

struct ViewState {
  Camera camera;
  Navigation navigation = Navigation::kArcball;
  double walk_speed = 2;  // speed of the camera in walk mode [m/s]
  bool mouse_look = false;
  glm::dvec3 up_axis{0, 0, 1};  // the vertical direction in walk mode

  DrawMode mode = DrawMode::kFlat;
  Backend backend = Backend::kSoftware;
  // how the OpenGL passes compute barycentric coordinates
  OpenGlCoordinates coordinates = OpenGlCoordinates::kFloat;
  bool faces = true;
  bool trees_by_reflectance = false;  // if true, faces show their reflectance as a flat colour (thesis B.4.1)
  bool split = false;  // show triangle ids, barycentric coordinates and picture side by side (thesis B.3.2)
  bool auto_exposure = true;
  double exposure = 0.01;  // linear screen value per W/m^2 of radiosity (Irradiance-2-Pixel in the thesis)
  bool false_colour = false;
  // upper end of the false-colour scale [W/m^2]; 0: the value that the exposure makes white
  double false_colour_max = 0;
  bool error_map = false;
  double error_map_max = 0.1;  // upper end of the colour scale for relative errors [1]
  int supersampling = 2;       // number of samples along a side of a pixel, in saved pictures
  bool isolate = true;         // if true, only the selected object is drawn

  OverlaySettings overlays;
  Selection selection;
  std::optional<ProbedPoint> probe;  // point at which the irradiance is probed
  // The point from which backprojections (visible parts of sources) are shown.
  std::optional<ProbedPoint> backprojection;
};

}  // namespace penumbra::viewer
