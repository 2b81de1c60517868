// display/viewer/view_state.h
//
// Everything that decides what the window shows of a snapshot. The picture is a function of the two.

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

// How faces are drawn: modes of `penumbra render`.
enum class DrawMode : std::uint8_t { kFlat, kGouraud, kGouraudMesh, kInterpolant, kExact, kLerp, kRho };

// Modes that cast rays: what the passes show stands in until they are there.
inline bool CastsRays(DrawMode mode) { return mode == DrawMode::kExact || mode == DrawMode::kLerp; }

// The mesh that a mode draws.
MeshKind MeshOf(DrawMode mode);

// Who draws the two passes.
enum class Backend : std::uint8_t { kSoftware, kOpenGl };

enum class Navigation : std::uint8_t { kArcball, kWalk };

enum class SelectionKind : std::uint8_t { kNone, kElement, kLink, kTube, kTriangle, kDiscontinuity };

struct Selection {
  SelectionKind kind = SelectionKind::kNone;
  // An ElementId, or an index in LinkSet::links, IrradianceMesh::triangles, or the list of discontinuities.
  std::int64_t index = -1;

  bool operator==(const Selection&) const = default;
  explicit operator bool() const { return kind != SelectionKind::kNone; }
};

// A point on the front of a patch that the user asks about.
struct ProbedPoint {
  PatchId patch = kNoPatch;
  Vec3 position = Vec3::Zero();

  bool operator==(const ProbedPoint& other) const {
    return patch == other.patch && position == other.position;
  }
};

// What is drawn over the faces (thesis B.4).
struct OverlaySettings {
  std::set<std::string, std::less<>> shown;  // the switches of overlays that are on, by name
  int mesh_depth = 20;                       // deepest level of elements drawn
  double link_min_irradiance = 0;            // links that bring less are left out [W/m^2]
  int link_limit = 5000;                     // of the others, the strongest this many
  double graph_scale = 0.001;                // height of graphs and probes [m per W/m^2]
  int grid_density = 12;                     // cells along the side of a graph over a whole element
  bool dynamic_grid = true;                  // cells by the share of the element that a triangle fills
  bool hidden_lines = false;                 // draw what stands behind faces, too

  bool Shows(std::string_view name) const { return shown.contains(name); }
  bool operator==(const OverlaySettings&) const = default;
};

struct ViewState {
  Camera camera;
  Navigation navigation = Navigation::kArcball;
  double walk_speed = 2;  // [m/s]
  bool mouse_look = false;
  glm::dvec3 up_axis{0, 0, 1};  // of walking

  DrawMode mode = DrawMode::kFlat;
  Backend backend = Backend::kSoftware;
  OpenGlCoordinates coordinates = OpenGlCoordinates::kFloat;  // of the passes by OpenGL
  bool faces = true;
  bool trees_by_reflectance = false;  // flat faces by rho (thesis B.4.1)
  bool split = false;                 // ids, coordinates and picture side by side (thesis B.3.2)
  bool auto_exposure = true;
  double exposure = 0.01;  // screen value per W/m^2: the thesis's Irradiance-2-Pixel
  bool false_colour = false;
  double false_colour_max = 0;  // top of the scale [W/m^2]; 0: the value that the exposure makes white
  bool error_map = false;
  double error_map_max = 0.1;  // top of the scale, relative
  int supersampling = 2;       // of pictures that are saved: samples a side of a pixel
  bool isolate = true;         // only what is selected is drawn

  OverlaySettings overlays;
  Selection selection;
  std::optional<ProbedPoint> probe;           // of irradiance
  std::optional<ProbedPoint> backprojection;  // what its sources look like from it
};

}  // namespace penumbra::viewer
