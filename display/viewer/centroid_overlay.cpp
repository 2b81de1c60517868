#include "display/viewer/centroid_overlay.h"

#include "display/viewer/mesh_tools.h"

namespace penumbra::viewer {
namespace {

constexpr const char* kSwitch = "centroids";
constexpr double kArm = 0.1;  // of the way from the centroid to a corner

class CentroidOverlay final : public Overlay {
 public:
  std::vector<OverlaySwitch> Switches() const override {
    return {{kSwitch, "Centroids", "Centroids", "", {.triangles = true}}};
  }
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    if (!context.settings.Shows(kSwitch)) return;
    const IrradianceMesh& mesh = context.mesh.mesh();
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const Vec3 centre = PointInTriangle(mesh, i, 1.0 / 3, 1.0 / 3);
      for (const std::uint32_t v : mesh.triangles[i].vertex) {
        const Vec3 arm = kArm * (mesh.positions[v] - centre);
        drawing->Line(centre, centre + arm, colour::kWhite);
      }
    }
  }
};

}  // namespace

OverlayRegistry::Method CentroidOverlayMethod() {
  return {"centroids", "the centroids of triangles", {}, [] {
            return std::make_unique<const CentroidOverlay>();
          }};
}

}  // namespace penumbra::viewer
