// apps/output.h
//
// Writing results to files and to standard output.

#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace penumbra {

// The reader of a pipe on standard output has closed the pipe: the program ends without a message.
class PipeClosed : public std::runtime_error {
 public:
  PipeClosed() : std::runtime_error("the pipe was closed") {}
};

// Prepares the standard streams: writing to a closed, full or limited stream becomes an error with a message,
// and files that are opened later cannot take the place of a closed standard stream. Must be called first.
void PrepareStreams();

// Whether all output to standard output, and all messages to standard error, arrived. If not, prints the
// reason, except for a closed pipe.
bool OutputArrived();

// Whether both paths lead to the same file, or would if the file existed. False for devices.
bool IsSameFile(const std::string& a, const std::string& b);

// Throws InputError unless a file can be written at `path`. Called before the work, so that a misspelt folder
// does not cost hours. Leaves no file behind.
void CheckWritable(const std::string& path);

// The output files of a command. An output file may not be an input file, nor the output file of another
// option.
class OutputFiles {
 public:
  // Adds the file that the option names. Checks that it can be written (CheckWritable). Throws UsageError if
  // it is already an output file.
  void Add(const std::string& option, const std::string& path);
  void Add(const std::string& option, const std::optional<std::string>& path) {
    if (path) Add(option, *path);
  }

  // Throws UsageError if `path`, an input file, is one of the output files.
  void RefuseInput(const std::string& path) const;

 private:
  struct Output {
    std::string option, path;
  };
  std::vector<Output> outputs_;
};

// Writes the text to the file (WriteWholeFile), or to standard output if there is no path. On failure, throws
// InputError and leaves no file behind. Throws PipeClosed if standard output is a closed pipe.
void WriteResult(const std::optional<std::string>& path, const std::string& text);

}  // namespace penumbra
