// mesh/pipeline/matrix_writers.h

#pragma once

#include "mesh/pipeline/matrix_writer.h"

namespace penumbra {

// The registry of all writers of form-factor matrices.
MatrixWriterRegistry& MatrixWriters();

}  // namespace penumbra
