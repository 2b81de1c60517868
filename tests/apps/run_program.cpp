#include "tests/apps/run_program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

#include "test_paths.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

fs::path MakeFolder() {
  std::string name = (fs::temp_directory_path() / "penumbra-XXXXXX").string();
  EXPECT_NE(mkdtemp(name.data()), nullptr);
  return name;
}

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

}  // namespace

Sandbox::Sandbox() : folder_(MakeFolder()), streams_(MakeFolder()) {}

Sandbox::~Sandbox() {
  fs::remove_all(folder_);
  fs::remove_all(streams_);
}

std::string Sandbox::Write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
  return Path(name);
}

std::vector<std::string> Sandbox::Files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

pid_t Sandbox::Start(const std::vector<std::string>& arguments) const {
  return StartProgram(std::string(PENUMBRA_BINARY_DIR) + "/bin/penumbra", arguments);
}

Outcome Sandbox::RunScript(const std::string& script) const {
  const std::string program =
      "penumbra() { '" + std::string(PENUMBRA_BINARY_DIR) + "/bin/penumbra' \"$@\"; }\n";
  return Finish(StartProgram("/bin/sh", {"-c", program + script}));
}

pid_t Sandbox::StartProgram(const std::string& program, const std::vector<std::string>& arguments) const {
  std::vector<const char*> argv = {program.c_str()};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  argv.push_back(nullptr);
  const std::string out = streams_ / "out", err = streams_ / "err";
  fs::remove(err);
  const pid_t child = fork();
  if (child == 0) {
    const int out_file = open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int err_file = open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (dup2(out_file, STDOUT_FILENO) < 0 || dup2(err_file, STDERR_FILENO) < 0 || chdir(folder_.c_str()) != 0)
      _exit(126);
    execv(program.c_str(), const_cast<char* const*>(argv.data()));
    _exit(127);
  }
  return child;
}

Outcome Sandbox::Finish(pid_t child) const {
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, ReadBytes(streams_ / "out"),
          ReadBytes(streams_ / "err")};
}

Outcome Sandbox::Run(const std::vector<std::string>& arguments) const { return Finish(Start(arguments)); }

Outcome Sandbox::RunAndSignal(const std::vector<std::string>& arguments, const std::string& marker,
                              int signal) const {
  using namespace std::chrono_literals;
  const pid_t child = Start(arguments);
  const auto deadline = std::chrono::steady_clock::now() + 30s;
  while (ReadBytes(streams_ / "err").find(marker) == std::string::npos &&
         std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(10ms);
  std::this_thread::sleep_for(100ms);
  kill(child, signal);
  return Finish(child);
}

std::string ReadBytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> With(std::vector<std::string> command, const std::vector<std::string>& more) {
  command.insert(command.end(), more.begin(), more.end());
  return command;
}

std::vector<std::string> Lines(const std::string& text) { return Split(text, '\n'); }
std::vector<std::string> Fields(const std::string& line) { return Split(line, ','); }

}  // namespace penumbra
