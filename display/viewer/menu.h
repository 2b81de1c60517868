// display/viewer/menu.h
//
// The menus as data. The window draws them; keys and scripts run their items.

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "display/viewer/input.h"

namespace penumbra::viewer {

struct MenuItem {
  std::string path;  // as in `menu PATH`: `Iteration/Iterate`
  std::string key;   // a chord, or empty
  std::string help;  // what the item does
  std::function<void()> run;
  std::function<bool()> checked;  // empty: the item has no check mark
};

class Menu {
 public:
  void Add(MenuItem item) { items_.push_back(std::move(item)); }
  // Replaces the items below a submenu, for lists that change.
  void Replace(const std::string& submenu, std::vector<MenuItem> items);

  // The item with this path, or with this key; null if there is none.
  const MenuItem* Find(const std::string& path) const;
  const MenuItem* FindKey(const KeyChord& chord) const;
  const std::vector<MenuItem>& items() const { return items_; }

 private:
  std::vector<MenuItem> items_;  // the items of a submenu are consecutive
};

}  // namespace penumbra::viewer
