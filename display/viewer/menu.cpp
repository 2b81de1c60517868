#include "display/viewer/menu.h"

#include <algorithm>

namespace penumbra::viewer {

void Menu::Replace(const std::string& submenu, std::vector<MenuItem> items) {
  const std::string prefix = submenu + "/";
  const auto inside = [&](const MenuItem& item) { return item.path.starts_with(prefix); };
  auto at = std::find_if(items_.begin(), items_.end(), inside);
  if (at == items_.end()) {
    // Behind the other items of the same menu.
    const std::string top = submenu.substr(0, submenu.find('/') + 1);
    for (auto i = items_.begin(); i != items_.end(); ++i)
      if (i->path.starts_with(top)) at = i + 1;
  }
  const auto place = at - items_.begin();
  items_.erase(std::remove_if(items_.begin(), items_.end(), inside), items_.end());
  items_.insert(items_.begin() + place, std::make_move_iterator(items.begin()),
                std::make_move_iterator(items.end()));
}

const MenuItem* Menu::Find(const std::string& path) const {
  const auto found =
      std::find_if(items_.begin(), items_.end(), [&](const MenuItem& i) { return i.path == path; });
  return found == items_.end() ? nullptr : &*found;
}

const MenuItem* Menu::FindKey(const KeyChord& chord) const {
  for (const MenuItem& item : items_)
    if (!item.key.empty() && ParseChord(item.key) == chord) return &item;
  return nullptr;
}

}  // namespace penumbra::viewer
