#include "display/viewer/user_files.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

namespace penumbra::viewer {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kMostRecent = 10;

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
  const fs::path path = fs::path(*folder_) / name, beside = fs::path(*folder_) / (name + ".new");
  {
    std::ofstream file(beside, std::ios::binary);
    file << text;
    if (!file) return;
  }
  std::error_code error;
  fs::rename(beside, path, error);
}

std::vector<std::string> UserFiles::Recent() const {
  std::vector<std::string> names;
  std::istringstream lines(Read("recent"));
  for (std::string line; std::getline(lines, line) && names.size() < kMostRecent;)
    if (!line.empty()) names.push_back(line);
  return names;
}

void UserFiles::AddRecent(const std::string& scene) const {
  std::error_code error;
  const std::string name = fs::exists(scene, error) ? fs::absolute(scene, error).string() : scene;
  std::vector<std::string> names = Recent();
  std::erase(names, name);
  names.insert(names.begin(), name);
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostRecent); ++i) text += names[i] + "\n";
  Write("recent", text);
}

}  // namespace penumbra::viewer
