// The page for browsers: complete, and with the light of the mesh. What a browser makes of it is asked in
// tests/foreign.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "display/mesh_nodes.h"
#include "display/mesh_writers.h"
#include "display/walkthrough/page_data.h"
#include "tests/display/synthetic_room.h"

namespace penumbra {
namespace {

using testing::HasSubstr;
using testing::Not;

template <class T>
T ValueAt(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

// Every sample is the interpolant's value there, to the error that the header states, also where a triangle
// is dark; positions are floats about the centre; the edges keep their marks.
TEST(Walkthrough, HoldsTheInterpolants) {
  SyntheticScene room = MakeRoom(3);
  const std::size_t n = room.mesh.triangles.size(), vertices = room.mesh.positions.size();
  room.mesh.irradiance[0] = QuadraticInterpolant::Constant(Rgb::Zero());
  room.mesh.irradiance[1] = QuadraticInterpolant::Constant(Rgb(1e-30, -2e-30, 0));
  room.mesh.triangles[2].discontinuity = {true, false, true};
  const std::string arrays = MakePageData({room.scene, room.mesh, RoomCamera()}).arrays;
  const std::size_t scales = 12 * vertices + 12 * n, samples = scales + 4 * n, edges = samples + 36 * n;
  ASSERT_EQ(arrays.size(), edges + n);
  constexpr std::array<std::size_t, 6> kSample = {0, 2, 4, 1, 3, 5};  // corners first
  // Samples that nearly agree share a node.
  double brightest = 0, worst = 0;
  for (const QuadraticInterpolant& q : room.mesh.irradiance)
    for (const auto& [s, t] : kSampleAt) brightest = std::max(brightest, q.At(s, t).abs().maxCoeff());
  for (std::size_t i = 0; i < n; ++i) {
    double largest = 0, error = 0;
    for (std::size_t k = 0; k < 6; ++k) {
      const Rgb value = room.mesh.irradiance[i].At(kSampleAt[kSample[k]][0], kSampleAt[kSample[k]][1]);
      for (std::size_t c = 0; c < 3; ++c) {
        const double read = static_cast<double>(ValueAt<float>(arrays, scales + 4 * i)) *
                            ValueAt<std::int16_t>(arrays, samples + 36 * i + 6 * k + 2 * c);
        error = std::max(error, std::abs(read - value[static_cast<Eigen::Index>(c)]));
      }
      largest = std::max(largest, value.abs().maxCoeff());
    }
    EXPECT_LE(error, kSampleError * largest + kEqualIrradiance * brightest) << "triangle " << i;
    if (largest > 1) worst = std::max(worst, error / largest);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(ValueAt<std::uint32_t>(arrays, 12 * vertices + 12 * i + 4 * k),
                room.mesh.triangles[i].vertex[k]);
    EXPECT_EQ(arrays[edges + i], i == 2 ? 5 : 0);
  }
  std::cout << "largest error " << worst << " of the triangle's light, allowed " << kSampleError << '\n';
  const Vec3 centre = 0.5 * (room.scene.Bounds().first + room.scene.Bounds().second);
  for (std::size_t i = 0; i < vertices; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(
          static_cast<double>(ValueAt<float>(arrays, 12 * i + 4 * k)) + centre[static_cast<Eigen::Index>(k)],
          room.mesh.positions[i][static_cast<Eigen::Index>(k)], 1e-6);
}

// The page loads nothing, whatever names say, and begins at the camera and exposure that were asked for.
TEST(Walkthrough, IsComplete) {
  SyntheticScene room = MakeRoom(1);
  room.scene.name = "</script><img src=\"http://example.org\">\xff";
  room.scene.materials[0].name = "{{data}}<b>&";
  room.scene.cameras = {{"near", {1, 1, 1}, {2, 2, 1}}, RoomCamera()};
  const auto page = [&room](const Camera& camera, std::optional<double> exposure) {
    return MeshWriters().Find("html").make()->Bytes({room.scene, room.mesh, camera, exposure});
  };
  const std::string chosen = page(RoomCamera(), 0.25);
  EXPECT_THAT(chosen, Not(HasSubstr("<script src=")));
  EXPECT_THAT(chosen, Not(HasSubstr("shader\" src=")));
  EXPECT_THAT(chosen, Not(HasSubstr("<link rel=\"stylesheet\"")));
  EXPECT_THAT(chosen, Not(HasSubstr("<img")));
  EXPECT_THAT(chosen, Not(HasSubstr("{{description}}")));
  EXPECT_THAT(chosen, HasSubstr("default-src 'none'"));
  EXPECT_THAT(chosen, HasSubstr("\"firstCamera\":1,\"exposure\":0.25,\"metered\":false"));
  EXPECT_THAT(page({"elsewhere", {1, 2, 1}, {2, 2, 1}}, std::nullopt), HasSubstr("\"firstCamera\":2,"));
  EXPECT_THAT(page(RoomCamera(), std::nullopt), HasSubstr("\"metered\":true"));
}

}  // namespace
}  // namespace penumbra
