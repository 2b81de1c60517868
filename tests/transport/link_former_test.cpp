// Links: factors, blockers, shares.

#include "solver/transport/links/link_former.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <string>

#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra::scene_test {
namespace {

struct Roots {
  ElementForest forest;
  PatchVisibility visibility;

  explicit Roots(const Scene& scene) : forest(scene), visibility(scene) {}

  LinkSet Form(PatchId receiver, const std::string& form_factors = "cubature") const {
    std::vector<LinkCandidate> candidates;
    for (const PatchPair& pair : visibility.SourcesOf(receiver))
      candidates.push_back({ElementForest::Root(pair.source), visibility.Blockers(pair)});
    return FormLinks(forest, ElementForest::Root(receiver), candidates,
                     *LinkFormFactorMethods().Make(form_factors, {}));
  }
};

// The links of opposite and of adjacent faces of the unit cube have the known factors. 1e-4 for opposite
// faces (4 Gauss points); 2e-3 for adjacent ones, whose factors bend at the common edge.
TEST(FormLinks, UnitCube) {
  Scene scene;
  AddMaterial(scene, 0.5, 0);
  AddBox(scene, Vec3::Zero(), Vec3::Ones(), true, 0);
  const Roots roots(scene);
  for (PatchId p = 0; p < 6; ++p) {
    const LinkSet set = roots.Form(p);
    ASSERT_EQ(set.links.size(), 5U);
    for (const Link& link : set.links) {
      const bool opposite = (link.source ^ 1) == link.receiver;
      EXPECT_NEAR(link.form_factor, opposite ? 0.199824895698387 : 0.200043776075403, opposite ? 5e-4 : 3e-3);
      EXPECT_EQ(link.visibility, Visibility::kVisible);
    }
  }
}

// A far square is a disk but for the square of its size over the distance, and a board that hides half of it
// from the receiver's centre leaves half the factor.
TEST(FormLinks, Disks) {
  constexpr double kDistance = 10;
  Scene scene;
  AddMaterial(scene, 0.5, 1);
  Add(scene, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0);
  Add(scene, {{0, 0, kDistance}, {0, 1, kDistance}, {1, 1, kDistance}, {1, 0, kDistance}}, 0);
  const double disk = 1 / (std::numbers::pi * kDistance * kDistance + 1);
  const LinkSet clear = Roots(scene).Form(0, "disk");
  ASSERT_EQ(clear.links.size(), 1U);
  EXPECT_NEAR(clear.links[0].form_factor, disk, 1e-15);
  EXPECT_NEAR(clear.links[0].form_factor, Roots(scene).Form(0).links[0].form_factor,
              disk / kDistance / kDistance);

  Add(scene, {{0.5, -2, 5}, {3, -2, 5}, {3, 3, 5}, {0.5, 3, 5}}, 0);
  const LinkSet half = Roots(scene).Form(0, "disk");
  const auto link = std::find_if(half.links.begin(), half.links.end(),
                                 [](const Link& l) { return l.source == ElementForest::Root(1); });
  ASSERT_NE(link, half.links.end());
  EXPECT_NEAR(link->form_factor, 0.5 * disk, 1e-15);
}

// In closed rooms the factors of a patch's links add up to 1, and those of a pair are reciprocal: A F = A'
// F', both within the error of the cubature at the roots (2 %, and 3 % of the larger patch's share).
TEST(FormLinks, ClosureAndReciprocity) {
  Random random(901);
  double closure = 0, reciprocity = 0;
  for (int i = 0; i < 20; ++i) {
    Scene scene;
    AddMaterial(scene, 0.5, 0);
    AddBox(scene, Vec3::Zero(), {random.Uniform(1, 3), random.Uniform(1, 3), random.Uniform(1, 3)}, true, 0);
    scene = Mapped(scene, RandomMotion(random, 3));
    const Roots roots(scene);
    std::map<std::pair<ElementId, ElementId>, double> flux;
    for (PatchId p = 0; p < 6; ++p) {
      double sum = 0;
      for (const Link& link : roots.Form(p).links) {
        sum += link.form_factor;
        flux[{link.receiver, link.source}] = link.form_factor * roots.forest[link.receiver].area;
      }
      closure = std::max(closure, std::abs(sum - 1));
    }
    for (const auto& [pair, value] : flux) {
      const double back = flux.at({pair.second, pair.first});
      reciprocity = std::max(reciprocity, std::abs(value - back) / std::max(value, back));
    }
  }
  std::printf("seed 901, closure %.2g, reciprocity %.2g\n", closure, reciprocity);
  EXPECT_LE(closure, 0.02);
  EXPECT_LE(reciprocity, 0.1);
}

// Shares add up to 1; factors lie in [0, 1]; the blockers of children are among their parents'; averaged over
// children, factors are their parent's within the cubature's error; and children of a source that has no link
// have none.
TEST(FormLinks, ChildrenAgreeWithParents) {
  Random random(902);
  double worst = 0;
  int links = 0;
  for (int i = 0; i < 6; ++i) {
    Scene scene = FurnishedRoom(random, 3);
    if (i % 2 == 1) scene = Mapped(scene, RandomMotion(random, 5));
    Roots roots(scene);
    const auto count = static_cast<PatchId>(scene.patches.size());
    for (PatchId p = 0; p < count; ++p) roots.forest.Subdivide(ElementForest::Root(p));
    for (PatchId p = 0; p < count; ++p) {
      const LinkSet set = roots.Form(p);
      for (const Link& link : set.links) {
        EXPECT_GE(link.form_factor, 0);
        EXPECT_LE(link.form_factor, 1);
        double shares = 0;
        for (const float share : link.share) shares += static_cast<double>(share);
        EXPECT_NEAR(shares, 1, 4e-7) << "four roundings of floats";
        const std::span<const PatchId> blockers = set.Blockers(link);
        EXPECT_EQ(link.visibility == Visibility::kVisible, blockers.empty());
        double mean = 0;
        const Element receiver = roots.forest[link.receiver];
        for (ElementId child = receiver.first_child; child < receiver.first_child + 4; ++child) {
          const LinkCandidate candidate{link.source, blockers};
          const LinkSet below =
              FormLinks(roots.forest, child, {&candidate, 1}, *LinkFormFactorMethods().Make("cubature", {}));
          ASSERT_LE(below.links.size(), 1U);
          for (const Link& part : below.links) {
            mean += part.form_factor * roots.forest[child].area / receiver.area;
            for (const PatchId blocker : below.Blockers(part))
              EXPECT_NE(std::find(blockers.begin(), blockers.end(), blocker), blockers.end());
          }
        }
        worst = std::max(worst, std::abs(mean - link.form_factor));
        ++links;
      }
    }
  }
  std::printf("seed 902, %d links, largest difference %.2g\n", links, worst);
  EXPECT_LE(worst, 0.1);
}

}  // namespace
}  // namespace penumbra::scene_test
