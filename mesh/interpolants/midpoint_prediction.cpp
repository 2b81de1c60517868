#include "mesh/interpolants/midpoint_prediction.h"

namespace penumbra {
MidpointPrediction::MidpointPrediction(const IrradianceMesh& mesh, const CornerSheets& sheets,
                                       std::span<const std::array<Rgb, 3>> corner)
    : mesh_(mesh), sheets_(sheets), corner_(corner) {
  gradient_.assign(sheets.size(), Eigen::Matrix3d::Zero());
  std::vector<double> weight(sheets.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& vertex = mesh.triangles[t].vertex;
    const Vec3 a = mesh.positions[vertex[1]] - mesh.positions[vertex[0]],
               b = mesh.positions[vertex[2]] - mesh.positions[vertex[0]], n = a.cross(b);
    const double area = n.norm();
    if (area == 0) continue;
    const Rgb da = corner[t][1] - corner[t][0], db = corner[t][2] - corner[t][0];
    const Eigen::Matrix3d weighted =
        (da.matrix() * b.cross(n).transpose() + db.matrix() * n.cross(a).transpose()) / area;
    for (std::size_t k = 0; k < 3; ++k) {
      gradient_[sheets.Of(CornerSheets::Corner(t, k))] += weighted;
      weight[sheets.Of(CornerSheets::Corner(t, k))] += area;
    }
  }
  for (std::size_t i = 0; i < gradient_.size(); ++i)
    if (weight[i] > 0) gradient_[i] /= weight[i];
}

MidpointPrediction::Midpoint MidpointPrediction::At(std::size_t t, std::size_t k) const {
  const std::size_t next = (k + 1) % 3;
  const auto& vertex = mesh_.triangles[t].vertex;
  const Vec3 along = mesh_.positions[vertex[next]] - mesh_.positions[vertex[k]];
  const Eigen::Matrix3d &from = gradient_[sheets_.Of(CornerSheets::Corner(t, k))],
                        &to = gradient_[sheets_.Of(CornerSheets::Corner(t, next))];
  Midpoint middle;
  middle.bend = ((from - to) * along).array() / 8;
  middle.value = 0.5 * (corner_[t][k] + corner_[t][next]) + middle.bend;
  return middle;
}

}  // namespace penumbra
