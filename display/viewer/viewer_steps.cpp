// The steps of the solver, one by one.

#include <fmt/format.h>

#include <charconv>

#include "display/viewer/viewer.h"
#include "solver/base/check.h"

namespace penumbra::viewer {

void Viewer::StepOn() {
  stepping_ = true;
  wanted_step_ = 0;
  Change().Step();
}

// Shows the state after so many of the steps that were made.
void Viewer::GoToStep(std::size_t number) {
  const auto steps = session_.steps();
  if (number < 1 || number > steps->size())
    throw InputError(fmt::format("there are steps 1 to {}", steps->size()));
  if (number == step()) return;
  const std::shared_ptr<const SolverPlace> place = (*steps)[number - 1].place;
  if (!place) throw InputError("this step is too far back: its light is not kept any more");
  stepping_ = true;
  playing_ = false;
  wanted_step_ = number;
  Change().Return(place);
}

// The next step, once the last is done and has been seen.
void Viewer::Play() {
  if (!playing_ || session_.status().busy || session_.snapshot() != snapshot_) return;
  playing_ = !snapshot_->complete && session_.status().message.empty();
  if (playing_) session_.Step();
}

void Viewer::AddStepSettings() {
  Setting at{"step",
             "Files",
             "Go to a step of the time line, by its number",
             SettingKind::kText,
             0,
             1,
             false,
             false,
             {},
             {},
             {}};
  at.get = [] { return std::string(); };
  at.set = [this](const std::string& text) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size())
      throw InputError(fmt::format("'{}' is not the number of a step", text));
    GoToStep(number);
  };
  settings_.Add(std::move(at));
}

void Viewer::AddStepMenu() {
  Item("Iteration/Step", ">",
       "The next of the smallest steps: links, a sweep, a level of splitting, a correction, a mesh",
       [this] { StepOn(); });
  Item("Iteration/Step back", "<", "The state before the last step", [this] {
    // Pressed faster than states come back, it still goes back once for each time.
    const std::size_t now = session_.status().busy && wanted_step_ > 0 ? wanted_step_ : step();
    if (now > 1) GoToStep(now - 1);
  });
  menu_.Add({"Iteration/Play", "space", "Step after step, until the end or until it is pressed again",
             [this] {
               stepping_ = true;
               playing_ = !playing_;
               if (playing_) Change();
             },
             [this] { return playing_; }});
  ToggleItem("Iteration/Time line", "ctrl+t", "time-line");
}

}  // namespace penumbra::viewer
