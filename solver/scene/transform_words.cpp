#include "solver/scene/transform_words.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "solver/base/check.h"
#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

// One option and its numbers.
struct TransformStep {
  std::string_view option;
  std::array<double, 3> value{};
};

// How many numbers the option takes; nullopt for what is no option of a transformation.
std::optional<std::size_t> NumbersOf(std::string_view option) {
  if (option == "-t") return 3;
  for (const char* one : {"-rx", "-ry", "-rz", "-s", "-i", "-a"})
    if (option == one) return 1;
  for (const char* none : {"-mx", "-my", "-mz"})
    if (option == none) return 0;
  return std::nullopt;
}

void CheckStep(const TransformStep& step) {
  const double value = step.value[0];
  const std::string name(step.option);
  if (step.option == "-s" && !(value > 0))
    throw InputError("the scale of " + name + " is not above 0; write " + name + " 0.5");
  if ((step.option == "-a" || step.option == "-i") &&
      !(value >= (step.option == "-a" ? 1 : 0) && value <= static_cast<double>(kMostCopies) &&
        value == std::floor(value)))
    throw InputError("the number of copies of " + name + " is no integer from 1 to 1000000");
}

std::vector<TransformStep> ReadSteps(std::span<const std::string_view> words, std::size_t& used) {
  std::vector<TransformStep> steps;
  used = 0;
  while (used < words.size()) {
    const std::optional<std::size_t> count = NumbersOf(words[used]);
    if (!count) break;
    TransformStep step = {words[used++]};
    for (std::size_t i = 0; i < *count; ++i) {
      const std::optional<double> value = used < words.size() ? ToNumber(words[used]) : std::nullopt;
      if (!value || !std::isfinite(*value))
        throw InputError(std::string(step.option) + " takes " + std::to_string(*count) +
                         (*count == 1 ? " number" : " numbers"));
      step.value[i] = *value;
      ++used;
    }
    CheckStep(step);
    steps.push_back(step);
  }
  return steps;
}

// Multiples of a right angle are exact.
Eigen::Affine3d Turn(const Vec3& axis, double degrees) {
  const double quarter = std::remainder(degrees, 360) / 90;
  if (quarter != std::round(quarter)) {
    const double radians = degrees * std::numbers::pi / 180;
    return Eigen::Affine3d(Eigen::AngleAxisd(radians, axis));
  }
  const int turns = (static_cast<int>(quarter) + 4) % 4;
  Eigen::Matrix3d cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  const Eigen::Matrix3d along = axis * axis.transpose(), across = Eigen::Matrix3d::Identity() - along;
  const double cosine = turns == 0 ? 1 : turns == 2 ? -1 : 0, sine = turns == 1 ? 1 : turns == 3 ? -1 : 0;
  Eigen::Affine3d turn = Eigen::Affine3d::Identity();
  turn.linear() = along + cosine * across + sine * cross;
  return turn;
}

Placement PlacementOf(const TransformStep& step) {
  Placement placement;
  const auto& [x, y, z] = step.value;
  const char kind = step.option[1], axis = step.option.size() > 2 ? step.option[2] : ' ';
  const Vec3 unit = axis == 'x' ? Vec3::UnitX() : axis == 'y' ? Vec3::UnitY() : Vec3::UnitZ();
  if (kind == 't') placement.matrix.translation() = Vec3(x, y, z);
  if (kind == 'r') placement.matrix = Turn(unit, x);
  if (kind == 's') {
    placement.scale = x;
    placement.matrix.linear() *= x;
  }
  if (kind == 'm') {
    placement.mirrored = true;
    placement.matrix.linear() -= 2 * (unit * unit.transpose());
  }
  return placement;
}

// The steps up to the next -i or -a, one after the other, `times` times.
Placement Repeated(std::span<const TransformStep> steps, double times) {
  Placement once, all;
  for (const TransformStep& step : steps) once = PlacementOf(step).After(once);
  for (double i = 0; i < times; ++i) all = once.After(all);
  return all;
}

// The steps from an -i or -a to the next one.
struct TransformGroup {
  bool is_array = false;
  double count = 1;
  std::vector<TransformStep> steps;
};

std::vector<TransformGroup> GroupsOf(const std::vector<TransformStep>& steps) {
  std::vector<TransformGroup> groups(1);
  for (const TransformStep& step : steps) {
    if (step.option == "-a" || step.option == "-i")
      groups.push_back({step.option == "-a", step.value[0], {}});
    else
      groups.back().steps.push_back(step);
  }
  return groups;
}

}  // namespace

Placement Placement::After(const Placement& inner) const {
  return {matrix * inner.matrix, scale * inner.scale, mirrored != inner.mirrored};
}

std::vector<Placement> ReadPlacements(std::span<const std::string_view> words, std::size_t& used) {
  std::vector<Placement> placements(1);
  for (const TransformGroup& group : GroupsOf(ReadSteps(words, used))) {
    const std::size_t copies = group.is_array ? static_cast<std::size_t>(group.count) : 1;
    if (copies * placements.size() > kMostCopies)
      throw InputError("a transformation makes more than 1000000 copies; make fewer");
    std::vector<Placement> next;
    for (const Placement& before : placements) {
      Placement copy = before;
      const Placement step = Repeated(group.steps, group.is_array ? 1 : group.count);
      for (std::size_t i = 0; i < copies; ++i) {
        if (!group.is_array || i > 0) copy = step.After(copy);
        next.push_back(copy);
      }
    }
    placements = std::move(next);
  }
  return placements;
}

}  // namespace penumbra
