// apps/form_factor_matrix_run.h
//
// The whole matrix of form factors, for `penumbra form-factor --all`.

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
  bool all = false;  // the matrix is asked for
  MatrixRows by = MatrixRows::kFaces;
  std::optional<std::string> output;
};

// Adds --all, --by and -o.
void AddMatrixOptions(CLI::App& app, MatrixArguments* arguments);

// The name of MatrixArguments::by.
const char* MatrixRowsName(MatrixRows by);

// Computes the matrix of the scene, and writes it to MatrixArguments::output, or as CSV to standard output.
// Errors, closure, reciprocity and seconds are told on the other of standard output and standard error.
// `method` may be null. Throws InputError if the matrix is too large for the format, and Interrupted.
void WriteFormFactorMatrix(const Scene& scene, const MatrixArguments& arguments,
                           const OcclusionMethod* method, std::optional<double> tolerance);

}  // namespace penumbra
