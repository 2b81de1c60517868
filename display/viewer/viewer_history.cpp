// What the user can take back, and what he is asked about because he cannot.

#include <fmt/format.h>

#include "display/viewer/viewer.h"
#include "display/viewer/viewer_do.h"
#include "mesh/pipeline/option_table.h"
#include "solver/base/check.h"

namespace penumbra::viewer {
namespace {

// The states of the solver that undo can reach hold so many bytes at most.
constexpr std::size_t kMostBytesOfHistory = std::size_t{1} << 29;

bool SameOptionsOfSolve(const PipelineOptions& a, const PipelineOptions& b) {
  for (const SolveOption& option : OptionTable())
    if (option.field.get(a) != option.field.get(b)) return false;
  return true;
}

}  // namespace

Viewer::UserState Viewer::Now(bool with_place) const {
  UserState state;
  state.shown = view_;
  state.solving = options_.solving;
  state.own_links = own_links_;
  state.light = light_;
  state.scene_name = options_.scene_name;
  if (options_.files.keep_reading) state.reading = options_.files.keep_reading();
  if (with_place) state.place = session_.place();
  return state;
}

bool Viewer::Differs(const UserState& before) const {
  return changes_ || !(static_cast<const ShownState&>(view_) == before.shown) || !(light_ == before.light) ||
         !SameOptionsOfSolve(options_.solving, before.solving);
}

void Viewer::Remember(const std::string& label, UserState before) {
  if (!changes_) before.place.reset();
  history_.Add(label, std::move(before));
  history_.Trim(kMostBytesOfHistory, [](const UserState& state, const UserState* later) {
    return state.place && (!later || later->place != state.place) ? BytesOf(*state.place) : 0;
  });
}

void Viewer::Restore(const UserState& state) {
  static_cast<ShownState&>(view_) = state.shown;
  own_links_ = state.own_links;
  light_ = state.light;
  options_.scene_name = state.scene_name;
  if (!SameOptionsOfSolve(options_.solving, state.solving)) {
    options_.solving = state.solving;
    SolvingChanged();
  }
  if (!state.place) return;
  playing_ = false;
  if (state.reading && state.place->snapshot->opening != session_.snapshot()->opening) state.reading();
  keep_camera_ = true;
  Begin().Return(state.place);
}

void Viewer::Undo() {
  fresh_ = false;
  const UserState* const before = history_.NextUndo();
  if (!before) return;
  if (std::optional<UserState> state = history_.Undo(Now(before->place != nullptr))) Restore(*state);
}

void Viewer::Redo() {
  fresh_ = false;
  const UserState* const after = history_.NextRedo();
  if (!after) return;
  if (std::optional<UserState> state = history_.Redo(Now(after->place != nullptr))) Restore(*state);
}

SolverSession& Viewer::Change() {
  changes_ = true;
  return Begin();
}

void Viewer::AddHistoryMenu() {
  Item("Edit/Undo", "ctrl+z", "Take back the last setting, lamp, step or selection; the camera stays",
       [this] { Undo(); });
  Item("Edit/Redo", "ctrl+shift+z", "Do again what was taken back", [this] { Redo(); });
}

void Viewer::AskToQuit() {
  const double unsaved = session_.status().unsaved_seconds;
  if (unsaved < ask_above_ || !snapshot_->light) {
    panels_.quit = true;
    return;
  }
  panels_.question =
      fmt::format("The solution took {:.0f} seconds and is not saved. Quit without saving it?", unsaved);
}

}  // namespace penumbra::viewer
