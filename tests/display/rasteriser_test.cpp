#include "display/rasteriser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include "solver/base/parallel.h"
#include "solver/base/random.h"
#include "tests/display/brute_force.h"

namespace penumbra {
namespace {

struct Buffers {
  Buffers(Rasteriser& rasteriser, const PixelRays& rays, int width, int height)
      : ids(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 12345),
        s(ids.size(), -1.0f),
        t(ids.size(), -1.0f) {
    rasteriser.DrawTriangleIds(rays, width, height, ids);
    rasteriser.DrawBarycentrics(ids, s, t);
  }

  std::ptrdiff_t Background() const { return std::count(ids.begin(), ids.end(), kNoTriangle); }

  std::vector<std::uint32_t> ids;
  std::vector<float> s, t;
};

Buffers Draw(const Triangles& mesh, const PixelRays& rays, int width, int height) {
  Rasteriser rasteriser(mesh.positions, mesh.triangles);
  return {rasteriser, rays, width, height};
}

Vec3 RandomDirection(Random& random) {
  const double z = random.Uniform(-1, 1), angle = random.Uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// A camera at `eye` that looks anywhere, held at any angle, with any field of view.
PixelRays RandomView(Random& random, const Vec3& eye, int width, int height) {
  return MakePixelRays(
      {"random", eye, eye + RandomDirection(random), RandomDirection(random), random.Uniform(2, 150)}, width,
      height);
}

// A grid over [low, high] in x and y, cells x cells, inner vertices moved by move(x, y), diagonals at random.
template <class Move>
Triangles Grid(Random& random, double low, double high, int cells, const Move& move) {
  Triangles grid;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const Vec3 p(low + (high - low) * i / cells, low + (high - low) * j / cells, 0);
      grid.AddVertex(i > 0 && i < cells && j > 0 && j < cells ? move(p) : p);
    }
  const auto stride = static_cast<std::uint32_t>(cells) + 1;
  for (std::uint32_t j = 0; j + 1 < stride; ++j)
    for (std::uint32_t i = 0; i + 1 < stride; ++i) {
      const std::uint32_t a = j * stride + i, b = a + 1, c = a + stride + 1, d = a + stride;
      if (random.Index(2) == 0) {
        grid.triangles.push_back({a, b, c});
        grid.triangles.push_back({a, c, d});
      } else {
        grid.triangles.push_back({a, b, d});
        grid.triangles.push_back({b, c, d});
      }
    }
  return grid;
}

// A closed surface about the origin, seen from inside: the cube's sides cut into cells x cells x 2 triangles,
// each with vertices of its own, pushed out by shape(p).
template <class Shape>
Triangles ClosedSurface(int cells, const Shape& shape) {
  Triangles surface;
  for (int axis = 0; axis < 3; ++axis)
    for (const int sign : {-1, 1}) {
      const auto at = [&](int i, int j) {
        Vec3 p;
        p[axis] = sign;
        p[(axis + 1) % 3] = -1 + 2.0 * i / cells;
        p[(axis + 2) % 3] = -1 + 2.0 * j / cells;
        return shape(p);
      };
      for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
          const Vec3 a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
          if (sign > 0) {
            surface.AddTriangle(a, c, b);
            surface.AddTriangle(a, d, c);
          } else {
            surface.AddTriangle(a, b, c);
            surface.AddTriangle(a, c, d);
          }
        }
    }
  return surface;
}

// A mesh without a hole leaves no pixel open and shows at each pixel a triangle that is there, though its
// vertices and edges run through pixel centres.
TEST(Rasteriser, LeavesNoGapsWhereEdgesMeetPixelCentres) {
  constexpr int kSize = 64;
  // One pixel is one metre on the plane z = 0; pixel centres have coordinates of k + 1/2.
  const PixelRays rays =
      MakePixelRays({"down", {0, 0, kSize / 2}, {0, 0, 0}, Vec3::UnitY(), 90}, kSize, kSize);
  Random random(1);
  int loose = 0;
  for (int round = 0; round < 20; ++round) {
    // Every inner vertex in the centre of a pixel; cells of 4 pixels stay untangled under moves of one.
    const Triangles grid = Grid(random, -kSize / 2, kSize / 2, kSize / 4, [&](const Vec3& p) {
      return Vec3(p.x() - 0.5 + random.Index(2), p.y() - 0.5 + random.Index(2), 0);
    });
    const Buffers drawn = Draw(grid, rays, kSize, kSize);
    EXPECT_EQ(drawn.Background(), 0);
    const Agreement agreement = CompareIds(rays, kSize, kSize, grid, drawn.ids);
    EXPECT_EQ(agreement.wrong, 0) << "pixel " << agreement.first_wrong << " of round " << round;
    loose += agreement.loose;
  }
  std::cout << "pixels on edges: " << loose << " of " << 20 * kSize * kSize << "\n";
  EXPECT_GT(loose, 1000);
}

// The pixels of an edge through pixel centres all go to the same side of it.
TEST(Rasteriser, GivesAnEdgeToOneSide) {
  constexpr int kSize = 32;
  const PixelRays rays =
      MakePixelRays({"down", {0, 0, kSize / 2}, {0, 0, 0}, Vec3::UnitY(), 90}, kSize, kSize);
  for (const bool mirrored : {false, true}) {
    Triangles square;
    const double r = kSize / 2;
    const auto corner = [&](double x, double y) { return Vec3(mirrored ? -x : x, y, 0); };
    const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      mirrored ? square.AddTriangle(a, c, b) : square.AddTriangle(a, b, c);
    };
    add(corner(-r, -r), corner(r, -r), corner(r, r));
    add(corner(-r, -r), corner(r, r), corner(-r, r));
    const Buffers drawn = Draw(square, rays, kSize, kSize);
    EXPECT_EQ(drawn.Background(), 0);
    for (int i = 0; i < kSize; ++i) {
      const auto at = static_cast<std::size_t>(i * kSize + (mirrored ? i : kSize - 1 - i));
      const auto first = static_cast<std::size_t>(mirrored ? 0 : kSize - 1);
      EXPECT_EQ(drawn.ids[at], drawn.ids[first]) << i;
    }
  }
}

