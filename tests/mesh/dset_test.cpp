#include "mesh/discontinuities/dset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "mesh/discontinuities/discontinuity_choices.h"
#include "mesh/discontinuities/line_jumps.h"
#include "mesh/triangulation/leaf_triangulation.h"
#include "mesh_test_scenes.h"
#include "solver/scene/builtin_scenes.h"

namespace penumbra {
namespace {

using mesh_test::AddSquare;
using mesh_test::EmptyScene;
using mesh_test::Segment;

// The unit square, its corner (0, 0) the origin of its frame, split into four.
struct QuarteredSquare {
  QuarteredSquare() : scene(EmptyScene()) {
    AddSquare(scene, {0.5, 0.5, 0}, 0.5, true);
    forest = ElementForest(scene);
    forest.Subdivide(0);
  }
  Scene scene;
  ElementForest forest;
};

// Collinear discontinuities, however long, reversed or apart, are one line and fill one place in a leaf.
TEST(ActivateDiscontinuities, CollinearOnesMerge) {
  const QuarteredSquare square;
  DiscontinuityOptions options;
  options.max_leaf_dsets = 1;
  const std::vector<Discontinuity> found = {Segment({0.05, 0.1}, {0.15, 0.2}, 1),
                                            Segment({0.3, 0.35}, {0.2, 0.25}, 2),
                                            Segment({0.1, 0.15}, {0.25, 0.3 + 1e-12}, 3)};
  const PatchDSets dsets = ActivateDiscontinuities(square.forest, 0, found, options);
  ASSERT_EQ(dsets.lines.size(), 1U);
  EXPECT_EQ(dsets.activated, 3U);
  EXPECT_EQ(dsets.dsets_active, 1U);
  ASSERT_EQ(dsets.lines[0].cover.size(), 1U);
  EXPECT_NEAR(dsets.lines[0].cover[0].t1 - dsets.lines[0].cover[0].t0, 0.25 * std::sqrt(2.0), 1e-10);
}

// The strongest are activated first, contacts before all; a discontinuity is refused for all leaves when one
// that it crosses is full, and a weaker one elsewhere still finds its place.
TEST(ActivateDiscontinuities, WeightDecidesForAllLeavesOrNone) {
  const QuarteredSquare square;
  DiscontinuityOptions options;
  options.max_leaf_dsets = 2;
  const std::vector<Discontinuity> found = {
      Segment({0.1, 0.11}, {0.4, 0.13}, 5),                                          // 0: second in leaf 0
      Segment({0.1, 0.21}, {0.9, 0.22}, 4),                                          // 1: leaf 0 is full
      Segment({0.1, 0.31}, {0.4, 0.32}, kInfiniteWeight, DiscontinuityDegree::kD0),  // 2: first in leaf 0
      Segment({0.6, 0.11}, {0.9, 0.12}, 3),                                          // 3: leaf 1 has room
      Segment({0.6, 0.81}, {0.9, 0.82}, 0.5)};                                       // 4: too weak
  options.min_weight = 1;
  const PatchDSets dsets = ActivateDiscontinuities(square.forest, 0, found, options);
  EXPECT_EQ(dsets.activated, 3U);
  EXPECT_EQ(dsets.refused, 1U);
  EXPECT_EQ(dsets.refused_contacts, 0U);
  EXPECT_EQ(dsets.dsets_active, 3U);
  EXPECT_EQ(dsets.leaf_lines[0], (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(dsets.leaf_lines[1], (std::vector<std::int32_t>{2}));
  EXPECT_TRUE(dsets.leaf_lines[2].empty());
  EXPECT_TRUE(dsets.leaf_lines[3].empty());
  EXPECT_EQ(dsets.lines[0].contact.size(), 1U);
}

// A contact that finds its leaf full of other contacts is refused, and counted.
TEST(ActivateDiscontinuities, RefusedContactsAreCounted) {
  const QuarteredSquare square;
  DiscontinuityOptions options;
  options.max_leaf_dsets = 1;
  const std::vector<Discontinuity> found = {
      Segment({0.1, 0.11}, {0.4, 0.13}, kInfiniteWeight, DiscontinuityDegree::kD0),
      Segment({0.1, 0.21}, {0.9, 0.22}, kInfiniteWeight, DiscontinuityDegree::kD0)};
  const PatchDSets dsets = ActivateDiscontinuities(square.forest, 0, found, options);
  EXPECT_EQ(dsets.activated, 1U);
  EXPECT_EQ(dsets.refused_contacts, 1U);
  EXPECT_TRUE(dsets.leaf_lines[1].empty());
}

// A line along the border of leaves belongs to both sides, and takes no place.
TEST(ActivateDiscontinuities, BordersTakeNoPlace) {
  const QuarteredSquare square;
  DiscontinuityOptions options;
  options.max_leaf_dsets = 0;
  const PatchDSets dsets =
      ActivateDiscontinuities(square.forest, 0, std::vector{Segment({0.1, 0.5}, {0.4, 0.5}, 1)}, options);
  EXPECT_EQ(dsets.activated, 1U);
  EXPECT_EQ(dsets.dsets_active, 0U);
  EXPECT_EQ(dsets.leaf_lines[0].size(), 1U);
  EXPECT_EQ(dsets.leaf_lines[3].size(), 1U);
  EXPECT_TRUE(dsets.leaf_lines[1].empty());
}

// In the irradiance weight a discontinuity counts by what it costs on the leaf: a kink of the gradient with
// the size, a bend with its square, neither more than the largest change.
TEST(Weight, FollowsTheLeaf) {
  Discontinuity d = Segment({0, 0}, {1, 0}, 0);
  d.strength = 10;
  d.geometric_weight = 0.5;
  for (IrradianceJump& jump : d.jump) jump = {0, 3, 100, 100};
  EXPECT_DOUBLE_EQ(Weight(d, DiscontinuityWeight::kIrradiance, 0.2), 10 * kBendError * 0.04 * 3);
  for (IrradianceJump& jump : d.jump) jump.largest_gradient = 1e-3;
  EXPECT_DOUBLE_EQ(Weight(d, DiscontinuityWeight::kIrradiance, 0.2), 10 * kKinkError * 0.2 * 1e-3);
  for (IrradianceJump& jump : d.jump) jump.largest_value = 1e-7;
  EXPECT_DOUBLE_EQ(Weight(d, DiscontinuityWeight::kIrradiance, 0.2), 10 * 1e-7);
  EXPECT_DOUBLE_EQ(Weight(d, DiscontinuityWeight::kThesis, 0.2), 5);
  d.kind = DiscontinuityKind::kContact;
  EXPECT_EQ(Weight(d, DiscontinuityWeight::kIrradiance, 0.2), kInfiniteWeight);
}

// A full leaf refuses a discontinuity that three others would take, and is named as crowded; one that only it
// would get is refused in silence.
TEST(ActivateDiscontinuities, CrowdedLeavesAreNamed) {
  const QuarteredSquare square;
  DiscontinuityOptions options;
  options.max_leaf_dsets = 1;
  std::vector<Discontinuity> found = {Segment({0.1, 0.11}, {0.4, 0.13}, 9),
                                      Segment({0.1, 0.21}, {0.4, 0.22}, 8)};
  EXPECT_TRUE(ActivateDiscontinuities(square.forest, 0, found, options).crowded.empty());
  found.push_back(Segment({0.1, 0.2}, {0.9, 0.95}, 7));
  const PatchDSets dsets = ActivateDiscontinuities(square.forest, 0, found, options);
  EXPECT_EQ(dsets.refused, 2U);
  EXPECT_EQ(dsets.crowded, std::vector<ElementId>{dsets.leaves[0]});
}

// The other choices: all know no maximum, a random order no weights (but contacts come first), and the
// adaptive one asks the filter leaf by leaf.
TEST(ActivateDiscontinuities, OtherChoices) {
  const QuarteredSquare square;
  DiscontinuityOptions options;
  options.max_leaf_dsets = 1;
  std::vector<Discontinuity> found;
  for (int i = 0; i < 8; ++i)
    found.push_back(Segment({0.1, 0.1 + 0.03 * i}, {0.9, 0.11 + 0.03 * i}, 1.0 + i));
  found.push_back(Segment({0.6, 0.8}, {0.9, 0.9}, kInfiniteWeight, DiscontinuityDegree::kD0));
  options.choice = "all";
  EXPECT_EQ(ActivateDiscontinuities(square.forest, 0, found, options).activated, 9U);
  options.choice = "random";
  std::set<double> origins;
  for (options.seed = 1; options.seed < 20; ++options.seed) {
    const PatchDSets dsets = ActivateDiscontinuities(square.forest, 0, found, options);
    EXPECT_EQ(dsets.activated, 2U);
    EXPECT_EQ(dsets.refused_contacts, 0U);
    origins.insert(dsets.lines.back().origin.y());
  }
  EXPECT_GT(origins.size(), 3U);
  // Of contacts all are taken, of the others a share.
  options.max_leaf_dsets = 100;
  std::size_t activated = 0;
  options.random_share = 0.25;
  for (options.seed = 1; options.seed <= 100; ++options.seed)
    activated += ActivateDiscontinuities(square.forest, 0, found, options).activated - 1;
  EXPECT_NEAR(static_cast<double>(activated), 200, 5 * std::sqrt(800 * 0.25 * 0.75));  // deviations
  options.random_share = 0;
  EXPECT_EQ(ActivateDiscontinuities(square.forest, 0, found, options).activated, 1U);
  options.max_leaf_dsets = 1;
  options.choice = "adaptive";
  const PatchDSets dsets = ActivateDiscontinuities(
      square.forest, 0, found, options,
      {.filter = [&](const Discontinuity&, ElementId leaf) { return leaf == square.forest.Leaves(0)[1]; }});
  EXPECT_EQ(dsets.activated, 2U);
  EXPECT_TRUE(dsets.leaf_lines[0].empty());
  EXPECT_EQ(dsets.leaf_lines[1].size(), 1U);
  TriangulateLeaves(square.forest, 0, dsets).Validate(square.scene.patches[0]);
}

// The shortest first.
class ShortestChoice final : public DiscontinuityChoiceMethod {
 public:
  std::optional<DiscontinuityRanks> Rank(PatchId, std::span<const Discontinuity> found,
                                         const DiscontinuityOptions&) const override {
    DiscontinuityRanks ranks;
    for (const Discontinuity& d : found) ranks.rank.push_back(1 / (d.end[1] - d.end[0]).norm());
    return ranks;
  }
};

// Choices are listed by name, the default first; a choice that a program adds decides like the others, and a
// name that nobody has is refused with the list.
TEST(DiscontinuityChoices, AreListedAndAdded) {
  static const bool added = [] {
    DiscontinuityChoices().Add(
        {"shortest", "the shortest first", {}, [] { return std::make_unique<const ShortestChoice>(); }});
    return true;
  }();
  EXPECT_TRUE(added);
  EXPECT_EQ(DiscontinuityChoices().Names(),
            (std::vector<std::string>{"ranked", "adaptive", "none", "random", "all", "shortest"}));
  for (const DiscontinuityChoiceRegistry::Method& method : DiscontinuityChoices().methods())
    EXPECT_FALSE(method.help.empty());
  const QuarteredSquare square;
  const std::vector<Discontinuity> found = {Segment({0.1, 0.1}, {0.4, 0.12}, 9),
                                            Segment({0.1, 0.3}, {0.2, 0.32}, 1)};
  DiscontinuityOptions options;
  options.max_leaf_dsets = 1;
  EXPECT_EQ(ActivateDiscontinuities(square.forest, 0, found, options).lines.at(0).origin.y(), 0.1);
  options.choice = "shortest";
  EXPECT_TRUE(options.enabled());
  EXPECT_FALSE(options.can_want());
  EXPECT_EQ(ActivateDiscontinuities(square.forest, 0, found, options).lines.at(0).origin.y(), 0.3);
  options.choice = "guess";
  try {
    ActivateDiscontinuities(square.forest, 0, found, options);
    ADD_FAILURE() << "a choice that does not exist was found";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("ranked, adaptive, none, random, all, shortest"),
              std::string::npos)
        << error.what();
  }
}

// A discontinuity of first degree, of an event of its own.
Discontinuity Kink(const Vec2& a, const Vec2& b, double gradient, std::int32_t event) {
  Discontinuity d = Segment(a, b, 0, DiscontinuityDegree::kD1);
  d.strength = 1;
  d.source = event;
  for (IrradianceJump& jump : d.jump) jump = {gradient, 1e9, std::abs(gradient), 1e9};
  d.weight = Weight(d, DiscontinuityWeight::kIrradiance, 1);
  return d;
}

DiscontinuityOptions ByIrradiance(int max_leaf_dsets) {
  DiscontinuityOptions options;
  options.weight = DiscontinuityWeight::kIrradiance;
  options.max_leaf_dsets = max_leaf_dsets;
  return options;
}

// In the irradiance weight a discontinuity counts by what it costs beside those that are active: of ten lines
// of which nine crowd together, the second place goes to the one that stands alone, though it is the
// lightest; and when those in between would gain too little, they stay out.
TEST(ActivateDiscontinuities, NeighboursTakeWeight) {
  const QuarteredSquare square;
  DiscontinuityOptions options = ByIrradiance(2);
  std::vector<Discontinuity> found;
  for (int i = 0; i < 9; ++i)
    found.push_back(Kink({0.1 + 0.001 * i, 0.05}, {0.1 + 0.001 * i, 0.45}, 10 + i, i));
  found.push_back(Kink({0.35, 0.05}, {0.35, 0.45}, 5, 9));
  PatchDSets dsets = ActivateDiscontinuities(square.forest, 0, found, options);
  ASSERT_EQ(dsets.lines.size(), 2U);
  EXPECT_NEAR(dsets.lines[0].origin.x(), 0.108, 1e-12);
  EXPECT_NEAR(dsets.lines[1].origin.x(), 0.35, 1e-12);
  // The crowd is 0.008 wide: what is left out of it costs some 18 x 0.008 at most.
  options.max_leaf_dsets = 10;
  options.min_weight = 18 * 0.008;
  EXPECT_EQ(ActivateDiscontinuities(square.forest, 0, found, options).activated, 2U);
  options.min_weight = 0;
  EXPECT_EQ(ActivateDiscontinuities(square.forest, 0, found, options).activated, 10U);
}

// Jumps along one line add up with their signs: a dozen edges, each too light to count, count together where
// they overlap, and cancel where half of them jump the other way; one event found twice is one.
TEST(ActivateDiscontinuities, JumpsOnALineAddUp) {
  const QuarteredSquare square;
  DiscontinuityOptions options = ByIrradiance(1);
  const auto lines = [&](double sign, bool one_event) {
    std::vector<Discontinuity> found = {Kink({0.1, 0.05}, {0.1, 0.45}, 4, 100)};
    for (int i = 0; i < 12; ++i)
      found.push_back(Kink({0.3, 0.05 + 0.001 * i}, {0.3, 0.45}, i % 2 == 0 ? 1 : sign, one_event ? 0 : i));
    return found;
  };
  const auto first_at = [&](const std::vector<Discontinuity>& found) {
    const PatchDSets dsets = ActivateDiscontinuities(square.forest, 0, found, options);
    return dsets.lines.size() == 1 ? dsets.lines[0].origin.x() : -1;
  };
  EXPECT_NEAR(first_at(lines(1, false)), 0.3, 1e-12);
  EXPECT_NEAR(first_at(lines(-1, false)), 0.1, 1e-12);
  EXPECT_NEAR(first_at(lines(1, true)), 0.1, 1e-12);
}

// What leaving a line out costs is the root mean square over the leaves that it crosses: the same kink weighs
// as much in one leaf as in two of the same size.
TEST(ActivateDiscontinuities, WeighsByTheMeanSquare) {
  const QuarteredSquare square;
  // Across the middle of leaves of side 1/2, a kink of 1 W/m^2 per metre.
  const double one = kKinkError * 0.5;
  for (const double end : {0.45, 0.95})
    for (const double factor : {0.999, 1.001}) {
      DiscontinuityOptions options = ByIrradiance(10);
      options.min_weight = factor * one;
      const std::vector<Discontinuity> found = {Kink({0.05, 0.25}, {end, 0.25}, 1, 0)};
      EXPECT_EQ(ActivateDiscontinuities(square.forest, 0, found, options).activated, factor < 1 ? 1U : 0U);
    }
}

// What is too light is told, leaf by leaf, and becomes active when it is wanted; not where it would crowd a
// leaf, nor where it weighs less than refinement may ask for.
TEST(ActivateDiscontinuities, WantedOnesNeedNoWeight) {
  const QuarteredSquare square;
  DiscontinuityOptions options = ByIrradiance(2);
  options.min_weight = 1;
  options.min_wanted_weight = 0.01;
  std::vector<Discontinuity> found = {Kink({0.25, 0.05}, {0.25, 0.45}, 100, 0),
                                      Kink({0.05, 0.25}, {0.95, 0.25}, 1, 1),
                                      Kink({0.05, 0.75}, {0.45, 0.75}, 1e-3, 2)};
  PatchDSets dsets = ActivateDiscontinuities(square.forest, 0, found, options);
  EXPECT_EQ(dsets.activated, 1U);
  ASSERT_EQ(dsets.omitted.size(), 1U);
  const OmittedDiscontinuity& omitted = dsets.omitted[0];
  EXPECT_EQ(omitted.number, 1U);
  EXPECT_EQ(omitted.leaves, 2U);
  ASSERT_EQ(omitted.parts.size(), 2U);
  for (const OmittedPart& part : omitted.parts) {
    EXPECT_DOUBLE_EQ(part.jump.kink.gradient, 1);
    EXPECT_LE(std::abs(part.to.x() - part.from.x()), 0.5);
  }
  // On a triangle half of which it cuts off.
  const Polygon2 triangle = {{0.5, 0}, {1, 0}, {0.5, 0.5}};
  EXPECT_DOUBLE_EQ(ErrorOnPiece(omitted.parts[1], triangle), kKinkError * 0.5);

  found[1].wanted = true;
  dsets = ActivateDiscontinuities(square.forest, 0, found, options);
  EXPECT_EQ(dsets.activated, 2U);
  EXPECT_TRUE(dsets.omitted.empty());
  TriangulateLeaves(square.forest, 0, dsets).Validate(square.scene.patches[0]);

  found[1].wanted = false;
  options.max_leaf_dsets = 1;
  EXPECT_TRUE(ActivateDiscontinuities(square.forest, 0, found, options).omitted.empty());
}

// An error counts as often as its leaf says: of two equal kinks the one in the dark goes first, and alone
// weighs enough.
TEST(ActivateDiscontinuities, ErrorsCountBesideTheLight) {
  const QuarteredSquare square;
  DiscontinuityOptions options = ByIrradiance(10);
  const std::vector<Discontinuity> found = {Kink({0.05, 0.25}, {0.45, 0.25}, 1, 0),
                                            Kink({0.55, 0.75}, {0.95, 0.75}, 1, 1)};
  // Leaves begin at the corner (0, 0).
  const ElementId dark = square.forest[ElementForest::Root(0)].first_child + 2;
  const ErrorScale scale = [&](ElementId leaf) { return leaf == dark ? 3.0 : 1.0; };
  const PatchDSets both = ActivateDiscontinuities(square.forest, 0, found, options, {.scale = scale});
  ASSERT_EQ(both.lines.size(), 2U);
  EXPECT_NEAR(both.lines[0].origin.y(), 0.75, 1e-12);
  options.min_weight = 2 * kKinkError * 0.5;
  EXPECT_EQ(ActivateDiscontinuities(square.forest, 0, found, options, {.scale = scale}).activated, 1U);
  EXPECT_EQ(ActivateDiscontinuities(square.forest, 0, found, options).activated, 0U);
}

// Where lines compete for a leaf's room, an error counts as often as its place says; elsewhere nobody asks.
TEST(ActivateDiscontinuities, InCrowdsErrorsCountByPlaces) {
  const QuarteredSquare square;
  const std::vector<Discontinuity> found = {Kink({0.05, 0.1}, {0.45, 0.1}, 2, 0),
                                            Kink({0.05, 0.3}, {0.45, 0.3}, 1, 1),
                                            Kink({0.55, 0.75}, {0.95, 0.75}, 1, 2)};
  int asked = 0;
  const PlaceScale dark_above = [&](ElementId leaf, const Vec2& place) {
    ++asked;
    EXPECT_EQ(leaf, square.forest[ElementForest::Root(0)].first_child);
    EXPECT_NEAR(place.x(), 0.25, 1e-12);
    return place.y() > 0.2 ? 10.0 : 1.0;
  };
  const auto lowest = [&](int room, const PlaceScale& at_place) {
    const PatchDSets dsets =
        ActivateDiscontinuities(square.forest, 0, found, ByIrradiance(room), {.at_place = at_place});
    double y = 1;
    for (const DiscontinuityLine& line : dsets.lines) y = std::min(y, line.origin.y());
    return y;
  };
  EXPECT_NEAR(lowest(1, {}), 0.1, 1e-12);
  EXPECT_NEAR(lowest(1, dark_above), 0.3, 1e-12);
  EXPECT_EQ(asked, 2);
  EXPECT_NEAR(lowest(2, dark_above), 0.1, 1e-12);
  EXPECT_EQ(asked, 2);
  // What weighs enough for the leaf as a whole is tried, however bright it is where it lies.
  DiscontinuityOptions options = ByIrradiance(1);
  options.min_weight = kKinkError * 0.1;
  const PlaceScale bright = [](ElementId, const Vec2&) { return 1e-3; };
  EXPECT_EQ(ActivateDiscontinuities(square.forest, 0, found, options, {.at_place = bright}).activated, 2U);
}

// The sums hold place by place, turned round or not, and those of second degree keep their sense.
TEST(LineJumps, AddUpPlaceByPlace) {
  const std::vector<DiscontinuityLine> lines = {{{{0, 0}, {1, 0}}, {}, {}}};
  const auto bend = [](double from, double to, double curvature) {
    Discontinuity d = Segment({from, 0}, {to, 0}, 0);
    d.strength = 2;
    for (IrradianceJump& jump : d.jump) jump = {0, curvature, 1, 1};
    return d;
  };
  const std::vector<Discontinuity> found = {bend(0, 3, 1), bend(4, 1, 10), Kink({2, 0}, {6, 0}, 5, 7),
                                            Kink({5, 0}, {3, 0}, 5, 7), Kink({2, 0}, {3, 0}, 1, 8)};
  const LineJumps jumps(found, std::vector<std::int32_t>(found.size(), 0), lines);
  const std::vector<std::array<double, 3>> want = {
      // place, curvature, gradient
      {-0.5, 0, 0}, {0.5, 2, 0}, {1.5, -18, 0}, {2.5, -18, 6}, {3.5, -20, 5}, {5.5, 0, 5}, {6.5, 0, 0}};
  for (const auto& [at, curvature, gradient] : want) {
    EXPECT_DOUBLE_EQ(jumps.At(0, at).bend.curvature, curvature) << at;
    EXPECT_DOUBLE_EQ(jumps.At(0, at).kink.gradient, gradient) << at;
  }
}

// Which discontinuities lie on one line does not depend on the unit of length, nor on where the scene lies:
// the light of the floating cube and of the blind, scaled and moved, is divided along as many lines, leaf by
// leaf.
TEST(ActivateDiscontinuities, LinesDoNotDependOnScaleOrPlace) {
  struct Change {
    double scale;
    Vec3 move;  // in units of the scaled scene
  };
  std::vector<Change> changes = {{1, Vec3::Zero()}};
  for (int power = -6; power <= 6; ++power) {
    changes.push_back({std::pow(10.0, power), Vec3::Zero()});
    changes.push_back({1.7 * std::pow(10.0, power), Vec3(1e2, -3e3, 7e2)});
  }
  changes.push_back({1, Vec3(1e5, 1e5, -3e4)});
  for (const char* name : {"floating-cube", "blind"}) {
    std::vector<std::vector<std::size_t>> counts;
    for (const Change& change : changes) {
      Scene scene = *LoadBuiltinScene(name, {});
      for (Patch& patch : scene.patches) {
        std::vector<Vec3> vertices;
        for (const Vec3& v : patch.Vertices()) vertices.push_back(change.scale * (v + change.move));
        patch = MakePatch(vertices, patch.material, patch.object, patch.faces);
      }
      std::vector<double> strength;
      for (const Patch& patch : scene.patches)
        strength.push_back(scene.materials[patch.material].emittance.maxCoeff());
      const PatchVisibility visibility(scene);
      const DiscontinuityFinder finder(scene, visibility);
      ElementForest forest(scene);
      DiscontinuityOptions options;
      options.choice = "all";
      std::vector<std::size_t>& count = counts.emplace_back();
      for (PatchId p = 0; p < static_cast<PatchId>(scene.patches.size()); ++p) {
        for (const ElementId leaf : forest.Leaves(p)) forest.Subdivide(leaf);
        const PatchDSets dsets =
            ActivateDiscontinuities(forest, p, finder.Find(p, strength, options), options);
        count.push_back(dsets.activated);
        count.push_back(dsets.lines.size());
        count.push_back(dsets.most_merged);
        for (const auto& lines : dsets.leaf_lines) count.push_back(lines.size());
        TriangulateLeaves(forest, p, dsets).Validate(scene.patches[p]);
      }
      EXPECT_EQ(count, counts.front()) << name << " x " << change.scale << " + " << change.move.transpose();
    }
    std::size_t sum = 0;
    for (const std::size_t n : counts.front()) sum += n;
    EXPECT_GT(sum, 100U) << name;
  }
}

// Switched off, nothing is active.
TEST(ActivateDiscontinuities, CanBeSwitchedOff) {
  const QuarteredSquare square;
  DiscontinuityOptions options;
  options.choice = "none";
  const PatchDSets dsets =
      ActivateDiscontinuities(square.forest, 0, std::vector{Segment({0.1, 0.2}, {0.4, 0.5}, 1)}, options);
  EXPECT_TRUE(dsets.lines.empty());
  EXPECT_EQ(dsets.leaves.size(), 4U);
}

}  // namespace
}  // namespace penumbra
