// display/viewer/menu.h
//
// The menus as data: the window draws them, keys and scripts run them.

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "display/viewer/input.h"

namespace penumbra::viewer {

struct MenuItem {
  std::string path;  // as in `menu PATH`: `Iteration/Iterate`
  std::string key;   // a chord, or empty
  std::string help;  // what it does
  std::function<void()> run;
  std::function<bool()> checked;  // empty: it has no mark
};

class Menu {
 public:
  void Add(MenuItem item) { items_.push_back(std::move(item)); }
  // Replaces the items below a submenu by others: lists that change.
  void Replace(const std::string& submenu, std::vector<MenuItem> items);

  // Null if there is none.
  const MenuItem* Find(const std::string& path) const;
  const MenuItem* FindKey(const KeyChord& chord) const;
  const std::vector<MenuItem>& items() const { return items_; }

 private:
  std::vector<MenuItem> items_;  // those of one submenu follow one another
};

}  // namespace penumbra::viewer
