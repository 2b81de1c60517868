// display/viewer/history.h
//
// What the user has done, to take it back and to do it again. An entry holds the state before an action;
// State is a value that is cheap to copy.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace penumbra::viewer {

template <class State>
class History {
 public:
  // Adds an action that was taken in the state `before`, and forgets what was taken back. The oldest entry is
  // dropped where there would be more than kMostEntries.
  void Add(const std::string& label, State before) {
    redo_.clear();
    undo_.push_back({label, std::move(before)});
    if (undo_.size() > kMostEntries) undo_.erase(undo_.begin());
  }

  // Returns the state before the last action, and keeps `now` for Redo(); nothing if there is no action.
  std::optional<State> Undo(State now) { return Move(&undo_, &redo_, std::move(now)); }
  // Returns the state that the last Undo() left; nothing if there is none.
  std::optional<State> Redo(State now) { return Move(&redo_, &undo_, std::move(now)); }

  // The states that the next calls return; null if there is none.
  const State* NextUndo() const { return undo_.empty() ? nullptr : &undo_.back().state; }
  const State* NextRedo() const { return redo_.empty() ? nullptr : &redo_.back().state; }

  // Forgets the oldest actions until the sizes of what is left add up to `most` at most. `size` is called
  // with each state and the one that follows it in time, or null.
  template <class Size>
  void Trim(std::size_t most, const Size& size) {
    std::size_t sum = 0;
    const State* later = nullptr;
    for (std::size_t i = undo_.size(); i-- > 0;) {
      sum += size(undo_[i].state, later);
      later = &undo_[i].state;
      if (sum <= most) continue;
      undo_.erase(undo_.begin(), undo_.begin() + static_cast<std::ptrdiff_t>(i));
      return;
    }
  }

  // The label of the action that the next call takes back or does again; empty if there is none.
  std::string UndoLabel() const { return undo_.empty() ? "" : undo_.back().label; }
  std::string RedoLabel() const { return redo_.empty() ? "" : redo_.back().label; }

  static constexpr std::size_t kMostEntries = 100;

 private:
  struct Entry {
    std::string label;
    State state;
  };

  static std::optional<State> Move(std::vector<Entry>* from, std::vector<Entry>* to, State now) {
    if (from->empty()) return std::nullopt;
    Entry entry = std::move(from->back());
    from->pop_back();
    to->push_back({entry.label, std::move(now)});
    return std::move(entry.state);
  }

  std::vector<Entry> undo_, redo_;
};

}  // namespace penumbra::viewer
