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
#include "display/reconstruction.h"
#include "mesh/discontinuities/discontinuity.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene.h"

namespace penumbra::viewer {

// The modes in which faces are drawn, with the same meaning as in the command `penumbra render`.
enum class DrawMode : std::uint8_t {
  kFlat,
  kGouraud,
  kGouraudMesh,
  kInterpolant,
  kExact,
  kLerp,
  kRho,
  kNodal,
  kGouraudScreen,
  kBilinear,
  kBicubic
};

// The reconstruction from the vertices of leaves that a drawing mode shows; nullopt for all other modes.
std::optional<Reconstruction> ReconstructionOf(DrawMode mode);

// True for drawing modes that cast rays. Until all rays of the picture have been cast, the two-pass display
// draws the picture.
inline bool CastsRays(DrawMode mode) {
  return mode == DrawMode::kExact || mode == DrawMode::kLerp || ReconstructionOf(mode);
}

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
  std::array<Vec3, 2> ends = {Vec3::Zero(), Vec3::Zero()};  // the two end points of the line [m]

  bool operator==(const PlotLine& other) const {
    return patch == other.patch && ends[0] == other.ends[0] && ends[1] == other.ends[1];
  }
};

// The settings of the overlays, which are drawn over the faces (thesis B.4).
struct OverlaySettings {
  std::set<std::string, std::less<>> shown;  // the names of the overlay switches that are on
  int mesh_depth = 20;                       // the deepest quadtree level of elements that is drawn
  // Links that carry less irradiance than this are not drawn [W/m^2].
  double link_min_irradiance = 0;
  // The largest number of links that are drawn, the strongest first.
  int link_limit = 5000;
  // Of the discontinuities, those of this kind that weigh at least so much; no kind: all.
  std::optional<DiscontinuityKind> discontinuity_kind = {};
  double discontinuity_min_weight = 0;   // discontinuities with less weight are not drawn [W/m^2]
  bool discontinuities_by_kind = false;  // if true, each kind of discontinuity is drawn in its own colour
  // The height of irradiance graphs and probes over the surface [m per W/m^2].
  double graph_scale = 0.001;
  // The number of grid cells along each side of an irradiance graph over a whole element.
  int grid_density = 12;
  // If true, graphs over triangles much smaller than their element get fewer grid cells.
  bool dynamic_grid = true;
  bool hidden_lines = false;  // if true, lines behind faces are drawn as well

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
  // The largest value of the false-colour scale, in `unit`; 0: found from the picture (RangeOf).
  double false_colour_max = 0;
  bool false_colour_log = false;
  // The unit of light in false colours, plots, and the line about the point under the pointer.
  LightUnit unit = LightUnit::kWatts;
  bool error_map = false;
  double error_map_max = 0.1;  // the largest relative error of the error map's colour scale
  int supersampling = 2;       // saved pictures have supersampling^2 samples for each pixel
  bool isolate = false;        // if true, only the selected object is drawn
  // The indices of objects that are not drawn, though light rays meet them.
  std::set<std::int32_t> hidden = {};

  OverlaySettings overlays;
  Selection selection;
  std::optional<ProbedPoint> probe;  // the point whose irradiance is probed, if any
  // The point from which the visible parts of light sources are shown, if any.
  std::optional<ProbedPoint> backprojection;
  std::optional<PlotLine> line;  // the line over which the light is plotted, if any

  bool operator==(const ShownState&) const = default;
};

struct ViewState : ShownState {
  Camera camera;
  Navigation navigation = Navigation::kArcball;
  double walk_speed = 2;  // the speed of walking through the scene [m/s]
  bool mouse_look = false;
  glm::dvec3 up_axis{0, 0, 1};  // the vertical direction in walk mode
};

}  // namespace penumbra::viewer
