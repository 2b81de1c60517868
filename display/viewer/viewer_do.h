// display/viewer/viewer_do.h
//
// The body of Viewer::Do(), for the sources of the class.

#pragma once

#include <string>
#include <utility>

#include "display/viewer/viewer.h"

namespace penumbra::viewer {

// Runs an action of the user, and remembers it for undo if it changed anything. Actions that an action runs
// are parts of it. An action that throws is not remembered.
template <class Action>
void Viewer::Do(const std::string& label, bool merge, const Action& action) {
  if (depth_ > 0) return action();
  struct Inside {
    explicit Inside(int* the_depth) : depth(the_depth) { ++*depth; }
    ~Inside() { --*depth; }
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;
    int* depth;
  };
  changes_ = false;
  UserState before = Now(/*with_place=*/true);
  {
    const Inside inside(&depth_);
    action();
  }
  if (!Differs(before) || (merge && history_.UndoLabel() == label)) return;
  Remember(label, std::move(before));
}

}  // namespace penumbra::viewer
