// apps/form_factor_matrix_run.h
//
// Computes the whole matrix of form factors of a scene, for the command `penumbra form-factor --all`.

#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>

#include "solver/scene/scene.h"
#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {

enum class MatrixRows : std::uint8_t { kFaces, kObjects };

struct MatrixArguments {
  bool all = false;  // true if the whole matrix is requested
  MatrixRows by = MatrixRows::kFaces;
  std::optional<std::string> output;
};

// Adds the options --all, --by and -o to the command line.
void AddMatrixOptions(CLI::App& app, MatrixArguments* arguments);

// The name of a kind of matrix rows (faces or objects), as the user writes it after the option --by.
const char* MatrixRowsName(MatrixRows by);

// Computes the form factor matrix of the scene, and writes it to the file MatrixArguments::output, or as CSV
// to standard output. A summary with errors, closure, reciprocity and seconds is printed to standard output,
// or to standard error if the matrix is on standard output. The occlusion method `method` may be null. Throws
// InputError if the matrix is too large for the file format, and Interrupted if the user interrupts the
// computation.
void WriteFormFactorMatrix(const Scene& scene, const MatrixArguments& arguments,
                           const OcclusionMethod* method, std::optional<double> tolerance);

}  // namespace penumbra
