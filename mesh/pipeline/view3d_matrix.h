// mesh/pipeline/view3d_matrix.h

#pragma once

#include "mesh/pipeline/matrix_writer.h"

namespace penumbra {

MatrixWriterRegistry::Method View3dMatrixMethod();

}  // namespace penumbra