// Random meshes, seen askew, show what rays in double precision meet and no gap.
TEST(Rasteriser, DrawsRandomMeshesAsRaysMeetThem) {
  constexpr int kWidth = 97, kHeight = 71;
  Random random(2);
  int loose = 0, covered = 0;
  for (int round = 0; round < 12; ++round) {
    const Triangles grid = Grid(random, -1, 1, 14, [&](const Vec3& p) {
      return Vec3(p + Vec3(random.Uniform(-0.05, 0.05), random.Uniform(-0.05, 0.05), random.Uniform(0, 0.1)));
    });
    const Vec3 eye(random.Uniform(-1.5, 1.5), random.Uniform(-1.5, 1.5), random.Uniform(0.3, 3));
    const PixelRays rays =
        MakePixelRays({"askew", eye, Vec3(random.Uniform(-0.5, 0.5), random.Uniform(-0.5, 0.5), 0),
                       RandomDirection(random), random.Uniform(10, 90)},
                      kWidth, kHeight);
    const Buffers drawn = Draw(grid, rays, kWidth, kHeight);
    const Agreement agreement = CompareIds(rays, kWidth, kHeight, grid, drawn.ids);
    EXPECT_EQ(agreement.wrong, 0) << "pixel " << agreement.first_wrong << " of round " << round;
    loose += agreement.loose;
    covered += kWidth * kHeight - static_cast<int>(drawn.Background());
  }
  std::cout << "pixels at edges with a choice: " << loose << " of " << covered << " covered\n";
  EXPECT_LT(loose, covered / 100);
}

// From inside a closed surface there is no way out: not a pixel of background from any eye, however near to a
// wall, in any direction and with any field of view.
TEST(Rasteriser, ShowsNoBackgroundFromInsideAClosedSurface) {
  constexpr int kWidth = 160, kHeight = 120;
  Random random(3);
  const Vec3 half(3, 2, 1.3);
  const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
  const auto box = [&](const Vec3& p) -> Vec3 { return turn * Vec3(p.cwiseProduct(half)); };
  const auto ellipsoid = [&](const Vec3& p) -> Vec3 {
    return turn * Vec3(p.normalized().cwiseProduct(half));
  };
  std::vector<Rasteriser> surfaces;
  for (const int cells : {1, 7, 40}) {
    const Triangles boxes = ClosedSurface(cells, box), balls = ClosedSurface(cells + 6, ellipsoid);
    surfaces.emplace_back(boxes.positions, boxes.triangles);
    surfaces.emplace_back(balls.positions, balls.triangles);
  }
  for (int round = 0; round < 600; ++round) {
    Rasteriser& surface = surfaces[random.Index(static_cast<std::uint32_t>(surfaces.size()))];
    // Anywhere within the inner ellipsoid, half of the eyes next to the boxes' walls or the ellipsoid's.
    Vec3 eye = RandomDirection(random) * std::cbrt(random.Uniform()) * 0.9;
    if (random.Index(2) == 0) {
      eye = RandomDirection(random) * 0.9;
      if (&surface == &surfaces[0] || &surface == &surfaces[2] || &surface == &surfaces[4])
        eye = eye / eye.cwiseAbs().maxCoeff() * (1 - random.LogUniform(1e-9, 0.1));
    }
    const Vec3 place = turn * Vec3(eye.cwiseProduct(half));
    const PixelRays rays = RandomView(random, place, kWidth, kHeight);
    const Buffers drawn(surface, rays, kWidth, kHeight);
    ASSERT_EQ(drawn.Background(), 0) << "round " << round << ", eye " << place.transpose();
  }
}

