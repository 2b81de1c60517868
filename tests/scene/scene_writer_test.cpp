// Scenes written for other programs hold the same surfaces, fronts and lights.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>

#include "solver/scene/builtin_scenes.h"
#include "solver/scene/mgf_colour.h"
#include "solver/scene/mgf_writer.h"
#include "solver/scene/obj_reader.h"
#include "solver/scene/obj_writer.h"
#include "solver/scene/pbrt_writer.h"

namespace penumbra {
namespace {

// Rounding of areas that are summed in another order.
constexpr double kWritingRounding = 1e-12;

Scene ReadBack(const Scene& scene) {
  const std::string mtl = MtlText(scene);
  return ReadObjText(
      ObjText(scene, "a b.mtl"), "a.obj",
      [&](std::string_view name) { return name == "a b.mtl" ? std::optional(mtl) : std::nullopt; }, {});
}

void ExpectSame(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    EXPECT_TRUE((a.materials[i].reflectance == b.materials[i].reflectance).all());
    EXPECT_TRUE((a.materials[i].emittance == b.materials[i].emittance).all());
  }
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) EXPECT_EQ(a.objects[i].faces, b.objects[i].faces);
  ASSERT_EQ(a.faces.size(), b.faces.size());
  for (std::size_t i = 0; i < a.faces.size(); ++i) {
    EXPECT_EQ(a.faces[i].vertices, b.faces[i].vertices);
    EXPECT_EQ(a.faces[i].material, b.faces[i].material);
    EXPECT_EQ(a.faces[i].object, b.faces[i].object);
  }
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t i = 0; i < a.patches.size(); ++i) {
    EXPECT_EQ(a.patches[i].vertex, b.patches[i].vertex);
    EXPECT_EQ(a.patches[i].faces, b.patches[i].faces);
  }
}

// Every built-in scene comes back from OBJ with the same numbers and names, its backs as well.
TEST(ObjWriter, IsReadBackTheSame) {
  for (const BuiltinScene& builtin : BuiltinScenes())
    for (const bool two_sided : {false, true}) {
      SceneOptions options;
      options.two_sided = two_sided;
      const Scene scene = LoadBuiltinScene(builtin.name, options).value();
      const Scene back = ReadBack(scene);
      ExpectSame(scene, back);
      for (std::size_t i = 0; i < scene.materials.size(); ++i)
        EXPECT_EQ(scene.materials[i].name, back.materials[i].name);
      for (std::size_t i = 0; i < scene.objects.size(); ++i)
        EXPECT_EQ(scene.objects[i].name, back.objects[i].name);
    }
}

// Dropped faces, faces of several groups, numbers without short decimals, names that repeat.
TEST(ObjWriter, KeepsWhatIsUnusual) {
  const std::string mtl =
      "newmtl a\nKd 0.1 0.2 0.3\nnewmtl a\nKd 0.30000000000000004 0 0.9999999999999999\nKe 1e-300 5e99 0.1\n";
  const std::string obj =
      "mtllib m\nv 0 0 0\nv 0.1 -0.0 1e-17\nv 0 0.3333333333333333 0\nv 5 5 5\no two words\ng x y\nusemtl "
      "a\nf 1 2 3\n"
      "f 1 1 1\ng y\nf 3 2 1\no empty\no two words\nf 4 4 4\n";
  const Scene scene = ReadObjText(obj, "s.obj", [&](std::string_view) { return std::optional(mtl); }, {});
  ASSERT_EQ(scene.faces.size(), 4U);
  ASSERT_TRUE(scene.faces[1].vertices.empty());
  ExpectSame(scene, ReadBack(scene));
  ExpectSame(Scene(), ReadBack(Scene()));
}

struct Triangle {
  std::array<Vec3, 3> vertex;
  Rgb radiance = Rgb::Zero();
};

// Reads what pbrt would: the triangles, and the radiance of their lights.
std::vector<Triangle> TrianglesOfPbrt(const std::string& text) {
  std::istringstream in(text);
  std::vector<Triangle> triangles;
  std::vector<Vec3> points;
  Rgb radiance = Rgb::Zero();
  const auto numbers = [&] {
    std::vector<double> list;
    std::string word;
    in >> word;
    EXPECT_EQ(word, "[");
    while (in >> word && word != "]") list.push_back(std::strtod(word.c_str(), nullptr));
    return list;
  };
  for (std::string word; in >> word;) {
    if (word == "AttributeBegin") radiance = Rgb::Zero();
    if (word == "L\"") {
      const std::vector<double> list = numbers();
      radiance = Rgb(list[0], list[1], list[2]);
    } else if (word == "P\"") {
      const std::vector<double> list = numbers();
      points.clear();
      for (std::size_t i = 0; i < list.size(); i += 3) points.emplace_back(list[i], list[i + 1], list[i + 2]);
    } else if (word == "indices\"") {
      const std::vector<double> list = numbers();
      const auto at = [&](std::size_t i) { return points.at(static_cast<std::size_t>(list[i])); };
      for (std::size_t i = 0; i < list.size(); i += 3)
        triangles.push_back({{at(i), at(i + 1), at(i + 2)}, radiance});
    }
  }
  return triangles;
}

