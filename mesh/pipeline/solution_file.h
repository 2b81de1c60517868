// mesh/pipeline/solution_file.h
//
// Solved scenes as files: HDF5 behind a block of 512 bytes that says what the file is and holds a digest of
// all of it, so that damage is found before anything is read. thesis_notes/solution_file.md describes what
// lies where. A file knows no times: the same solution gives the same bytes.

#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene.h"

namespace penumbra {

// Counted up whenever what lies where changes; files of another schema are refused.
inline constexpr int kSolutionSchema = 3;

// What was read from a file.
struct StoredSolution {
  std::unique_ptr<const Scene> scene;
  PipelineState state;  // refers to *scene; its report is empty
  std::string options;  // with which it was solved, and
  std::string report;   // what came out: texts of the writer's choice
  std::string version;  // of the program that wrote it
};

inline constexpr std::size_t kSolutionHeaderSize =
    512;  // bytes before the HDF5 file: it looks for itself there

// Whether the bytes at a file's beginning, kSolutionHeaderSize or all there are, are those of a solution file
// or of something else that is no text: then DecodeSolution() says what is wrong with it.
bool LooksLikeSolution(std::string_view beginning);

// The bytes of a solution file. REQUIRES: the pipeline is solved and has a mesh of interpolants, or a flat
// one where a limit ended it before there were any.
std::string EncodeSolution(const Pipeline& pipeline, const std::string& options, const std::string& report,
                           const std::string& version);

// The solution that the bytes hold. Throws InputError, "FILE: error: …", unless they are whole, of this
// schema, and make sense.
StoredSolution DecodeSolution(std::string_view bytes, const std::string& file);

}  // namespace penumbra
