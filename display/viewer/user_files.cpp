#include "display/viewer/user_files.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>
#include <utility>

#include "display/camera.h"
#include "display/viewer/settings.h"
#include "solver/base/check.h"
#include "solver/base/whole_file.h"

namespace penumbra::viewer {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kMostRecent = 10;
constexpr const char* kPanelSettings = "Panels";  // the group of those that say which are open

// What is remembered of a scene goes by this: paths are absolute.
std::string KeyOf(const std::string& scene) {
  std::error_code error;
  return fs::exists(scene, error) ? fs::absolute(scene, error).string() : scene;
}

// A camera on a line of tabs: scene, name, eye, look-at, up, field of view.
struct KeptCamera {
  std::string scene;
  Camera camera;
};

std::string LineOf(const KeptCamera& kept) {
  std::string line = kept.scene + "\t" + kept.camera.name;
  for (const Vec3& v : {kept.camera.eye, kept.camera.look_at, kept.camera.up})
    for (int i = 0; i < 3; ++i) line += "\t" + TextOf(v[i]);
  return line + "\t" + TextOf(kept.camera.vertical_fov) + "\n";
}

// Nothing if somebody else wrote the line.
std::optional<KeptCamera> CameraFrom(const std::string& line) {
  std::vector<std::string> parts(1);
  for (const char c : line) {
    if (c == '\t')
      parts.emplace_back();
    else
      parts.back().push_back(c);
  }
  if (parts.size() != 12) return std::nullopt;
  try {
    const auto vector = [&](std::size_t at) {
      Vec3 v;
      for (int i = 0; i < 3; ++i) v[i] = NumberFrom(parts[at + static_cast<std::size_t>(i)], -1e12, 1e12);
      return v;
    };
    KeptCamera kept{parts[0], {parts[1], vector(2), vector(5), vector(8), NumberFrom(parts[11], 0, 180)}};
    ValidateCamera(kept.camera);
    return kept;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::vector<KeptCamera> AllCameras(const std::string& text) {
  std::vector<KeptCamera> cameras;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (std::optional<KeptCamera> camera = CameraFrom(line)) cameras.push_back(std::move(*camera));
  return cameras;
}

}  // namespace

UserFiles::UserFiles() {
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  fs::path folder;
  // The specification has relative paths ignored.
  if (state && fs::path(state).is_absolute())
    folder = fs::path(state) / "penumbra";
  else if (home && fs::path(home).is_absolute())
    folder = fs::path(home) / ".local" / "state" / "penumbra";
  else
    return;
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) folder_ = folder.string();
}

std::string UserFiles::Read(const std::string& name) const {
  if (!folder_) return {};
  std::ifstream file(fs::path(*folder_) / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void UserFiles::Write(const std::string& name, const std::string& text) const {
  if (!folder_) return;
  try {
    WriteWholeFile((fs::path(*folder_) / name).string(), text);
  } catch (const InputError&) {
    // What is remembered from one start to the next can be gone without.
  }
}

std::vector<std::string> UserFiles::Recent() const {
  std::vector<std::string> names;
  std::istringstream lines(Read("recent"));
  for (std::string line; std::getline(lines, line) && names.size() < kMostRecent;)
    if (!line.empty()) names.push_back(line);
  return names;
}

void UserFiles::AddRecent(const std::string& scene) const {
  const std::string name = KeyOf(scene);
  std::vector<std::string> names = Recent();
  std::erase(names, name);
  names.insert(names.begin(), name);
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostRecent); ++i) text += names[i] + "\n";
  Write("recent", text);
}

void UserFiles::KeepPanels(const Viewer& viewer) const {
  std::string text;
  for (const Setting& setting : viewer.settings().all())
    if (setting.group == kPanelSettings) text += setting.name + " " + setting.get() + "\n";
  Write("panels", text);
}

void UserFiles::OpenPanels(Viewer* viewer) const {
  std::istringstream lines(Read("panels"));
  for (std::string name, value; lines >> name >> value;) {
    const Setting* setting = viewer->settings().Find(name);
    if (!setting || setting->group != kPanelSettings) continue;
    try {
      viewer->Set(name, value);
    } catch (const InputError&) {  // someone wrote something else into it
    }
  }
}

std::vector<Camera> UserFiles::Cameras(const std::string& scene) const {
  std::vector<Camera> cameras;
  for (const KeptCamera& kept : AllCameras(Read("cameras")))
    if (kept.scene == KeyOf(scene)) cameras.push_back(kept.camera);
  return cameras;
}

void UserFiles::KeepCamera(const std::string& scene, const Camera& camera) const {
  std::vector<KeptCamera> cameras = AllCameras(Read("cameras"));
  const std::string key = KeyOf(scene);
  std::erase_if(cameras,
                [&](const KeptCamera& kept) { return kept.scene == key && kept.camera.name == camera.name; });
  cameras.push_back({key, camera});
  std::string text;
  for (const KeptCamera& kept : cameras) text += LineOf(kept);
  Write("cameras", text);
}

}  // namespace penumbra::viewer
