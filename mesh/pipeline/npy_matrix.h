// mesh/pipeline/npy_matrix.h

#pragma once

#include "mesh/pipeline/matrix_writer.h"

namespace penumbra {

MatrixWriterRegistry::Method NpyMatrixMethod();

}  // namespace penumbra
