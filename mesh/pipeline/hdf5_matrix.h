// mesh/pipeline/hdf5_matrix.h

#pragma once

#include "mesh/pipeline/matrix_writer.h"

namespace penumbra {

MatrixWriterRegistry::Method Hdf5MatrixMethod();

}  // namespace penumbra
