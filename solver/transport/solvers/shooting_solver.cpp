#include "solver/transport/solvers/shooting_solver.h"

#include <cmath>

namespace penumbra {
namespace {

// A patch that shoots again uses its form factors again, as long as no more than so many are kept (256 MB).
constexpr std::size_t kMostKeptFactors = std::size_t{32} << 20U;
// Shots after which the method gives up; a scene of n patches takes a few n.
constexpr std::size_t kMostShots = 1'000'000;

}  // namespace

ShootingSolver::ShootingSolver(const Scene& scene, const PatchVisibility& visibility,
                               const UniformOptions& options)
    : UniformSolver(scene, visibility, options, kMostShots), irradiance_(leaves().size(), Rgb::Zero()) {
  for (std::size_t p = 0; p < scene.patches.size(); ++p)
    unsent_.push_back(scene.MaterialOf(static_cast<PatchId>(p)).emittance);
  if (options.ambient) Show(std::vector<Rgb>(irradiance_.size(), AmbientIrradiance()));
}

ShootingSolver::Ledger ShootingSolver::Balance() const {
  Ledger ledger;
  ledger.emitted = EmittedFlux();
  for (std::size_t i = 0; i < irradiance_.size(); ++i)
    ledger.absorbed += AreaOf(i) * (1 - MaterialOf(i).reflectance) * irradiance_[i];
  for (std::size_t p = 0; p < unsent_.size(); ++p) ledger.unsent += scene().patches[p].area * unsent_[p];
  return ledger;
}

Rgb ShootingSolver::AmbientIrradiance() const {
  Rgb reflectance = Rgb::Zero(), unsent = Rgb::Zero();
  double area = 0;
  for (std::size_t p = 0; p < unsent_.size(); ++p) {
    const double own = scene().patches[p].area;
    area += own;
    reflectance += own * scene().MaterialOf(static_cast<PatchId>(p)).reflectance;
    unsent += own * unsent_[p];
  }
  if (area == 0) return Rgb::Zero();
  // Once received evenly, and then reflected again and again with the mean reflectance.
  return (unsent / area / (1 - reflectance / area)).max(0.0);
}

const std::vector<double>& ShootingSolver::RowOf(PatchId shooter, const ExecutionContext& context) {
  const auto known = rows_.find(shooter);
  if (known != rows_.end()) return known->second;
  if ((rows_.size() + 1) * irradiance_.size() > kMostKeptFactors) rows_.clear();
  std::vector<double> row = FormFactorsOf(shooter, context);
  if (context.Cancelled()) row.clear();
  return rows_[shooter] = std::move(row);
}

// The patch with the largest unsent flux over all channels; if none has any left, the one that has sent most
// too much.
PatchId ShootingSolver::Brightest() const {
  PatchId best = 0, lowest = 0;
  double most = 0, least = 0;
  for (std::size_t p = 0; p < unsent_.size(); ++p) {
    const double flux = scene().patches[p].area * unsent_[p].sum();
    if (flux > most) most = flux, best = static_cast<PatchId>(p);
    if (flux < least) least = flux, lowest = static_cast<PatchId>(p);
  }
  return most > 0 ? best : lowest;
}

// What the shooter will reflect of the light that the others have not sent yet, where it is positive (Shao
// and Badler 1993; Ashdown 1994, eq. 6.45) [W/m^2].
Rgb ShootingSolver::Overshoot(PatchId shooter, std::span<const double> row) const {
  Rgb flux = Rgb::Zero();
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] == 0) continue;
    const PatchId other = forest()[leaves()[i]].patch;
    // By reciprocity: A_e F(e <- shooter) is the same as A_shooter F(shooter <- e).
    flux += AreaOf(i) * row[i] * unsent_[static_cast<std::size_t>(other)].max(0.0);
  }
  const double area = scene().patches[static_cast<std::size_t>(shooter)].area;
  return scene().MaterialOf(shooter).reflectance * flux / area;
}

bool ShootingSolver::Advance(IterationReport* report, const ExecutionContext& context) {
  if (unsent_.empty()) {
    report->residual = 0;
    return true;
  }
  const PatchId shooter = Brightest();
  const std::vector<double>& row = RowOf(shooter, context);
  if (context.Cancelled()) {
    rows_.erase(shooter);
    return false;
  }
  const auto s = static_cast<std::size_t>(shooter);
  const Rgb over = options().overshoot ? Overshoot(shooter, row) : Rgb::Zero();
  const Rgb shot = unsent_[s] + over;
  unsent_[s] = -over;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] == 0) continue;
    const auto patch = static_cast<std::size_t>(forest()[leaves()[i]].patch);
    const Rgb arrives = row[i] * shot;
    irradiance_[i] += arrives;
    unsent_[patch] += AreaOf(i) / scene().patches[patch].area * MaterialOf(i).reflectance * arrives;
  }
  double left = 0;
  for (std::size_t p = 0; p < unsent_.size(); ++p) left += scene().patches[p].area * unsent_[p].abs().sum();
  const double emitted = EmittedFlux().sum();
  report->residual = emitted > 0 ? left / emitted : 0;
  report->sweeps = 1;
  if (options().ambient) {
    std::vector<Rgb> shown = irradiance_;
    const Rgb ambient = AmbientIrradiance();
    for (Rgb& irradiance : shown) irradiance += ambient;
    Show(shown);
  } else {
    Show(irradiance_);
  }
  return true;
}

}  // namespace penumbra
