// Solution files give back what was written, to the bit, and refuse everything else in one line.

#include "mesh/pipeline/solution_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "mesh/interpolants/reference_irradiance.h"
#include "mesh/pipeline/hdf5_image.h"
#include "mesh/pipeline/solution_check.h"
#include "solver/base/check.h"
#include "solver/base/random.h"
#include "solver/base/sha256.h"
#include "solver/scene/builtin_scenes.h"

namespace penumbra {
namespace {

using testing::HasSubstr;

constexpr const char* kVersion = "1.2.3";

PipelineOptions Rough() {
  PipelineOptions options;
  options.error = 0.5;
  options.max_corrections = 1;
  options.error_points = 0;
  return options;
}

struct SolvedFile {
  Scene scene;
  std::unique_ptr<Pipeline> pipeline;
};

std::unique_ptr<SolvedFile> Solve(Scene scene) {
  auto solved = std::make_unique<SolvedFile>();
  solved->scene = std::move(scene);
  solved->pipeline = std::make_unique<Pipeline>(solved->scene, Rough());
  solved->pipeline->Solve({});
  solved->pipeline->RefineLight({});
  solved->pipeline->BuildMesh(MeshKind::kInterpolant, {});
  return solved;
}

// A furnished room: fragments, blockers, discontinuities, cameras, warnings.
const SolvedFile& Cornell() {
  static const std::unique_ptr<SolvedFile> solved = Solve(LoadBuiltinScene("cornell", {}).value());
  return *solved;
}

std::string Encode(const Pipeline& pipeline) {
  return EncodeSolution(pipeline, "{options}", "{report}", kVersion);
}

const std::string& CornellFile() {
  static const std::string bytes = Encode(*Cornell().pipeline);
  return bytes;
}

PipelineState StateOf(const Pipeline& pipeline) {
  return {pipeline.visibility(), pipeline.solution(), MeshKind::kInterpolant, pipeline.mesh(),
          pipeline.report()};
}

// What the reader says about the bytes; empty if it takes them.
std::string Refusal(std::string_view bytes) {
  try {
    DecodeSolution(bytes, "a.h5");
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

// Corrects the digest, as no accident does.
std::string WithDigest(std::string bytes) {
  const std::size_t at = bytes.find("sha256 ") + 7;
  bytes.replace(at, 64, std::string(64, '0'));
  return bytes.replace(at, 64, Sha256().Update(bytes).Finish());
}

bool SameMesh(const IrradianceMesh& a, const IrradianceMesh& b) {
  bool same = a.positions == b.positions && a.triangles.size() == b.triangles.size();
  for (std::size_t i = 0; same && i < a.triangles.size(); ++i) {
    const QuadraticInterpolant &p = a.irradiance[i], &q = b.irradiance[i];
    same = a.triangles[i].vertex == b.triangles[i].vertex && a.triangles[i].patch == b.triangles[i].patch &&
           a.triangles[i].discontinuity == b.triangles[i].discontinuity && (p.a == q.a).all() &&
           (p.b2 == q.b2).all() && (p.c2 == q.c2).all() && (p.d == q.d).all() && (p.e2 == q.e2).all() &&
           (p.f == q.f).all();
  }
  return same;
}

// Reading and writing again gives the same bytes, at another time too, and what is computed from what was
// read is what was computed from what was written.
TEST(SolutionFile, ComesBackToTheBit) {
  const std::string& bytes = CornellFile();
  ASSERT_TRUE(LooksLikeSolution(std::string_view(bytes).substr(0, 512)));
  StoredSolution stored = DecodeSolution(bytes, "a.h5");
  EXPECT_EQ(stored.options, "{options}");
  EXPECT_EQ(stored.report, "{report}");
  EXPECT_EQ(stored.version, kVersion);
  const SolvedFile& before = Cornell();
  ASSERT_EQ(stored.scene->patches.size(), before.scene.patches.size());
  for (std::size_t p = 0; p < before.scene.patches.size(); ++p) {
    EXPECT_EQ(stored.scene->patches[p].vertex, before.scene.patches[p].vertex);
    EXPECT_EQ(stored.scene->patches[p].normal, before.scene.patches[p].normal);
    EXPECT_EQ(stored.scene->patches[p].area, before.scene.patches[p].area);
    EXPECT_EQ(stored.scene->patches[p].extent, before.scene.patches[p].extent);
  }
  EXPECT_EQ(stored.scene->warnings, before.scene.warnings);
  EXPECT_EQ(stored.scene->name, before.scene.name);

  const auto second = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  std::this_thread::sleep_until(second + std::chrono::milliseconds(1001));
  const std::unique_ptr<const Scene> scene = std::move(stored.scene);
  Pipeline pipeline(*scene, Rough(), std::move(stored.state));
  EXPECT_EQ(Encode(pipeline), bytes);

  pipeline.RefineLight({});
  pipeline.BuildMesh(MeshKind::kInterpolant, {});
  EXPECT_TRUE(SameMesh(pipeline.mesh(), before.pipeline->mesh()));
  pipeline.BuildMesh(MeshKind::kGouraudMesh, {});
  Pipeline anew(before.scene, Rough());
  anew.Solve({});
  anew.RefineLight({});
  anew.BuildMesh(MeshKind::kInterpolant, {});
  anew.BuildMesh(MeshKind::kGouraudMesh, {});
  EXPECT_TRUE(SameMesh(pipeline.mesh(), anew.mesh()));
  EXPECT_FALSE(SameMesh(pipeline.mesh(), before.pipeline->mesh()));
}

// A window reads one solution while it saves another: threads do not come into each other's way.
TEST(SolutionFile, SeveralAreReadAndWrittenAtOnce) {
  const std::vector<double> values(10'000, 0.5);
  const auto write = [&] {
    Hdf5Writer file;
    for (const char* path : {"a/values", "a/b/values", "c/values"})
      file.Write(path, ScalarType::kDouble, {values.size()}, values.data());
    file.WriteText("text", "a text");
    return file.Finish();
  };
  const std::string image = write();
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&, writes = i % 2 == 0] {
      for (int k = 0; k < 200; ++k) {
        try {
          if (writes) {
            wrong += write() == image ? 0 : 1;
          } else {
            const Hdf5Reader file(image);
            std::vector<double> read(values.size());
            file.Read("a/b/values", ScalarType::kDouble, {read.size()}, read.data());
            wrong += read == values && file.ReadText("text") == "a text" ? 0 : 1;
          }
        } catch (const Hdf5Error&) {
          ++wrong;
        }
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

// A scene without faces is valid, and names may hold anything.
// The discontinuities that the mesh chose from: as many as were counted, in place, each with who made it.
TEST(SolutionFile, HoldsTheDiscontinuities) {
  const Pipeline& pipeline = *Cornell().pipeline;
  const Hdf5Reader file(std::string_view(CornellFile()).substr(kSolutionHeaderSize));
  const std::size_t count = file.Shape("discontinuities/kind").at(0);
  EXPECT_GT(count, 0U);
  ASSERT_EQ(file.Shape("discontinuities/ends"), (ArrayShape{count, 2, 3}));
  std::vector<double> ends(6 * count), weight(count);
  std::vector<std::int32_t> receiver(count), source(count), blocker(count);
  std::vector<std::uint8_t> kind(count);
  file.Read("discontinuities/ends", ScalarTypeOf<double>::value, {count, 2, 3}, ends.data());
  file.Read("discontinuities/weight", ScalarTypeOf<double>::value, {count}, weight.data());
  file.Read("discontinuities/receiver", ScalarTypeOf<std::int32_t>::value, {count}, receiver.data());
  file.Read("discontinuities/source", ScalarTypeOf<std::int32_t>::value, {count}, source.data());
  file.Read("discontinuities/blocker", ScalarTypeOf<std::int32_t>::value, {count}, blocker.data());
  file.Read("discontinuities/kind", ScalarTypeOf<std::uint8_t>::value, {count}, kind.data());
  // All that could be asked for, each beside the light of its receiver.
  const DiscontinuityOptions& mesh = pipeline.resolved().discontinuities;
  const ReferenceIrradiance light(pipeline.solution(), mesh.weight);
  for (std::size_t i = 0; i < count; ++i) {
    const Patch& patch = pipeline.scene().patches.at(static_cast<std::size_t>(receiver[i]));
    for (int end = 0; end < 2; ++end) {
      const Vec3 p(ends[6 * i + 3 * end], ends[6 * i + 3 * end + 1], ends[6 * i + 3 * end + 2]);
      EXPECT_NEAR(patch.normal.dot(p - patch.vertex[0]), 0, 1e-14);
    }
    EXPECT_GE(weight[i] * light.LargestScale(receiver[i]), mesh.LeastWeight());
    EXPECT_EQ(source[i] == kNoPatch, kind[i] == static_cast<std::uint8_t>(DiscontinuityKind::kContact));
    const auto of_kind = static_cast<DiscontinuityKind>(kind[i]);
    EXPECT_EQ(blocker[i] == kNoPatch,
              of_kind == DiscontinuityKind::kHorizon || of_kind == DiscontinuityKind::kNear);
  }
}

TEST(SolutionFile, HoldsAnEmptySceneAndAnyName) {
  Scene scene;
  scene.name = "a\"\\\xff\n b";
  scene.objects = {{"", {}}, {std::string("zero \0 inside\0", 14), {}}, {std::string(3000, 'x'), {}}};
  const std::unique_ptr<SolvedFile> solved = Solve(scene);
  const StoredSolution stored = DecodeSolution(Encode(*solved->pipeline), "a.h5");
  EXPECT_EQ(stored.scene->name, scene.name);
  ASSERT_EQ(stored.scene->objects.size(), scene.objects.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    EXPECT_EQ(stored.scene->objects[i].name, scene.objects[i].name);
  EXPECT_TRUE(stored.state.mesh.triangles.empty());
}

// 1,000 random damages, of one bit, of many bytes, by cutting off and by adding: all refused, in one line.
TEST(SolutionFile, RefusesEveryDamage) {
  const std::unique_ptr<SolvedFile> furnace = Solve(LoadBuiltinScene("furnace", {}).value());
  const std::string whole = Encode(*furnace->pipeline);
  ASSERT_EQ(Refusal(whole), "");
  constexpr std::uint64_t kSeed = 7;
  Random random(kSeed);
  for (int i = 0; i < 1000; ++i) {
    std::string bytes = whole;
    // Half of them within the header.
    const std::size_t at = random.Index(i % 2 == 0 ? 512 : static_cast<std::uint32_t>(bytes.size()));
    switch (i % 4) {
      case 0:
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.Index(8)));
        break;
      case 2:
        bytes.resize(at);
        break;
      default:
        if (random.Index(2) == 0)
          bytes.insert(at, 1 + random.Index(100), 'x');
        else
          for (std::size_t k = at; k < std::min(bytes.size(), at + 64); ++k)
            bytes[k] = static_cast<char>(bytes[k] + 1 + static_cast<char>(random.Index(255)));
    }
    const std::string refusal = Refusal(bytes);
    ASSERT_THAT(refusal, testing::StartsWith("a.h5: error: ")) << "seed " << kSeed << ", damage " << i;
    ASSERT_EQ(refusal.find('\n'), refusal.npos);
  }
}

// Files of others and of other versions are told apart.
TEST(SolutionFile, SaysWhatElseItIs) {
  const std::string& whole = CornellFile();
  EXPECT_THAT(Refusal(whole.substr(512)), HasSubstr("it is an HDF5 file, but no solution"));
  EXPECT_THAT(Refusal(""), HasSubstr("neither a scene nor a solution"));
  EXPECT_THAT(Refusal(std::string(5000, '\0')), HasSubstr("neither a scene nor a solution"));
  EXPECT_THAT(Refusal("\x89PNG\r\n\x1a\n rest"), HasSubstr("neither a scene nor a solution"));
  EXPECT_THAT(Refusal(whole.substr(0, whole.size() - 1)), HasSubstr("damaged or cut off"));
  for (const auto& [schema, words] :
       {std::pair("schema 0", "an older version of penumbra, 1.2.3"), {"schema 9", "a newer version"}}) {
    std::string other = whole;
    other.replace(other.find("schema "), 8, schema);
    EXPECT_THAT(Refusal(other), HasSubstr("damaged"));
    EXPECT_THAT(Refusal(WithDigest(other)), HasSubstr(words));
  }
  // A file of the schema before is read; it keeps no light by emitter.
  std::string older = whole;
  older.replace(older.find("schema "), 8, "schema 4");
  EXPECT_EQ(Refusal(WithDigest(older)), "");
  // Text is left to the reader of scenes.
  EXPECT_FALSE(LooksLikeSolution("v 0 0 0\nv 1 0 0\n"));
  EXPECT_TRUE(LooksLikeSolution(std::string_view(whole).substr(0, 5)));
}

// The light of each emitter comes back to the bit, and what is no light of the solution is refused.
TEST(SolutionFile, KeepsTheLightOfEachEmitter) {
  const Scene scene = *LoadBuiltinScene("floating-cube", {});
  PipelineOptions options;
  options.error = 0.5;
  options.by_emitter = true;
  Pipeline pipeline(scene, options);
  pipeline.Solve({});
  pipeline.RefineLight({});
  pipeline.BuildMesh(MeshKind::kInterpolant, {});
  const std::span<const EmitterLight> kept = pipeline.emitters();
  ASSERT_EQ(kept.size(), 2U);
  const StoredSolution stored = DecodeSolution(Encode(pipeline), "a.h5");
  const std::vector<EmitterLight>& read = stored.state.emitters;
  ASSERT_EQ(read.size(), kept.size());
  for (std::size_t k = 0; k < kept.size(); ++k) {
    EXPECT_EQ(read[k].patches, kept[k].patches);
    const auto same = [](const Rgb& a, const Rgb& b) { return (a == b).all(); };
    EXPECT_TRUE(std::equal(read[k].element.begin(), read[k].element.end(), kept[k].element.begin(),
                           kept[k].element.end(), same));
    EXPECT_TRUE(std::equal(read[k].fragment.begin(), read[k].fragment.end(), kept[k].fragment.begin(),
                           kept[k].fragment.end(), same));
    ASSERT_EQ(read[k].interpolant.size(), kept[k].interpolant.size());
    for (std::size_t t = 0; t < read[k].interpolant.size(); ++t)
      ASSERT_TRUE((read[k].interpolant[t].d == kept[k].interpolant[t].d).all());
  }
  const auto bad = [&](const auto& spoil) {
    std::vector<EmitterLight> spoilt = read;
    EXPECT_NO_THROW(CheckEmitters(stored.state.solution, stored.state.mesh, spoilt));
    spoil(spoilt);
    EXPECT_THROW(CheckEmitters(stored.state.solution, stored.state.mesh, spoilt), Hdf5Error);
  };
  bad([](std::vector<EmitterLight>& e) { e[0].patches[0] = 1000; });
  bad([](std::vector<EmitterLight>& e) { e[0].patches = e[1].patches; });
  bad([](std::vector<EmitterLight>& e) { e[0].element.pop_back(); });
  bad([](std::vector<EmitterLight>& e) { e[1].interpolant.pop_back(); });
  bad([](std::vector<EmitterLight>& e) { e[1].element[3][1] = std::numeric_limits<double>::quiet_NaN(); });
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// With a digest that holds, too, nothing is taken that does not make sense: of a scene and what sees what in
// it,
TEST(SolutionFile, ChecksTheSceneItReads) {
  const SolvedFile& solved = Cornell();
  const Scene& scene = solved.scene;
  const auto bad_scene = [&](const auto& spoil) {
    Scene spoilt = scene;
    EXPECT_NO_THROW(CheckScene(spoilt));
    spoil(spoilt);
    EXPECT_THROW(CheckScene(spoilt), Hdf5Error);
  };
  bad_scene([](Scene& s) { s.materials[0].reflectance[1] = 1; });
  bad_scene([](Scene& s) { s.materials[0].emittance[2] = -1; });
  bad_scene([](Scene& s) { s.materials.clear(); });
  bad_scene([](Scene& s) { s.faces[3].vertices[1].x() = kNan; });
  bad_scene([](Scene& s) { s.faces[3].vertices.resize(2); });
  bad_scene([](Scene& s) { s.faces[3].object = -1; });
  bad_scene([](Scene& s) { s.objects[0].faces[0] = 1000; });
  bad_scene([](Scene& s) { s.patches[2].size = 5; });
  bad_scene([](Scene& s) { s.patches[2].vertex.fill(Vec3::Zero()); });
  bad_scene([](Scene& s) { s.patches[2].material = 1000; });
  bad_scene([](Scene& s) { s.patches[2].faces.clear(); });
  bad_scene([](Scene& s) { s.cameras[0].eye.y() = kNan; });

  const auto bad_visibility = [&](const auto& spoil) {
    PatchVisibility::Rows spoilt = solved.pipeline->visibility().rows();
    EXPECT_NO_THROW(CheckVisibility(scene, spoilt));
    spoil(spoilt);
    EXPECT_THROW(CheckVisibility(scene, spoilt), Hdf5Error);
  };
  bad_visibility([](auto& rows) { rows.first.pop_back(); });
  bad_visibility([](auto& rows) { std::swap(rows.first[0], rows.first[1]); });
  bad_visibility([](auto& rows) { rows.pairs[0].source = -1; });
  bad_visibility([](auto& rows) { rows.pairs[0].first_blocker = std::numeric_limits<std::uint32_t>::max(); });
  bad_visibility([](auto& rows) { rows.blockers[0] = 1000; });
}

// of a solution,
TEST(SolutionFile, ChecksTheSolutionItReads) {
  const SolvedFile& solved = Cornell();
  const Scene& scene = solved.scene;
  const RadiositySolution& solution = solved.pipeline->solution();
  const auto bad_forest = [&](const auto& spoil) {
    std::vector<Element> spoilt(solution.forest.elements().begin(), solution.forest.elements().end());
    EXPECT_NO_THROW(RestoreForest(scene, spoilt));
    spoil(spoilt);
    EXPECT_THROW(RestoreForest(scene, spoilt), Hdf5Error);
  };
  const std::size_t count = scene.patches.size();
  bad_forest([](auto& elements) { elements.pop_back(); });
  bad_forest([](auto& elements) { elements.clear(); });
  bad_forest([&](auto& elements) { elements[count].parent += 1; });
  bad_forest([&](auto& elements) { elements[count].corner[0].x += 1; });
  bad_forest([&](auto& elements) { elements.back().first_child = 0; });
  bad_forest([&](auto& elements) {  // a child above its parent: a circle
    for (Element& e : elements)
      if (!e.IsLeaf()) e.first_child = static_cast<ElementId>(count);
  });

  const auto bad_light = [&](const auto& spoil) {
    RadiositySolution spoilt = solution;
    EXPECT_NO_THROW(CheckLight(spoilt));
    spoil(spoilt);
    EXPECT_THROW(CheckLight(spoilt), Hdf5Error);
  };
  bad_light([](RadiositySolution& s) { s.irradiance.pop_back(); });
  bad_light([](RadiositySolution& s) { s.radiosity[1][1] = kNan; });
  bad_light([](RadiositySolution& s) { s.links.links[0].receiver = 100000; });
  bad_light([](RadiositySolution& s) { s.links.links[0].form_factor = INFINITY; });
  bad_light([](RadiositySolution& s) { s.links.links[0].blocker_count = 100000; });
  bad_light([](RadiositySolution& s) { s.links.blockers[0] = -2; });
  bad_light([](RadiositySolution& s) { s.fragments[0].leaf = -1; });
  bad_light([](RadiositySolution& s) { s.fragments[0].polygon.clear(); });
}

// and of a mesh.
TEST(SolutionFile, ChecksTheMeshItReads) {
  const SolvedFile& solved = Cornell();
  const Scene& scene = solved.scene;
  const auto bad_mesh = [&](const auto& spoil) {
    IrradianceMesh spoilt = solved.pipeline->mesh();
    EXPECT_NO_THROW(CheckMesh(scene, spoilt));
    spoil(spoilt);
    EXPECT_THROW(CheckMesh(scene, spoilt), Hdf5Error);
  };
  bad_mesh([](IrradianceMesh& m) { m.triangles[0].vertex[1] = 1 << 30; });
  bad_mesh([](IrradianceMesh& m) { m.triangles[0].patch = -1; });
  bad_mesh([](IrradianceMesh& m) { m.irradiance.pop_back(); });
  bad_mesh([](IrradianceMesh& m) { m.irradiance[0].d[0] = kNan; });
  bad_mesh([](IrradianceMesh& m) { m.positions[0].z() = INFINITY; });
  // Finite, but products of them are not.
  bad_mesh([](IrradianceMesh& m) { m.positions[0].x() = 1.4e308; });
  bad_mesh([](IrradianceMesh& m) { m.irradiance[0].a[0] = m.irradiance[0].c2[0] = 1e308; });
}

// Light that is no number is not kept: no file is written that cannot be read.
TEST(SolutionFile, KeepsNumbersOnly) {
  const SolvedFile& cornell = Cornell();
  const auto refused = [&](const auto& spoil) {
    PipelineState state = StateOf(*cornell.pipeline);
    spoil(state);
    const Pipeline spoilt(cornell.scene, Rough(), std::move(state));
    EXPECT_THROW(Encode(spoilt), InputError);
  };
  refused([](PipelineState& state) { state.mesh.irradiance[3].d[1] = NAN; });
  refused([](PipelineState& state) { state.mesh.positions[2].x() = INFINITY; });
  refused([](PipelineState& state) { state.solution.radiosity[5][0] = NAN; });
  refused([](PipelineState& state) { state.solution.irradiance[1][2] = -INFINITY; });
  Encode(Pipeline(cornell.scene, Rough(), StateOf(*cornell.pipeline)));
}

}  // namespace
}  // namespace penumbra
