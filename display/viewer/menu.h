// display/viewer/menu.h
//
// The contents of the viewer's menus, as data. The window draws the menus; keys and scripts run the menu
// items.

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "display/viewer/input.h"

namespace penumbra::viewer {

struct MenuItem {
  std::string path;  // path of the item in the menus, such as `Iteration/Iterate`
  std::string key;   // a key chord such as `ctrl+s`, or empty
  std::string help;  // text that says what the menu item does
  std::function<void()> run;
  // A function that tells whether the item has a check mark; empty if the item never has a check mark.
  std::function<bool()> checked;
};

class Menu {
 public:
  void Add(MenuItem item) { items_.push_back(std::move(item)); }
  // Replaces all items of a submenu, such as `File/Recent`.
  void Replace(const std::string& submenu, std::vector<MenuItem> items);

  // Find() returns the menu item with the given path, FindKey() the menu item with the given key; null if no
  // item matches.
  const MenuItem* Find(const std::string& path) const;
  const MenuItem* FindKey(const KeyChord& chord) const;
  const std::vector<MenuItem>& items() const { return items_; }

 private:
  std::vector<MenuItem> items_;  // the items of a submenu are consecutive
};

}  // namespace penumbra::viewer
