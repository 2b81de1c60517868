// The solver against irradiance that a path tracer found (experiments/reference), which shares nothing with
// it but the scene.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <string>
#include <vector>

#include "mesh/pipeline/pipeline.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/transport/sources/source_set.h"
#include "test_paths.h"

namespace penumbra {
namespace {

struct Reference {
  ReceiverPoint at;
  Rgb total, error, direct;  // irradiance, its standard error, its direct part [W/m^2]
};

// Every `step`-th reference of the scene, from `first` on.
std::vector<Reference> References(const std::string& scene, std::size_t first, std::size_t step) {
  std::ifstream file(std::filesystem::path(PENUMBRA_SOURCE_DIR) / "experiments" / "reference" /
                     (scene + ".csv"));
  EXPECT_TRUE(file) << scene;
  std::vector<Reference> references;
  std::string line;
  std::getline(file, line);
  for (std::size_t row = 0; std::getline(file, line); ++row) {
    if (row < first || (row - first) % step != 0) continue;
    std::array<double, 15> v{};
    std::stringstream fields(line);
    std::string field;
    for (double& value : v) {
      std::getline(fields, field, ',');
      value = std::stod(field);
    }
    Reference reference;
    reference.at.position = {v[0], v[1], v[2]};
    reference.at.normal = {v[3], v[4], v[5]};
    reference.total = {v[6], v[7], v[8]};
    reference.error = {v[9], v[10], v[11]};
    reference.direct = {v[12], v[13], v[14]};
    references.push_back(reference);
  }
  return references;
}

// Direct light needs no solution and is exact: it differs from the tracer's by the latter's error alone. That
// of the direct part is at most that of the whole; six of it are never reached by chance.
TEST(Reference, DirectLightAgrees) {
  constexpr double kSigmas = 6;
  for (const std::string name : {"floating-cube", "building-1x1", "cornell", "office"}) {
    const Scene scene = *LoadBuiltinScene(name, {});
    const PatchVisibility unused;
    const PointIrradiance irradiance(scene, unused, SourceSet::Emitters(scene), {});
    double worst = 0;
    for (const Reference& reference : References(name, 0, 2)) {
      const Rgb off = (irradiance.Anywhere(reference.at).irradiance - reference.direct).abs();
      for (int c = 0; c < 3; ++c) {
        const double allowed =
            kSigmas * reference.error[c] + 1e-8 * reference.total[c];  // nine digits written
        EXPECT_LE(off[c], allowed) << name << " at " << reference.at.position.transpose();
        if (reference.error[c] > 0) worst = std::max(worst, off[c] / reference.error[c]);
      }
    }
    std::printf("%s: worst %.2f standard errors\n", name.c_str(), worst);
  }
}

// The whole light by the exact probe: the error asked for holds at 99 of 100 points and channels.
void ExpectWithin(const std::string& name, std::initializer_list<double> errors) {
  const Scene scene = *LoadBuiltinScene(name, {});
  const std::vector<Reference> references = References(name, 0, 1);
  Rgb mean = Rgb::Zero();
  for (const Reference& reference : references)
    mean += reference.total / static_cast<double>(references.size());
  for (const double asked : errors) {
    PipelineOptions options;
    options.error = asked;
    Pipeline pipeline(scene, options);
    pipeline.Solve({});
    pipeline.RefineLight({});
    pipeline.BuildMesh(MeshKind::kInterpolant, {});
    std::vector<double> off;
    Rgb sum = Rgb::Zero(), true_sum = Rgb::Zero();
    for (const Reference& reference : references) {
      const Rgb exact = pipeline.irradiance().Anywhere(reference.at).irradiance;
      sum += exact;
      true_sum += reference.total;
      const Rgb noise = 3 * reference.error;
      for (int c = 0; c < 3; ++c)
        off.push_back(std::max(0.0, std::abs(exact[c] - reference.total[c]) - noise[c]) /
                      std::max(reference.total[c], 0.01 * mean[c]));
    }
    std::sort(off.begin(), off.end());
    const double p99 = off[off.size() * 99 / 100];
    std::printf("%s, asked %.2f: 99th percentile %.4f, mean ratio %.5f\n", name.c_str(), asked, p99,
                (sum / true_sum).mean());
    EXPECT_LE(p99, asked);
    // A thousand points' errors of either sign cancel in the mean.
    EXPECT_LE((sum / true_sum - 1).abs().maxCoeff(), asked / 10);
  }
}

TEST(Reference, ExactProbeIsWithinTheErrorAskedFor) { ExpectWithin("floating-cube", {0.05, 0.02, 0.01}); }

// Between the tall block and the walls light goes to and fro in a narrow gap: sources that were one bounce
// behind left 6 % there.
TEST(Reference, SourcesInNarrowGapsSettle) { ExpectWithin("cornell", {0.05}); }

}  // namespace
}  // namespace penumbra
