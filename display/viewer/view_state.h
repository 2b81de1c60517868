// display/viewer/view_state.h
//
// All parameters of the window's picture except the state of the solution. The window's picture is a function
// of the Snapshot (state of the solution) and the ViewState.

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "display/opengl_passes.h"
#include "display/photometry.h"
#include "mesh/discontinuities/discontinuity.h"
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

enum class SelectionKind : std::uint8_t {
  kNone,
  kElement,
  kLink,
  kTube,
  kTriangle,
  kDiscontinuity,
  kObject,
  kMaterial
};

struct Selection {
  SelectionKind kind = SelectionKind::kNone;
  // The selected object: an ElementId, or an index in LinkSet::links, in IrradianceMesh::triangles, in the
  // list of discontinuities, in Scene::objects or in Scene::materials.
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

// A line over which light is plotted, in the plane of a patch, the first end on its front.
struct PlotLine {
  PatchId patch = kNoPatch;
  std::array<Vec3, 2> ends = {Vec3::Zero(), Vec3::Zero()};  // [m]

  bool operator==(const PlotLine& other) const {
    return patch == other.patch && ends[0] == other.ends[0] && ends[1] == other.ends[1];
  }
};

// The settings of the overlays, which are drawn over the faces (thesis B.4).
struct OverlaySettings {
  std::set<std::string, std::less<>> shown;  // names of the switches that are on
  int mesh_depth = 20;                       // deepest level of elements that is drawn
  double link_min_irradiance = 0;            // links with less irradiance are omitted [W/m^2]
  int link_limit = 5000;                     // largest number of the other links: the strongest are shown
  // Of the discontinuities, those of this kind that weigh at least so much; no kind: all.
  std::optional<DiscontinuityKind> discontinuity_kind = {};
  double discontinuity_min_weight = 0;   // [W/m^2]
  bool discontinuities_by_kind = false;  // a colour for each kind
  double graph_scale = 0.001;            // height of graphs and probes [m per W/m^2]
  int grid_density = 12;                 // cells per side of a graph over a whole element
  bool dynamic_grid = true;              // fewer cells for triangles that fill a small part of the element
  bool hidden_lines = false;             // draw lines behind faces as well

  bool Shows(std::string_view name) const { return shown.contains(name); }
  bool operator==(const OverlaySettings&) const = default;
};

// What is shown, wherever it is seen from. Undo brings it back, and leaves the camera alone.
struct ShownState {
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
  double false_colour_max = 0;  // end of the scale, in `unit`; 0: by the values that are seen (RangeOf)
  bool false_colour_log = false;
  LightUnit unit = LightUnit::kWatts;  // of false colours, of the line under the pointer and of plots
  bool error_map = false;
  double error_map_max = 0.1;          // end of the scale, relative
  int supersampling = 2;               // of saved pictures: samples per side of a pixel
  bool isolate = false;                // draw only the selection
  std::set<std::int32_t> hidden = {};  // objects that are not drawn; rays meet them all the same

  OverlaySettings overlays;
  Selection selection;
  std::optional<ProbedPoint> probe;           // of the irradiance
  std::optional<ProbedPoint> backprojection;  // of the sources' backprojections
  std::optional<PlotLine> line;               // over which light is plotted

  bool operator==(const ShownState&) const = default;
};

struct ViewState : ShownState {
  Camera camera;
  Navigation navigation = Navigation::kArcball;
  double walk_speed = 2;  // [m/s]
  bool mouse_look = false;
  glm::dvec3 up_axis{0, 0, 1};  // the vertical direction in walk mode
};

}  // namespace penumbra::viewer
