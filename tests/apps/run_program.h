// tests/apps/run_program.h
//
// Runs the built program as a user does, in a temporary folder.

#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace penumbra {

struct Outcome {
  int status = -1;       // exit status; -1 if a signal ended the program
  std::string out, err;  // texts that the program printed
};

// A Sandbox is a temporary folder that exists as long as the object.
class Sandbox {
 public:
  Sandbox();
  ~Sandbox();
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;

  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  // Writes a file in the folder and returns the file's path.
  std::string Write(const std::string& name, const std::string& text) const;
  // Returns the names of all files in the folder, sorted.
  std::vector<std::string> Files() const;

  // Runs the program `penumbra` with the given arguments, in the temporary folder.
  Outcome Run(const std::vector<std::string>& arguments) const;
  // Runs a shell script with `sh` in the temporary folder. In the script, the command `penumbra` calls the
  // program.
  Outcome RunScript(const std::string& script) const;
  // Starts the program, and sends it the signal once the program has printed `marker` to standard error.
  Outcome RunAndSignal(const std::vector<std::string>& arguments, const std::string& marker,
                       int signal) const;

 private:
  pid_t Start(const std::vector<std::string>& arguments) const;
  pid_t StartProgram(const std::string& program, const std::vector<std::string>& arguments) const;
  Outcome Finish(pid_t child) const;

  std::filesystem::path folder_;
  std::filesystem::path streams_;  // folder of the files that receive the program's output
};

std::string ReadBytes(const std::filesystem::path& path);
std::vector<std::string> Lines(const std::string& text);
// Returns the arguments of a command, with more arguments appended.
std::vector<std::string> With(std::vector<std::string> command, const std::vector<std::string>& more);
// Returns the fields of a line of CSV.
std::vector<std::string> Fields(const std::string& line);

}  // namespace penumbra
