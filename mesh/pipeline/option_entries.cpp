// The table of options, one entry after another.

#include "mesh/pipeline/option_entries.h"

#include <algorithm>
#include <limits>

#include "mesh/discontinuities/discontinuity_choices.h"
#include "mesh/pipeline/thesis_options.h"
#include "solver/base/check.h"
#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "solver/transport/links/refinement_oracles.h"
#include "solver/transport/solvers/light_solvers.h"
#include "solver/visibility/exact/occlusion_methods.h"

namespace penumbra {
namespace {

using Entries = std::vector<SolveOption>;

constexpr const char* kFollows = "follows from --error";
constexpr NumberRange kPositive{kTiniestOption, kLargestOption}, kNonNegative{0, kLargestOption},
    kShare{0, 1};
// The accuracy of the light is about 1e-6 at best, because of rounding in rays and samples.
constexpr NumberRange kRelativeError{1e-6, 10};
constexpr NumberRange kCutoff{1e-15, 1};
// The distance between a polyline and its curve [m]: below a nanometre, the number of pieces would be
// unlimited.
constexpr NumberRange kPolyline{1e-9, 1e9, true};
constexpr NumberRange kSeconds{1e-9, 1e9}, kBytes{1, 1e18};
constexpr std::uint64_t kMostErrorSamples = 100, kMostErrorPoints = 100'000'000, kMostLines = 1'000'000,
                        kMostDivisions = 64, kMostIterations = 1'000'000, kMostCorrections = 100,
                        kMostBounces = 1000, kMostRays = kMostRaysPerPoint, kMostShots = 1'000'000,
                        kMostCrowdedSplits = 20;

NamedValues<DiscontinuityWeight> WeightsOfDiscontinuities() {
  return {{"thesis", DiscontinuityWeight::kThesis}, {"irradiance", DiscontinuityWeight::kIrradiance}};
}

NamedValues<BasisDegree> Bases() {
  return {{"constant", BasisDegree::kConstant},
          {"linear", BasisDegree::kLinear},
          {"quadratic", BasisDegree::kQuadratic}};
}

NamedValues<RefineBy> Refinements() {
  return {{"transport", RefineBy::kTransport},
          {"representation", RefineBy::kRepresentation},
          {"both", RefineBy::kBoth}};
}

NamedValues<IterationScheme> Schemes() {
  return {{"jacobi", IterationScheme::kJacobi}, {"gauss-seidel", IterationScheme::kGaussSeidel}};
}

// The option for the acceleration of sweeps: a flag, because there is one method.
OptionField AccelerationField() {
  OptionField field = MakeField(
      OptionKind::kFlag, &PipelineOptions::acceleration,
      [](Acceleration held) { return OptionValue(held == Acceleration::kAnderson); },
      [](const OptionValue& value) {
        return std::get<bool>(value) ? Acceleration::kAnderson : Acceleration::kNone;
      });
  field.choices = [] { return std::vector<std::string>{"none", "anderson"}; };
  return field;
}

// The registries begin with so many methods that are meant for use.
constexpr std::size_t kUsualFormFactors = 2, kUsualSolvers = 3;

// The methods of a registry behind the first `usual` ones serve only to compare.
template <class Methods>
std::vector<StudyChoice> StudyChoicesOf(const Methods& registry, std::size_t usual) {
  std::vector<StudyChoice> choices;
  for (std::size_t i = usual; i < registry.methods().size(); ++i)
    choices.push_back({registry.methods()[i].name, registry.methods()[i].help});
  return choices;
}

void AddErrors(Entries& table) {
  table.push_back(
      {.name = "seed",
       .field = IntegerField(&PipelineOptions::seed, {0, std::numeric_limits<std::uint64_t>::max()}),
       .group = OptionGroup::kRunning,
       .help = "Seed of everything that is drawn at random",
       .label = "Seed of what is drawn at random"});
  table.push_back({.name = "error",
                   .field = NumberField(&PipelineOptions::error, kRelativeError),
                   .help =
                       "The relative error of what is shown that 99 points in 100 shall not exceed; all else "
                       "follows from it unless it is given",
                   .label = "Error of what is shown, relative"});
  // Before the options that it sets, so that those given by themselves win.
  table.push_back({.name = "as-thesis",
                   .field = AsThesisField(),
                   .group = OptionGroup::kSolving,
                   .solver = "hierarchical",
                   .help =
                       "Everything as in the thesis, with the settings of its office; options that are given "
                       "beside it have precedence",
                   .in_older_files = [](const PipelineOptions&) { return OptionValue(false); },
                   .label = "As in the thesis"});
  table.push_back({.name = "eps",
                   .field = NumberField(&PipelineOptions::eps, kPositive),
                   .unit = "W/m^2",
                   .group = OptionGroup::kHierarchical,
                   .links_depend = true,
                   .otherwise = kFollows,
                   .help = "Largest transport error of a link, in its largest channel",
                   .resolved = [](const ResolvedOptions& r) { return OptionValue(r.solver.eps); },
                   .label = "Max error of a link"});
  table.push_back({.name = "min-area",
                   .field = NumberField(&PipelineOptions::min_area, kNonNegative),
                   .unit = "m^2",
                   .otherwise = kFollows,
                   .help = "Smallest area of an element",
                   .resolved = [](const ResolvedOptions& r) { return OptionValue(r.solver.min_area); },
                   .label = "Min area of an element"});
}

NamedValues<EmitterUnit> EmitterUnits() {
  return {
      {"face", EmitterUnit::kFace}, {"object", EmitterUnit::kObject}, {"material", EmitterUnit::kMaterial}};
}

void AddEmitters(Entries& table) {
  table.push_back({.name = "by-emitter",
                   .field = FlagField(&PipelineOptions::by_emitter),
                   .help =
                       "Keep the light of each emitter by itself in the solution, so that --dim scales it "
                       "afterwards without a solve",
                   .in_older_files = [](const PipelineOptions&) { return OptionValue(false); },
                   .label = "Keep the light of each emitter"});
  table.push_back({.name = "emitters",
                   .field = ChoiceField(&PipelineOptions::emitter_unit, EmitterUnits()),
                   .help =
                       "What counts as one emitter for --by-emitter: a face, all emitting faces of an object "
                       "or group, or all of a material; time and memory grow with their number",
                   .in_older_files = [](const PipelineOptions&) { return OptionValue("face"); },
                   .label = "What counts as one emitter"});
}

void AddChoiceOfDiscontinuities(Entries& table) {
  table.push_back(
      {.name = "discontinuities",
       .field = NameField(&PipelineOptions::discontinuities, DiscontinuityChoices()),
       .group = OptionGroup::kMesh,
       .help = "Which discontinuities become edges of the mesh, as many as a leaf may have: the heaviest "
               "(ranked), "
               "those where a shadow boundary is seen to cross a leaf (adaptive, Stuerzlinger 1994), or none",
       .study_choices = {{"random",
                          "Edges of the mesh are discontinuities in random order, as many as a leaf may "
                          "have"},
                         {"all", "Edges of the mesh are all discontinuities"}},
       .in_older_files = [](const PipelineOptions&) { return OptionValue("ranked"); },
       .label = "Discontinuities in the mesh",
       .setting = "mesh-discontinuities"});
  table.push_back(
      {.name = "weight",
       .field = ChoiceField(&PipelineOptions::weight, WeightsOfDiscontinuities()),
       .group = OptionGroup::kMesh,
       .otherwise = "thesis where --min-discontinuity-weight is given, else irradiance",
       .help = "What a discontinuity weighs, in W/m^2: the error that a leaf would make without it",
       .study_choices = {{"thesis",
                          "A discontinuity weighs how near its blocker is times the source's radiosity"}},
       .resolved =
           [](const ResolvedOptions& r) {
             return OptionValue(NameAmong(WeightsOfDiscontinuities(), r.discontinuities.weight));
           },
       .in_older_files = [](const PipelineOptions&) { return OptionValue("thesis"); },
       .label = "Weight of discontinuities"});
}

void AddWeights(Entries& table) {
  table.push_back(
      {.name = "min-discontinuity-weight",
       .field = NumberField(&PipelineOptions::min_discontinuity_weight, kNonNegative),
       .unit = "W/m^2",
       .group = OptionGroup::kMesh,
       .otherwise = kFollows,
       .help = "Smallest weight of a discontinuity in the mesh",
       .resolved = [](const ResolvedOptions& r) { return OptionValue(r.discontinuities.min_weight); },
       .label = "Minimum discontinuity weight"});
  table.push_back(
      {.name = "min-wanted-weight",
       .field = NumberField(&PipelineOptions::min_wanted_weight, kNonNegative),
       .unit = "W/m^2",
       .group = OptionGroup::kMesh,
       .otherwise = "follows from --error; none where the smallest weight is given",
       .help = "Least error on a leaf for whose sake refinement may ask for a discontinuity, where that "
               "mends more "
               "than dividing leaves; it begins with those of twice the smallest weight",
       .resolved = [](const ResolvedOptions& r) { return OptionValue(r.discontinuities.min_wanted_weight); },
       // Older versions did not request discontinuities in refinement.
       .in_older_files =
           [](const PipelineOptions& before) { return OptionValue(*before.min_discontinuity_weight); },
       .label = "Minimum weight that refinement may want"});
}

void AddMesh(Entries& table) {
  table.push_back({.name = "corner-divisions",
                   .field = IntegerField(&PipelineOptions::corner_divisions, {0, kMostCornerDivisions}),
                   .group = OptionGroup::kStudies,
                   .help = "Divide leaves of the mesh so many times towards the ends of contact edges",
                   .in_older_files = [](const PipelineOptions&) { return OptionValue(std::uint64_t{0}); },
                   .label = "Divisions towards ends of contacts"});
  table.push_back({.name = "max-leaf-dsets",
                   .field = IntegerField(&PipelineOptions::max_leaf_dsets, {0, kMostLines}),
                   .group = OptionGroup::kMesh,
                   .help = "Most discontinuity lines in a leaf of the mesh",
                   .label = "Max leaf discontinuity segments"});
  table.push_back(
      {.name = "keep-hidden-discontinuities",
       .field = FlagField(&PipelineOptions::keep_hidden_discontinuities),
       .group = OptionGroup::kStudies,
       .help = "Also those parts of discontinuities that end at another blocker on their way, as in the "
               "thesis",
       .in_older_files = [](const PipelineOptions&) { return OptionValue(false); },
       .label = "Hidden discontinuities, too"});
  table.push_back(
      {.name = "eee",
       .field = NumberField(&PipelineOptions::triple_edge_tolerance, kPolyline),
       .unit = "m",
       .group = OptionGroup::kMesh,
       .help = "Also triple-edge (EEE) discontinuities, as polylines that keep within this distance of "
               "them; 0: none, as in the thesis",
       .in_older_files = [](const PipelineOptions&) { return OptionValue(0.0); },
       .label = "Triple-edge discontinuities, 0: none; within"});
  table.push_back(
      {.name = "error-samples",
       .field = IntegerField(&PipelineOptions::error_samples, {1, kMostErrorSamples}),
       .group = OptionGroup::kMesh,
       .help = "Measure a triangle of the mesh at N x N points to decide whether it is fine enough",
       .label = "Error samples a side of a triangle"});
}

void AddRefinement(Entries& table) {
  table.push_back(
      {.name = "refine",
       .field = ChoiceField(&PipelineOptions::refine, Refinements()),
       .help = "Refine by the error of links alone (transport), by that of what is shown over a coarse "
               "solution (representation), or by both",
       .label = "Refine by"});
  table.push_back(
      {.name = "corrections",
       .field = IntegerField(&PipelineOptions::max_corrections, {0, kMostCorrections}),
       .group = OptionGroup::kHierarchical,
       .help = "Passes that correct the converged solution by exact irradiance; 0: links alone, as in the "
               "thesis",
       .label = "Corrections by exact irradiance"});
  table.push_back(
      {.name = "source-error",
       .field = NumberField(&PipelineOptions::source_error, kRelativeError),
       .group = OptionGroup::kHierarchical,
       .otherwise = "the mesh cuts them",
       .help = "The corrections cut sources into strips and pieces until constant light on each errs by "
               "about this much, relative, where it arrives; grades them towards edges where walls meet",
       .label = "Error of sources cut by corrections, relative"});
}

void AddSweeps(Entries& table) {
  table.push_back({.name = "acceleration",
                   .field = AccelerationField(),
                   .group = OptionGroup::kStudies,
                   .flag_clears = true,
                   .help = "Sweep after sweep, as in the thesis, instead of guessing ahead (Anderson 1965)",
                   .label = "Guess ahead between sweeps"});
  table.push_back({.name = "scheme",
                   .field = ChoiceField(&PipelineOptions::scheme, Schemes()),
                   .group = OptionGroup::kStudies,
                   .help =
                       "Order of a sweep: all elements from the light before it (the thesis), or patch after "
                       "patch, each from the light as it is then",
                   .label = "Sweeps"});
}

void AddLinks(Entries& table) {
  table.push_back(
      {.name = "oracle",
       .field = NameField(&PipelineOptions::oracle, RefinementOracles()),
       .group = OptionGroup::kHierarchical,
       .links_depend = true,
       .help = "What splits links: their transport error, by its deviation over the receiver; the same, "
               "partial links counting twice; or by the gradient of the form factor",
       .study_choices = {{"thesis",
                          "What splits links is their error as printed in the thesis, without "
                          "regard to area"}},
       .label = "Refinement of links"});
  table.push_back({.name = "multigrid",
                   .field = FlagField(&PipelineOptions::multigrid),
                   .group = OptionGroup::kHierarchical,
                   .links_depend = true,
                   .help = "Refine by a larger --eps first, lowered from one iteration to the next",
                   .label = "Coarse links first"});
}

void AddEndsOfIteration(Entries& table) {
  table.push_back({.name = "relative-cutoff",
                   .field = NumberField(&PipelineOptions::relative_cutoff, kCutoff),
                   .group = OptionGroup::kHierarchical,
                   .otherwise = kFollows,
                   .help = "Iterate until no radiosity is farther off, relative to the largest",
                   .resolved = [](const ResolvedOptions& r) { return OptionValue(r.solver.relative_cutoff); },
                   .label = "Relative error cutoff"});
  table.push_back({.name = "iterations",
                   .field = IntegerField(&PipelineOptions::max_iterations, {1, kMostIterations}),
                   .group = OptionGroup::kHierarchical,
                   .links_depend = true,
                   .help = "Most iterations of gathering and refining",
                   .label = "Most iterations"});
}

void AddLimits(Entries& table) {
  table.push_back(
      {.name = "time-limit",
       .field = NumberField(&PipelineOptions::time_limit, kSeconds),
       .unit = "s",
       .otherwise = "none",
       .help = "End the work after this time, reading included, with the last whole step's light, its "
               "mesh without refining it, and no more measured than there was time for",
       .label = "Time limit"});
  table.push_back({.name = "memory-limit",
                   .field = NumberField(&PipelineOptions::memory_limit, kBytes),
                   .unit = "bytes",
                   .otherwise = "none",
                   .help = "End the work in the same way when the program takes this much memory",
                   .label = "Memory limit"});
  table.push_back({.name = "bounces",
                   .field = IntegerField(&PipelineOptions::bounces, {0, kMostBounces}),
                   .group = OptionGroup::kHierarchical,
                   .help = "Report the mean irradiance of so many bounces, from the links",
                   .label = "Bounces that are reported"});
}

void AddDistances(Entries& table) {
  table.push_back(
      {.name = "nudge",
       .field = NumberField(
           [](auto& o) -> auto& { return o.point.nudge; }, kNonNegative),
       .unit = "m",
       .group = OptionGroup::kStudies,
       .tiny_distance = true,
       .help = "Move points that ask for a limit this far towards the inside of their triangle, as the "
               "thesis does, instead of taking the limit; 0: limits",
       .label = "Nudge of points in contact"});
  table.push_back(
      {.name = "source-push-off",
       .field = NumberField(
           [](auto& o) -> auto& { return o.point.source_push_off; }, kNonNegative),
       .unit = "m",
       .group = OptionGroup::kStudies,
       .tiny_distance = true,
       .help = "Lift sources this far off each receiver, as the thesis does where they touch it; 0: not",
       .label = "Push-off of sources"});
  table.push_back(
      {.name = "min-backprojection-segment",
       .field = NumberField(
           [](auto& o) -> auto& { return o.point.min_backprojection_segment; }, kShare),
       .group = OptionGroup::kStudies,
       .help =
           "Find shadows at points by backprojection, and collapse segments of a blocker's outline shorter "
           "than "
           "this, relative to the source's diameter as seen, as the thesis does; 0: the fastest exact way",
       .in_older_files = [](const PipelineOptions&) { return OptionValue(0.0); },
       .label = "Shortest segment of backprojections, 0: clip"});
}

OptionField OcclusionField() {
  OptionField field = MakeField(
      OptionKind::kChoice, &PipelineOptions::method,
      [](const std::string& held) { return OptionValue(held); },
      [](const OptionValue& value) {
        const auto& name = std::get<std::string>(value);
        return name == kFastestOcclusion ? name : OcclusionMethods().Find(name).name;
      });
  field.choices = OcclusionNames;
  return field;
}

void AddOcclusion(Entries& table) {
  table.push_back(
      {.name = "method",
       .field = OcclusionField(),
       .group = OptionGroup::kStudies,
       .help =
           "How a solve finds the visible part of a source, for links, corrections and the nodes of the "
           "mesh: auto, the fastest exact way; clipping, backprojection (thesis 6.2) and vertex-tracing "
           "(Stark and Riesenfeld 1999) are exact, too, and take up to a hundred times as long; sampled is "
           "what the thesis gave up",
       .in_older_files = [](const PipelineOptions&) { return OptionValue(std::string(kFastestOcclusion)); },
       .label = "Occlusion"});
}

void AddClassicSolvers(Entries& table) {
  table.push_back({.name = "shots",
                   .field = IntegerField(&PipelineOptions::shots, {0, kMostShots}),
                   .group = OptionGroup::kStudies,
                   .help =
                       "Most steps of a classic solver: shots, sweeps or bundles of rays; 0: until little "
                       "light is left, or 16 bundles",
                   .in_older_files = [](const PipelineOptions&) { return OptionValue(std::uint64_t{0}); },
                   .label = "Most shots, sweeps or bundles"});
  table.push_back({.name = "overshoot",
                   .field = FlagField(&PipelineOptions::overshoot),
                   .group = OptionGroup::kStudies,
                   .help = "Shots anticipate what the shooter will reflect (Shao and Badler 1993)",
                   .in_older_files = [](const PipelineOptions&) { return OptionValue(false); },
                   .label = "Overshooting"});
  table.push_back({.name = "ambient",
                   .field = FlagField(&PipelineOptions::ambient),
                   .group = OptionGroup::kStudies,
                   .help = "Show an estimate of the light that is still to come, spread evenly; the solver "
                           "goes on without it",
                   .in_older_files = [](const PipelineOptions&) { return OptionValue(false); },
                   .label = "Ambient light of what is to come"});
}

void AddSolvers(Entries& table) {
  table.push_back(
      {.name = "form-factors",
       .field = NameField(&PipelineOptions::form_factors, LinkFormFactorMethods()),
       .group = OptionGroup::kHierarchical,
       .links_depend = true,
       .help = "Of links: the mean of exact point factors over a few points of the receiver (cubature); or "
               "between areas to 1e-7, slower, and closed rooms then close (exact)",
       .study_choices = StudyChoicesOf(LinkFormFactorMethods(), kUsualFormFactors),
       .label = "Form factors of links"});
  table.push_back(
      {.name = "solver",
       .field = NameField(&PipelineOptions::solver, LightSolvers()),
       .links_depend = true,
       .otherwise = "hierarchical; sampled where a scene has more than 400 polygons, or more than 150 at "
                    "--error 0.05 or more",
       .help = "How to solve: `hierarchical`; `sampled`, by rays, for scenes of many polygons; or `dense`, "
               "which solves the linear system of a uniform mesh directly with exact form factors: a "
               "reference for small scenes",
       .study_choices = StudyChoicesOf(LightSolvers(), kUsualSolvers),
       .resolved = [](const ResolvedOptions& r) { return OptionValue(r.solver_name); },
       .label = "Solver"});
  table.push_back(
      {.name = "rays",
       .field = IntegerField(&PipelineOptions::rays, {0, kMostRays}),
       .group = OptionGroup::kSampled,
       .solver = "sampled",
       .help =
           "Rays that gather reflected light at a node of the mesh; a probe takes four times as many; 0: as "
           "--error asks. Of form factors by rays: rays for each of them; 0: as many as each method takes",
       .in_older_files = [](const PipelineOptions&) { return OptionValue(std::uint64_t{0}); },
       .label = "Sampled: rays at a point"});
  table.push_back(
      {.name = "resolution",
       .field = IntegerField(&PipelineOptions::resolution, {0, kMostResolution}),
       .group = OptionGroup::kStudies,
       .links_depend = true,
       .help = "Of form factors that are drawn: cells along a side of a plane; 0: as many as each method was "
               "printed with",
       .in_older_files = [](const PipelineOptions&) { return OptionValue(std::uint64_t{0}); },
       .label = "Form factors: cells along a side"});
  table.push_back({.name = "basis",
                   .field = ChoiceField(
                       [](auto& options) -> auto& { return options.dense.degree; }, Bases()),
                   .group = OptionGroup::kDense,
                   .links_depend = true,
                   .help = "Of the dense solver's elements: `constant` (Galerkin), `linear` or `quadratic` "
                           "(collocation; their means are shown)",
                   .label = "Dense: basis"});
  table.push_back(
      {.name = "divisions",
       .field = IntegerField([](auto& options) -> auto& { return options.dense.divisions; },
                             {1, kMostDivisions, true}),
       .group = OptionGroup::kDense,
       .links_depend = true,
       .help = "The dense solver, and others on uniform meshes, cut every patch into N x N elements",
       .label = "Dense: divisions of a patch's side"});
}

void AddCrowdedSplits(Entries& table) {
  table.push_back(
      {.name = "crowded-splits",
       .field = IntegerField(&PipelineOptions::crowded_splits, {0, kMostCrowdedSplits}),
       .group = OptionGroup::kStudies,
       .help = "Split leaves with no room for a discontinuity so many times; 0: none, as in the thesis",
       .in_older_files = [](const PipelineOptions&) { return OptionValue(std::uint64_t{3}); },
       .label = "Splits of crowded leaves"});
}

void AddErrorPoints(Entries& table) {
  table.push_back(
      {.name = "error-points",
       .field = IntegerField(&PipelineOptions::error_points, {0, kMostErrorPoints}),
       .measures_only = true,
       .help = "Random points at which a report measures the error of the interpolants; 0 leaves that out",
       .label = "Points that measure the error"});
}

// Sets the solvers and the form-factor methods that use an option: those that have the option among their
// parameters.
void TellOwners(Entries& table) {
  const auto entry_of = [&](const std::string& parameter) -> SolveOption& {
    const auto option = std::find_if(table.begin(), table.end(),
                                     [&](const SolveOption& entry) { return entry.name == parameter; });
    PENUMBRA_CHECK(option != table.end());
    return *option;
  };
  for (const LightSolverRegistry::Method& solver : LightSolvers().methods())
    for (const std::string& parameter : solver.parameters) {
      SolveOption& option = entry_of(parameter);
      if (option.solver.empty())
        option.solver = solver.name;
      else if (option.solver != solver.name)
        option.other_solvers.push_back(solver.name);
    }
  for (const LinkFormFactorRegistry::Method& method : LinkFormFactorMethods().methods())
    for (const std::string& parameter : method.parameters)
      entry_of(parameter).form_factors.push_back(method.name);
}

}  // namespace

std::vector<SolveOption> OptionEntries() {
  Entries table;
  AddErrors(table);
  AddChoiceOfDiscontinuities(table);
  AddWeights(table);
  AddMesh(table);
  AddRefinement(table);
  AddSweeps(table);
  AddLinks(table);
  AddEndsOfIteration(table);
  AddLimits(table);
  AddDistances(table);
  AddOcclusion(table);
  AddSolvers(table);
  AddClassicSolvers(table);
  AddErrorPoints(table);
  AddEmitters(table);
  AddCrowdedSplits(table);
  TellOwners(table);
  return table;
}

}  // namespace penumbra
