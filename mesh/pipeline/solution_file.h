// mesh/pipeline/solution_file.h
//
// Solved scenes as files. A file is a header of 512 bytes and an HDF5 image. The header identifies the file
// and contains a digest of the whole file, so that damage is detected before anything is read.
// thesis_notes/solution_file.md describes the contents. A file contains no dates or times, so that equal
// solutions give equal bytes.

#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The version of the file's layout, incremented with every change. Files with an older version than
// kOldestSolutionSchema, or a newer one than kSolutionSchema, are rejected. Files of version 4 lack the light
// of each emitter.
inline constexpr int kSolutionSchema = 5, kOldestSolutionSchema = 4;

// The contents of a file.
struct StoredSolution {
  std::unique_ptr<const Scene> scene;
  PipelineState state;  // refers to *scene; the report in it is empty
  std::string options;  // the options of the solve, and
  std::string report;   // its results: texts of the writer's choice
  std::string version;  // of the program that wrote the file
  int schema = 0;       // of the file
};

inline constexpr std::size_t kSolutionHeaderSize =
    512;  // bytes before the HDF5 image; HDF5 libraries look for an image at this offset

// True if the bytes are the start of a solution file, or of another binary file, for which DecodeSolution()
// throws an appropriate error. `beginning` holds the first kSolutionHeaderSize bytes, or the whole file if it
// is shorter.
bool LooksLikeSolution(std::string_view beginning);

// The bytes of a solution file. REQUIRES: the pipeline is solved and has a mesh of kind kInterpolant, or of
// kind kFlat if a limit ended the run before there were interpolants.
std::string EncodeSolution(const Pipeline& pipeline, const std::string& options, const std::string& report,
                           const std::string& version);

// Decodes the bytes of a solution file. Throws InputError, "FILE: error: …", unless the bytes are complete,
// have a version of the layout that can be read, and pass all checks.
StoredSolution DecodeSolution(std::string_view bytes, const std::string& file);

}  // namespace penumbra
