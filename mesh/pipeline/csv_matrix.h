// mesh/pipeline/csv_matrix.h

#pragma once

#include "mesh/pipeline/matrix_writer.h"

namespace penumbra {

MatrixWriterRegistry::Method CsvMatrixMethod();

}  // namespace penumbra
