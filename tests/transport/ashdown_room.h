// tests/transport/ashdown_room.h
//
// The scene ROOM.WLD from Ashdown, Radiosity: A Programmer's Perspective (1994), rebuilt from the numbers in
// the book. Ashdown's room is a closed room with two lights and a bench. The printed file LIGHT.ENT lacks
// three vertices. The vertices that are missing in LIGHT.ENT are placed where the faces of the light need
// them.

#pragma once

#include <array>
#include <vector>

#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {

// A transformation that scales, then rotates about the x axis and then about the y axis by multiples of 90
// degrees, and finally moves.
struct Placing {
  Vec3 scale = Vec3::Ones();
  int quarter_x = 0, quarter_y = 0;  // numbers of 90-degree turns, counter-clockwise seen from the axis's tip
  Vec3 move = Vec3::Zero();

  Vec3 operator()(const Vec3& v) const {
    Vec3 p = v.cwiseProduct(scale);
    for (int i = 0; i < quarter_x; ++i) p = Vec3(p.x(), -p.z(), p.y());
    for (int i = 0; i < quarter_y; ++i) p = Vec3(p.z(), p.y(), -p.x());
    return p + move;
  }
};

inline std::int32_t AddColour(Scene& scene, const Rgb& reflectance, double emittance = 0) {
  const std::int32_t id = AddMaterial(scene, 0, emittance);
  scene.materials.back().reflectance = reflectance;
  return id;
}

inline void AddPlaced(Scene& scene, const std::vector<Vec3>& vertices, const std::vector<int>& corners,
                      const Placing& placing, std::int32_t material) {
  Polygon3 polygon;
  for (const int corner : corners) polygon.push_back(placing(vertices[static_cast<std::size_t>(corner)]));
  Add(scene, polygon, material);
}

// Adds a light: a slab of 1 x 1 x 0.02 with four blue sides. Five strips on one face of the light have
// emittance 1, and five strips on the other face have emittance 0.5.
inline void AddAshdownLight(Scene& scene, const Placing& placing) {
  const std::int32_t bright = AddColour(scene, Rgb::Zero(), 1), dim = AddColour(scene, Rgb::Zero(), 0.5),
                     blue = AddColour(scene, {0, 0, 0.5});
  constexpr double kThick = 0.02;
  const auto quad = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, std::int32_t material) {
    AddPlaced(scene, {a, b, c, d}, {0, 1, 2, 3}, placing, material);
  };
  for (int i = 0; i < 5; ++i) {
    const double x = i / 5.0, y = (i + 1) / 5.0;
    quad({x, 0, kThick}, {y, 0, kThick}, {y, 1, kThick}, {x, 1, kThick}, bright);
    quad({x, 0, 0}, {x, 1, 0}, {y, 1, 0}, {y, 0, 0}, dim);
  }
  quad({0, 0, 0}, {1, 0, 0}, {1, 0, kThick}, {0, 0, kThick}, blue);
  quad({1, 0, 0}, {1, 1, 0}, {1, 1, kThick}, {1, 0, kThick}, blue);
  quad({1, 1, 0}, {0, 1, 0}, {0, 1, kThick}, {1, 1, kThick}, blue);
  quad({0, 1, 0}, {0, 0, 0}, {0, 0, kThick}, {0, 1, kThick}, blue);
}

inline void AddAshdownBench(Scene& scene, const Placing& placing) {
  const std::vector<Vec3> v = {
      {0, 0, 2.5},   {2.5, 0, 2.5}, {2.5, 2.5, 2.5}, {0, 2.5, 2.5}, {5, 0, 2.5},     {5, 2.5, 2.5},
      {5, 0, 0},     {5, 2.5, 0},   {5, 2.5, 2.5},   {5, 0, 2.5},   {0, 0, 0},       {0, 0, 2.5},
      {0, 2.5, 2.5}, {0, 2.5, 0},   {4.8, 0, 0},     {4.8, 0, 2.3}, {4.8, 2.5, 2.3}, {4.8, 2.5, 0},
      {0.2, 0, 0},   {0.2, 2.5, 0}, {0.2, 2.5, 2.3}, {0.2, 0, 2.3}, {5, 0, 0},       {5, 2.5, 0},
      {5, 2.5, 2.5}, {5, 0, 2.5},   {0, 0, 0},       {0, 2.5, 0},   {0, 2.5, 2.5},   {0, 0, 2.5}};
  const std::int32_t top = AddColour(scene, {0.5, 0.2, 0.7}), end = AddColour(scene, {0, 0.8, 0.3}),
                     under = AddColour(scene, {0, 0.3, 0});
  AddPlaced(scene, v, {0, 4, 5, 3}, placing, top);
  AddPlaced(scene, v, {6, 7, 8, 9}, placing, end);
  AddPlaced(scene, v, {10, 11, 12, 13}, placing, end);
  const std::array<std::array<int, 4>, 11> rest = {{{14, 15, 16, 17},
                                                    {18, 19, 20, 21},
                                                    {21, 20, 16, 15},
                                                    {17, 16, 24, 23},
                                                    {16, 20, 28, 24},
                                                    {19, 27, 28, 20},
                                                    {14, 17, 23, 22},
                                                    {26, 27, 19, 18},
                                                    {14, 22, 25, 15},
                                                    {21, 15, 25, 29},
                                                    {26, 18, 21, 29}}};
  for (const auto& corners : rest) AddPlaced(scene, v, {corners.begin(), corners.end()}, placing, under);
}

inline Scene AshdownRoom() {
  Scene scene;
  const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto wall = [&](const Rgb& colour, const Placing& placing) {
    AddPlaced(scene, square, {0, 1, 2, 3}, placing, AddColour(scene, colour));
  };
  const Rgb white = Rgb::Constant(0.8);
  wall({0.2, 0.3, 0.3}, {{1, 1.6, 1}, 0, 0, {0, 0, 0}});        // floor
  wall(Rgb::Constant(0.95), {{1, 1.6, 1}, 2, 0, {0, 1.6, 1}});  // ceiling
  wall({0.95, 0, 0}, {{1, 1, 1}, 3, 0, {0, 0, 1}});             // wall at y = 0
  wall(white, {{1, 1.6, 1}, 0, 1, {0, 0, 1}});                  // wall at x = 0
  wall(white, {{1, 1, 1}, 1, 0, {0, 1.6, 0}});                  // wall at y = 1.6
  wall(white, {{1, 1.6, 1}, 0, 3, {1, 0, 0}});                  // wall at x = 1
  AddAshdownLight(scene, {{0.8, 0.05, 1}, 2, 0, {0.1, 0.2, 0.8}});
  AddAshdownLight(scene, {{0.8, 0.05, 1}, 2, 0, {0.1, 1.4, 0.8}});
  AddAshdownBench(scene, {{0.16, 0.16, 0.08}, 0, 0, {0.1, 0.2, 0}});
  return scene;
}

}  // namespace penumbra::scene_test
