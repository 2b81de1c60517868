// display/viewer/menu.h
//
// The contents of the menus, as data. The window draws the menus; keys and scripts run the menu items.

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
  // Replaces all items of a submenu; for submenus whose items change.
  void Replace(const std::string& submenu, std::vector<MenuItem> items);

  // Find() returns the item with this path, and FindKey() the item with this key; null if there is no such
  // item.
  const MenuItem* Find(const std::string& path) const;
  const MenuItem* FindKey(const KeyChord& chord) const;
  const std::vector<MenuItem>& items() const { return items_; }

 private:
  std::vector<MenuItem> items_;  // the items of a submenu are consecutive
};

}  // namespace penumbra::viewer