// The sides of a box that are cut at different places along their common edges close as well (T-vertices).
TEST(Rasteriser, ClosesTVertices) {
  constexpr int kWidth = 200, kHeight = 150;
  Random random(4);
  const Eigen::AngleAxisd turn(0.4, Vec3(3, 1, 2).normalized());
  Triangles room;
  for (int axis = 0; axis < 3; ++axis)
    for (const int sign : {-1, 1}) {
      const int cells = 1 + 2 * axis + 7 * (sign + 1);
      const auto at = [&](int i, int j) -> Vec3 {
        Vec3 p;
        p[axis] = sign;
        p[(axis + 1) % 3] = sign * (-1 + 2.0 * i / cells);
        p[(axis + 2) % 3] = -1 + 2.0 * j / (cells + 3);
        return turn * p;
      };
      for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells + 3; ++j) {
          room.AddTriangle(at(i, j), at(i + 1, j + 1), at(i + 1, j));
          room.AddTriangle(at(i, j), at(i, j + 1), at(i + 1, j + 1));
        }
    }
  // Fronts look inwards: turn round what does not.
  for (VertexIndices& triangle : room.triangles) {
    const Vec3 &a = room.positions[triangle[0]], &b = room.positions[triangle[1]],
               &c = room.positions[triangle[2]];
    if ((b - a).cross(c - a).dot(a) > 0) std::swap(triangle[1], triangle[2]);
  }
  Rasteriser rasteriser(room.positions, room.triangles);
  for (int round = 0; round < 200; ++round) {
    const Vec3 eye =
        turn * (0.95 * Vec3(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)));
    const Buffers drawn(rasteriser, RandomView(random, eye, kWidth, kHeight), kWidth, kHeight);
    ASSERT_EQ(drawn.Background(), 0) << "round " << round;
  }
}

// Of triangles in disorder, some of them behind the eye or cut by its plane, the nearest front shows.
TEST(Rasteriser, HidesWhatRaysDoNotReach) {
  constexpr int kWidth = 90, kHeight = 70;
  Random random(5);
  int loose = 0, total = 0;
  for (int round = 0; round < 20; ++round) {
    Triangles soup;
    const double size = random.LogUniform(0.05, 3);
    const auto anywhere = [&](double r) {
      return Vec3(random.Uniform(-r, r), random.Uniform(-r, r), random.Uniform(-r, r));
    };
    for (int i = 0; i < 150; ++i) {
      const Vec3 middle = anywhere(2);
      soup.AddTriangle(middle + anywhere(size), middle + anywhere(size), middle + anywhere(size));
    }
    const PixelRays rays = RandomView(random, anywhere(1), kWidth, kHeight);
    const Buffers drawn = Draw(soup, rays, kWidth, kHeight);
    const Agreement agreement = CompareIds(rays, kWidth, kHeight, soup, drawn.ids);
    EXPECT_EQ(agreement.wrong, 0) << "pixel " << agreement.first_wrong << " of round " << round;
    loose += agreement.loose;
    total += agreement.pixels;
  }
  std::cout << "pixels at edges with a choice: " << loose << " of " << total << "\n";
  EXPECT_LT(loose, total / 100);
}

