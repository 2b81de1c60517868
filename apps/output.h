// apps/output.h
//
// Functions that write results to files and to standard output.

#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace penumbra {

// The exception thrown if standard output is a pipe whose reader has closed it. After PipeClosed, the program
// ends without a message.
class PipeClosed : public std::runtime_error {
 public:
  PipeClosed() : std::runtime_error("the pipe was closed") {}
};

// Prepares the standard streams (input, output and error). After PrepareStreams(), writing to a closed, full
// or limited stream is an error with a message, and the descriptor of a closed standard stream is not reused
// for another file. PrepareStreams() must be called before any file is opened.
void PrepareStreams();

// True if all output to standard output and all messages to standard error have been written without error.
// If writing has failed, prints the reason, unless the reason is a closed pipe.
bool OutputArrived();

// True if both paths lead to the same file, or would lead to the same file if the file existed. IsSameFile()
// returns false for devices.
bool IsSameFile(const std::string& a, const std::string& b);

// Throws InputError unless a file can be written at `path`. CheckWritable() is called before long
// computations, so that a misspelt folder is detected at once. CheckWritable() leaves no file behind.
void CheckWritable(const std::string& path);

// The list of the output files of a command. An output file must not be an input file, nor the output file of
// another option.
class OutputFiles {
 public:
  // Adds the output file `path`, which the user has given with the option `option`, after checking that the
  // file can be written (CheckWritable). Throws UsageError if another option names the same file.
  void Add(const std::string& option, const std::string& path);
  void Add(const std::string& option, const std::optional<std::string>& path) {
    if (path) Add(option, *path);
  }

  // Throws UsageError if the input file `path` is also one of the output files.
  void RefuseInput(const std::string& path) const;

 private:
  struct Output {
    std::string option, path;
  };
  std::vector<Output> outputs_;
};

// Writes the text to the file `path` (WriteWholeFile), or to standard output if `path` is nullopt. On
// failure, throws InputError and leaves no file behind. Throws PipeClosed if standard output is a closed
// pipe.
void WriteResult(const std::optional<std::string>& path, const std::string& text);

}  // namespace penumbra
