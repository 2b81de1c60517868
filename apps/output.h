// apps/output.h
//
// Where results go.

#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace penumbra {

// Whoever read our standard output has had enough: the work ends quietly.
class PipeClosed : public std::runtime_error {
 public:
  PipeClosed() : std::runtime_error("the pipe was closed") {}
};

// Makes writing to streams that are closed, full or limited an error that is told, and keeps files that are
// opened from becoming standard streams. To be called before anything else.
void PrepareStreams();

// Whether all that was written to standard output has got there; says what happened unless it was a pipe that
// was closed. Of standard error, too, where something was said.
bool StreamsHeld();

// Whether both paths lead to one file, or would once it is there. Devices are nobody's.
bool IsSameFile(const std::string& a, const std::string& b);

// Throws InputError unless a file can be written at `path`: before the work, so that hours are not lost to a
// misspelt folder. Leaves nothing behind.
void CheckWritable(const std::string& path);

// The files that a command writes: none may be one that it reads, nor another that it writes.
class OutputFiles {
 public:
  // Adds the file that the option names. Checks that it can be written (CheckWritable), and throws UsageError
  // if the command reads it, or writes it already.
  void Add(const std::string& option, const std::string& path);
  void Add(const std::string& option, const std::optional<std::string>& path) {
    if (path) Add(option, *path);
  }

  // Throws UsageError if the file that is about to be read is one that will be written.
  void RefuseInput(const std::string& path) const;

 private:
  struct Output {
    std::string option, path;
  };
  std::vector<Output> outputs_;
};

// Writes the text to the file, beside its place and then renamed; without a path to standard output. Throws
// InputError, and leaves nothing behind, if that fails; PipeClosed if nobody reads standard output any more.
void WriteResult(const std::optional<std::string>& path, const std::string& text);

}  // namespace penumbra