// Barycentric coordinates are those of the ray's intersection with the triangle's plane; they lie in the
// triangle everywhere. Slivers, triangles seen at grazing angles and such as reach behind the eye included.
TEST(Rasteriser, FindsBarycentricCoordinatesOfTheRaysIntersection) {
  constexpr int kWidth = 120, kHeight = 90;
  Random random(6);
  double worst = 0;
  int compared = 0, slivers = 0;
  for (int round = 0; round < 400; ++round) {
    const auto anywhere = [&](double r) {
      return Vec3(random.Uniform(-r, r), random.Uniform(-r, r), random.Uniform(-r, r));
    };
    Triangles few;
    for (int i = 0; i < 5; ++i) {
      const Vec3 a = anywhere(2), b = anywhere(2);
      const bool sliver = random.Index(2) == 0;
      const Vec3 c = sliver ? Vec3(a + random.Uniform() * (b - a) + anywhere(random.LogUniform(1e-3, 0.1)))
                            : anywhere(2);
      few.AddTriangle(a, b, c);
    }
    const PixelRays rays = RandomView(random, anywhere(2.5), kWidth, kHeight);
    const Buffers drawn = Draw(few, rays, kWidth, kHeight);
    for (std::size_t i = 0; i < drawn.ids.size(); ++i) {
      if (drawn.ids[i] == kNoTriangle) {
        ASSERT_EQ(drawn.s[i], -1.0f) << "untouched where there is nothing";
        continue;
      }
      ASSERT_GE(drawn.s[i], 0.0f);
      ASSERT_GE(drawn.t[i], 0.0f);
      ASSERT_LE(drawn.s[i] + drawn.t[i], 1.0f + 1e-6f);
      const double x = static_cast<double>(i % kWidth) + 0.5, y = static_cast<double>(i / kWidth) + 0.5;
      const Meeting m = Meet(rays, x, y, few, drawn.ids[i]);
      if (m.pixels_inside < 0) continue;
      worst = std::max({worst, std::abs(static_cast<double>(drawn.s[i]) - m.s),
                        std::abs(static_cast<double>(drawn.t[i]) - m.t)});
      ++compared;
      slivers += m.pixels_inside < 0.1;
    }
  }
  std::cout << "largest error of a barycentric coordinate: " << worst << " over " << compared << " pixels, "
            << slivers << " of them within a tenth of a pixel of an edge\n";
  EXPECT_GT(compared, 100000);
  EXPECT_LT(worst, kBarycentricError);
}

// Back faces are not drawn and hide nothing.
TEST(Rasteriser, CullsBackFaces) {
  Triangles faces;
  faces.AddTriangle({-9, -9, 1}, {0, 9, 1}, {9, -9, 1});  // nearer, turned away
  const PixelRays rays = MakePixelRays({"down", {0, 0, 4}, {0, 0, 0}, Vec3::UnitY(), 40}, 30, 20);
  EXPECT_EQ(Draw(faces, rays, 30, 20).Background(), 30 * 20);
  faces.AddTriangle({-9, -9, 0}, {9, -9, 0}, {0, 9, 0});
  const Buffers drawn = Draw(faces, rays, 30, 20);
  EXPECT_EQ(std::count(drawn.ids.begin(), drawn.ids.end(), 1u), 30 * 20);
}

// Of two triangles at the same place the one with the lower index shows.
TEST(Rasteriser, ShowsTheFirstOfEqualTriangles) {
  Random random(7);
  for (int round = 0; round < 20; ++round) {
    Triangles pair;
    const Vec3 a(-5, -4, random.Uniform(-1, 1)), b(6, -3, random.Uniform(-1, 1)),
        c(0, 5, random.Uniform(-1, 1));
    pair.AddTriangle(a, b, c);
    pair.AddTriangle(a, b, c);
    const PixelRays rays = MakePixelRays({"down", {0, 0, 8}, {0, 0, 0}, Vec3::UnitY(), 70}, 64, 48);
    const Buffers drawn = Draw(pair, rays, 64, 48);
    EXPECT_GT(std::count(drawn.ids.begin(), drawn.ids.end(), 0u), 100);
    EXPECT_EQ(std::count(drawn.ids.begin(), drawn.ids.end(), 1u), 0);
  }
}

// Triangles without area, seen edge-on, or with a vertex in the eye neither show nor harm others.
TEST(Rasteriser, BearsDegenerateTriangles) {
  Triangles mesh;
  mesh.AddTriangle({0, 0, 1}, {0, 0, 1}, {0, 0, 1});     // a point
  mesh.AddTriangle({-1, 0, 1}, {0, 0, 1}, {1, 0, 1});    // a line
  mesh.AddTriangle({0, 0, 4}, {1, 0, 1}, {0, 1, 1});     // a vertex in the eye
  mesh.AddTriangle({0, -1, 1}, {0, 1, 1}, {0, 0, 3});    // seen edge-on
  mesh.AddTriangle({-1, -1, 4}, {1, -1, 4}, {0, 1, 4});  // in the eye's plane, across the view
  mesh.AddTriangle({-99, -99, 0}, {99, -99, 0}, {0, 99, 0});
  const PixelRays rays = MakePixelRays({"down", {0, 0, 4}, {0, 0, 0}, Vec3::UnitY(), 60}, 33, 31);
  const Buffers drawn = Draw(mesh, rays, 33, 31);
  EXPECT_EQ(std::count(drawn.ids.begin(), drawn.ids.end(), 5u), 33 * 31);
}

