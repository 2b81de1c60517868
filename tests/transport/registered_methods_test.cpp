// Methods that a program adds to the registries solve like those of the library.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "solver/transport/links/refinement_oracles.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra::scene_test {
namespace {

constexpr double kLargestReceiver = 0.3;  // [m^2] that the toy oracle leaves whole

class AreaOracle final : public RefinementOracle {
 public:
  Refinement Judge(const RadiositySolution& solution, const Link& link) const override {
    return solution.forest[link.receiver].area > kLargestReceiver ? Refinement::kSplitReceiver
                                                                  : Refinement::kAccept;
  }
};

// As within a sphere: every receiver gets from each source by its area alone. It needs no cubature.
class SphereLinkFormFactor final : public LinkFormFactorMethod {
 public:
  void Find(ReceiverLinks* links, const ExecutionContext&) const override {
    double area = 0;
    for (const Link& link : links->set.links) area += links->forest[link.source].area;
    for (Link& link : links->set.links) link.form_factor = links->forest[link.source].area / area;
  }
};

// Adds the toys to the registries of this program, once.
void AddToys() {
  static const bool added = [] {
    RefinementOracles().Add({"by-area", "splits receivers that are large", {}, [](const OracleOptions&) {
                               return std::make_unique<const AreaOracle>();
                             }});
    LinkFormFactorMethods().Add({"sphere", "as within a sphere", {}, [](const LinkFormFactorOptions&) {
                                   return std::make_unique<const SphereLinkFormFactor>();
                                 }});
    return true;
  }();
  EXPECT_TRUE(added);
}

// In a closed room of one material every radiosity is E / (1 - rho), if the factors of each receiver add up
// to 1: toys that know nothing of geometry find it, with the elements that the toy oracle asks for.
TEST(RegisteredMethods, ToysSolveAFurnace) {
  AddToys();
  Scene scene;
  AddMaterial(scene, 0.5, 3);
  AddBox(scene, Vec3::Zero(), Vec3::Ones(), true, 0);
  const PatchVisibility visibility(scene);
  SolverOptions options;
  options.relative_cutoff = 1e-9;
  options.max_corrections = 0;
  options.oracle = "by-area";
  options.form_factors = "sphere";
  HierarchicalSolver solver(scene, visibility, options);
  solver.Solve({});
  EXPECT_TRUE(solver.Converged());
  const RadiositySolution& solution = solver.solution();
  EXPECT_EQ(solution.forest.size(), 6U * 5) << "every face is split once";
  for (const Rgb& radiosity : solution.radiosity) EXPECT_NEAR(radiosity[0], 6, 1e-7);
}

// The names are listed in order, the default first, each with a line of help; others are refused with the
// list.
TEST(RegisteredMethods, NamesAreListedAndOthersRefused) {
  const auto expect = [](const auto& registry, const std::vector<std::string>& first) {
    const std::vector<std::string> names = registry.Names();
    ASSERT_GE(names.size(), first.size());
    EXPECT_TRUE(std::equal(first.begin(), first.end(), names.begin()));
    for (const auto& method : registry.methods()) {
      EXPECT_FALSE(method.help.empty());
      EXPECT_NE(method.make({}), nullptr);
    }
    try {
      registry.Find("guess");
      ADD_FAILURE() << "a method that does not exist was found";
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find(registry.kind() + " is called 'guess'"), std::string::npos) << text;
      for (const std::string& name : names) EXPECT_NE(text.find(name), std::string::npos) << text;
    }
  };
  expect(RefinementOracles(), {"transport", "visibility", "gradient", "thesis"});
  expect(LinkFormFactorMethods(), {"cubature", "exact", "disk"});
}

// A solver refuses options that name a method that does not exist.
TEST(RegisteredMethods, SolverRefusesUnknownNames) {
  Scene scene;
  AddMaterial(scene, 0.5, 3);
  AddBox(scene, Vec3::Zero(), Vec3::Ones(), true, 0);
  const PatchVisibility visibility(scene);
  SolverOptions oracle, form_factors;
  oracle.oracle = "guess";
  form_factors.form_factors = "guess";
  EXPECT_THROW(HierarchicalSolver(scene, visibility, oracle), InputError);
  EXPECT_THROW(HierarchicalSolver(scene, visibility, form_factors), InputError);
}

}  // namespace
}  // namespace penumbra::scene_test
