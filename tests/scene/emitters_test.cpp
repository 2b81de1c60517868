#include "solver/scene/emitters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "solver/base/check.h"
#include "solver/scene/builtin_scenes.h"

namespace penumbra {
namespace {

using testing::HasSubstr;

// Two lamps of one material in different objects, and one of two triangles that form a rectangle.
Scene ThreeLamps() {
  Scene scene;
  scene.name = "lamps";
  scene.materials = {{"glow", Rgb::Constant(0.2), Rgb(1, 2, 3)},
                     {"grey", Rgb::Constant(0.5), Rgb::Zero()},
                     {"red", Rgb::Constant(0.5), Rgb(4, 0, 0)}};
  scene.objects = {{"left lamp", {0}}, {"right lamp", {1}}, {"floor", {2}}, {"sign", {3, 4}}};
  const auto add = [&](double x, std::int32_t material, std::int32_t object,
                       std::vector<std::int32_t> faces) {
    const Polygon3 square = {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}};
    for (std::size_t i = 0; i < faces.size(); ++i) scene.faces.push_back({square, material, object});
    scene.patches.push_back(MakePatch(square, material, object, std::move(faces)));
  };
  add(0, 0, 0, {0});
  add(2, 0, 1, {1});
  add(4, 1, 2, {2});
  add(6, 2, 3, {3, 4});
  return scene;
}

Rgb Flux(const Scene& scene) {
  Rgb flux = Rgb::Zero();
  for (const Patch& patch : scene.patches)
    flux += patch.area * scene.materials[static_cast<std::size_t>(patch.material)].emittance;
  return flux;
}

std::string ErrorOf(const Scene& scene, const std::vector<Dimming>& dims) {
  try {
    DimmingFactors(scene, dims);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Emitters divide the flux of a scene: each patch that emits belongs to one of them.
TEST(Emitters, DivideTheFlux) {
  for (const Scene& scene : {ThreeLamps(), *LoadBuiltinScene("office", {}), *LoadBuiltinScene("furnace", {})})
    for (const EmitterUnit unit : {EmitterUnit::kFace, EmitterUnit::kObject, EmitterUnit::kMaterial}) {
      Rgb sum = Rgb::Zero();
      for (const std::vector<PatchId>& emitter : EmittersOf(scene, unit))
        sum += Flux(LitOnlyBy(scene, emitter));
      EXPECT_LE(((sum - Flux(scene)).abs() / Flux(scene).max(1e-300)).maxCoeff(), 1e-15) << scene.name;
    }
  using Groups = std::vector<std::vector<PatchId>>;
  EXPECT_EQ(EmittersOf(ThreeLamps(), EmitterUnit::kFace), (Groups{{0}, {1}, {3}}));
  EXPECT_EQ(EmittersOf(ThreeLamps(), EmitterUnit::kMaterial), (Groups{{0, 1}, {3}}));
}

// Names of objects and materials and numbers of faces dim what they name and nothing else; factors multiply.
TEST(Emitters, NamesDimWhatTheyName) {
  const Scene scene = ThreeLamps();
  const auto factors = [&](const std::vector<Dimming>& dims) { return DimmingFactors(scene, dims); };
  const Rgb one = Rgb::Ones(), half = Rgb::Constant(0.5), blue(0, 0, 1);
  const auto expect = [&](const std::vector<Dimming>& dims, const std::vector<Rgb>& want) {
    const std::vector<Rgb> got = factors(dims);
    for (std::size_t p = 0; p < want.size(); ++p) EXPECT_TRUE((got[p] == want[p]).all()) << p;
  };
  expect({{"glow", half}}, {half, half, one, one});
  expect({{"left lamp", half}}, {half, one, one, one});
  expect({{"1", blue}}, {one, blue, one, one});
  expect({{"face:4", half}}, {one, one, one, half});
  expect({{"glow", half}, {"object:right lamp", half}}, {half, Rgb::Constant(0.25), one, one});

  Scene dimmed = scene;
  ScaleEmittance(dimmed, factors({{"left lamp", half}, {"material:red", blue}}));
  EXPECT_TRUE((Flux(dimmed) == Rgb(1.5, 3, 4.5)).all());
  EXPECT_EQ(dimmed.materials[0].name, "glow");
  EXPECT_NE(dimmed.patches[0].material, dimmed.patches[1].material);
  EXPECT_EQ(dimmed.faces[1].material, dimmed.patches[1].material);
  EXPECT_TRUE((dimmed.MaterialOf(1).reflectance == scene.MaterialOf(1).reflectance).all());
}

// A name that belongs to nothing is answered with those that are most like it.
TEST(Emitters, WrongNamesAreAnsweredWithNearOnes) {
  const Scene scene = ThreeLamps();
  EXPECT_THAT(ErrorOf(scene, {{"left lmap"}}), HasSubstr("did you mean 'left lamp', 'right lamp' or"));
  EXPECT_THAT(ErrorOf(scene, {{"glove"}}), HasSubstr("did you mean 'glow'"));
  EXPECT_THAT(ErrorOf(scene, {{"5"}}), HasSubstr("no object, material or face '5'"));
  EXPECT_THAT(ErrorOf(scene, {{"floor"}}), HasSubstr("'floor' emits nothing"));
  EXPECT_THAT(ErrorOf(scene, {{"2"}}), HasSubstr("'2' emits nothing"));
  EXPECT_THAT(ErrorOf(scene, {{"3"}, {"4"}}), HasSubstr("are one emitter"));
  Scene ambiguous = scene;
  ambiguous.materials[0].name = "sign";
  EXPECT_THAT(ErrorOf(ambiguous, {{"sign"}}), HasSubstr("write object:sign or material:sign"));
  EXPECT_EQ(ErrorOf(ambiguous, {{"object:sign"}}), "");
  Scene bright = scene;
  EXPECT_THROW(ScaleEmittance(bright, std::vector<Rgb>(4, Rgb::Constant(1e100))), InputError);
}

}  // namespace
}  // namespace penumbra
