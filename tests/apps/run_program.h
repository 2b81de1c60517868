// tests/apps/run_program.h
//
// Runs the built program as a user does, in a folder of its own.

#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace penumbra {

struct Outcome {
  int status = -1;       // exit status; -1 if a signal ended it
  std::string out, err;  // what it printed
};

// A folder that is there as long as this object.
class Sandbox {
 public:
  Sandbox();
  ~Sandbox();
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;

  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  // Writes a file and returns its path.
  std::string Write(const std::string& name, const std::string& text) const;
  // The names of all files, sorted.
  std::vector<std::string> Files() const;

  // Runs penumbra with these arguments, in this folder.
  Outcome Run(const std::vector<std::string>& arguments) const;
  // Runs a script by sh in this folder; the program is `penumbra` there.
  Outcome RunScript(const std::string& script) const;
  // Starts it and sends it the signal once its standard error holds `marker`.
  Outcome RunAndSignal(const std::vector<std::string>& arguments, const std::string& marker,
                       int signal) const;

 private:
  pid_t Start(const std::vector<std::string>& arguments) const;
  pid_t StartProgram(const std::string& program, const std::vector<std::string>& arguments) const;
  Outcome Finish(pid_t child) const;

  std::filesystem::path folder_;
  std::filesystem::path streams_;  // where the program's output is caught
};

std::string ReadBytes(const std::filesystem::path& path);
std::vector<std::string> Lines(const std::string& text);
// The arguments of a command, with more arguments behind them.
std::vector<std::string> With(std::vector<std::string> command, const std::vector<std::string>& more);
// The fields of a line of CSV.
std::vector<std::string> Fields(const std::string& line);

}  // namespace penumbra