// What a closed set of surfaces tells about itself: vector area and volume give orientations away.
struct Totals {
  double area = 0, volume = 0;
  Rgb power = Rgb::Zero();  // [W]

  void Add(std::span<const Vec3> polygon, const Rgb& emittance) {
    const Vec3 vector_area = VectorArea(polygon);
    area += vector_area.norm();
    volume += vector_area.dot(polygon[0]) / 3;
    power += vector_area.norm() * emittance;
  }
};

Totals TotalsOf(const Scene& scene) {
  Totals totals;
  for (const Patch& patch : scene.patches)
    totals.Add(patch.Vertices(), scene.materials[patch.material].emittance);
  return totals;
}

void ExpectNear(const Totals& got, const Totals& want) {
  EXPECT_NEAR(got.area, want.area, kWritingRounding * want.area);
  EXPECT_NEAR(got.volume, want.volume, kWritingRounding * want.area);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(got.power[c], want.power[c], kWritingRounding * want.power[c]);
}

// pbrt's triangles cover the patches, face as they do by its rule (p0 - p2) x (p1 - p2), and its lights send
// the same power from there: pi x radiance x area.
TEST(PbrtWriter, HoldsTheSameSurfacesAndPower) {
  for (const char* name : {"office", "cornell", "floating-cube"}) {
    const Scene scene = LoadBuiltinScene(name, {}).value();
    const std::string text = PbrtText(scene, scene.cameras[0], 640, 480);
    Totals totals;
    for (const Triangle& t : TrianglesOfPbrt(text)) {
      totals.Add(t.vertex, std::numbers::pi * t.radiance);
      const Vec3 normal = (t.vertex[0] - t.vertex[2]).cross(t.vertex[1] - t.vertex[2]);
      EXPECT_GT(normal.dot(VectorArea(t.vertex)), 0);
    }
    ExpectNear(totals, TotalsOf(scene));
    EXPECT_NE(text.find("Scale -1 1 1\nLookAt"), text.npos);
  }
}

// The same of MGF; its colours give the three channels back through the primaries of its own conversion.
TEST(MgfWriter, HoldsTheSameSurfacesAndPower) {
  for (const char* name : {"office", "cornell", "floating-cube"}) {
    const Scene scene = LoadBuiltinScene(name, {}).value();
    Eigen::Matrix3d xyz_from_rgb;
    for (int c = 0; c < 3; ++c) {
      Rgb unit = Rgb::Zero();
      unit[c] = 1;
      xyz_from_rgb.col(c) = MgfXyz(unit);
    }
    EXPECT_LT((MgfXyz(Rgb::Ones()) - Vec3::Ones()).norm(),
              kWritingRounding);  // white is white, of luminance 1
    std::istringstream in(MgfText(scene));
    std::map<std::string, Vec3> vertices;
    std::map<std::string, Rgb> emittance, reflectance;
    std::string vertex, material;
    double x = 0, y = 0;
    Totals totals;
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      std::string key;
      words >> key;
      if (key == "m") words >> material;
      if (key == "v") words >> vertex;
      if (key == "p") words >> vertices[vertex].x() >> vertices[vertex].y() >> vertices[vertex].z();
      if (key == "cxy") words >> x >> y;
      if (key == "rd" || key == "ed") {
        double luminance = 0;
        words >> luminance;
        const Vec3 rgb =
            xyz_from_rgb.inverse() * Vec3(luminance * x / y, luminance, luminance * (1 - x - y) / y);
        (key == "rd" ? reflectance : emittance)[material] = rgb.array();
      }
      if (key == "sides") {
        emittance[material] = Rgb::Zero();
        int sides = 0;
        words >> sides;
        EXPECT_EQ(sides, 1);
      }
      if (key == "f") {
        std::vector<Vec3> polygon;
        for (std::string v; words >> v;) polygon.push_back(vertices.at(v));
        totals.Add(polygon, emittance.at(material));
      }
    }
    ExpectNear(totals, TotalsOf(scene));
    for (std::size_t m = 0; m < scene.materials.size(); ++m)
      EXPECT_LT((reflectance.at("m" + std::to_string(m)) - scene.materials[m].reflectance).abs().maxCoeff(),
                kWritingRounding);
  }
}

}  // namespace
}  // namespace penumbra