// Nothing but background comes of an empty mesh, in pictures of any size.
TEST(Rasteriser, DrawsAnEmptyMesh) {
  Rasteriser nothing({}, {});
  EXPECT_EQ(nothing.TriangleCount(), 0u);
  for (const auto& [width, height] : {std::pair{1, 1}, {64, 64}, {65, 1}, {1, 129}, {200, 3}}) {
    const PixelRays rays = MakePixelRays({}, width, height);
    EXPECT_EQ(Buffers(nothing, rays, width, height).Background(), width * height);
  }
}

// A picture's pixels do not depend on its neighbours' place in tiles: any size shows what rays meet.
TEST(Rasteriser, DrawsPicturesOfAnySize) {
  Random random(8);
  const Triangles grid = Grid(random, -1, 1, 5, [](const Vec3& p) { return p; });
  for (const auto& [width, height] :
       {std::pair{1, 1}, {2, 1}, {1, 77}, {63, 65}, {64, 64}, {65, 63}, {129, 7}, {301, 2}}) {
    const PixelRays rays =
        MakePixelRays({"askew", {0.9, -1.2, 0.8}, {0, 0, 0}, Vec3::UnitZ(), 70}, width, height);
    const Buffers drawn = Draw(grid, rays, width, height);
    const Agreement agreement = CompareIds(rays, width, height, grid, drawn.ids);
    EXPECT_EQ(agreement.wrong, 0) << width << " x " << height << ", pixel " << agreement.first_wrong;
  }
}

// The size of a scene and its distance from the origin do not matter: the picture is the same but for pixels
// at edges.
TEST(Rasteriser, DrawsLargeAndSmallScenesAlike) {
  constexpr int kWidth = 80, kHeight = 60;
  Random random(9);
  const Triangles grid = Grid(random, -1, 1, 9, [&](const Vec3& p) {
    return Vec3(p + Vec3(random.Uniform(-0.05, 0.05), random.Uniform(-0.05, 0.05), random.Uniform(0, 0.2)));
  });
  for (const double scale : {1e-9, 1e-3, 1.0, 1e6, 1e12}) {
    const Vec3 shift = scale * Vec3(100, -200, 300);
    Triangles moved = grid;
    for (Vec3& p : moved.positions) p = scale * p + shift;
    const PixelRays rays = MakePixelRays(
        {"askew", scale * Vec3(0.9, -1.2, 0.8) + shift, shift, Vec3::UnitZ(), 60}, kWidth, kHeight);
    const Buffers drawn = Draw(moved, rays, kWidth, kHeight);
    const Agreement agreement = CompareIds(rays, kWidth, kHeight, moved, drawn.ids);
    EXPECT_EQ(agreement.wrong, 0) << "scale " << scale << ", pixel " << agreement.first_wrong;
    EXPECT_LT(drawn.Background(), kWidth * kHeight);
  }
}

// The same ids and coordinates, bit by bit, from 1, 2 and 5 threads.
TEST(Rasteriser, GivesTheSameBytesForAnyNumberOfThreads) {
  constexpr int kWidth = 333, kHeight = 222;
  Random random(10);
  const Triangles grid = Grid(random, -1, 1, 90, [&](const Vec3& p) {
    return Vec3(p +
                Vec3(random.Uniform(-0.005, 0.005), random.Uniform(-0.005, 0.005), random.Uniform(0, 0.2)));
  });
  Rasteriser rasteriser(grid.positions, grid.triangles);
  const PixelRays rays =
      MakePixelRays({"askew", {0.9, -1.2, 0.8}, {0, 0, 0}, Vec3::UnitZ(), 60}, kWidth, kHeight);
  SetThreadCount(1);
  const Buffers one(rasteriser, rays, kWidth, kHeight);
  for (const int threads : {2, 5}) {
    SetThreadCount(threads);
    const Buffers many(rasteriser, rays, kWidth, kHeight);
    EXPECT_EQ(one.ids, many.ids) << threads;
    EXPECT_EQ(one.s, many.s) << threads;
    EXPECT_EQ(one.t, many.t) << threads;
  }
  SetThreadCount(0);
}

}  // namespace
}  // namespace penumbra
