// mesh/pipeline/solution_file.h
//
// Reads and writes solution files, which store solved scenes. A solution file consists of a header of 512
// bytes and an HDF5 image. The header of a solution file identifies the file type and contains a digest of
// the whole file, so that damage is detected before anything is read. The manual
// thesis_notes/solution_file.md describes the contents of solution files. A solution file contains no dates
// or times, so that equal solutions give equal bytes.

#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The version of the solution file's layout, which is incremented with every change. Solution files with an
// older version than kOldestSolutionSchema, or a newer version than kSolutionSchema, are rejected. Solution
// files of version 4 do not contain the light of each emitter.
inline constexpr int kSolutionSchema = 6, kOldestSolutionSchema = 4;

// The contents of a solution file.
struct StoredSolution {
  std::unique_ptr<const Scene> scene;
  PipelineState state;  // results of the solve, which refer to *scene; the report in `state` is empty
  std::string options;  // the options of the solve, as text in the caller's format
  std::string report;   // the report on the solve, as text in the caller's format
  std::string version;  // the version of the program that wrote the solution file
  int schema = 0;       // the version number of the solution file's layout
};

// The number of bytes before the HDF5 image. HDF5 libraries look for an HDF5 image at the offset
// kSolutionHeaderSize.
inline constexpr std::size_t kSolutionHeaderSize = 512;

// True if the bytes are the start of a solution file, or of another binary file for which DecodeSolution()
// throws an appropriate error. `beginning` holds the first kSolutionHeaderSize bytes of the file, or the
// whole file if it is shorter.
bool LooksLikeSolution(std::string_view beginning);

// Returns the bytes of a solution file. REQUIRES: the pipeline is solved and has a mesh of kind kInterpolant.
// EncodeSolution() also allows a mesh of kind kFlat if a limit ended the run before there were interpolants.
std::string EncodeSolution(const Pipeline& pipeline, const std::string& options, const std::string& report,
                           const std::string& version);

// Decodes the bytes of a solution file. Throws InputError "FILE: error: …" unless the bytes are complete,
// have a known version of the layout, and pass all checks.
StoredSolution DecodeSolution(std::string_view bytes, const std::string& file);

}  // namespace penumbra
