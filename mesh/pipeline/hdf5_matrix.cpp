#include "mesh/pipeline/hdf5_matrix.h"

#include "mesh/pipeline/hdf5_image.h"

namespace penumbra {
namespace {

class Hdf5Matrix : public MatrixWriter {
 public:
  std::string Bytes(const NamedMatrix& named) const override {
    const FormFactorMatrix& matrix = named.matrix;
    const std::size_t n = matrix.Rows();
    Hdf5Writer file;
    const auto add = [&](const char* path, const std::vector<double>& values, const ArrayShape& shape,
                         const char* unit, const char* what) {
      file.Write(path, ScalarType::kDouble, shape, values.data());
      file.WriteAttribute(path, "units", unit);
      file.WriteAttribute(path, "description", what);
    };
    add("F", Dense(matrix, matrix.factor), {n, n}, "1",
        "F[i, j]: the fraction of the diffuse flux that leaves the front of i and reaches the front of j");
    add("error", Dense(matrix, matrix.error), {n, n}, "1", "an upper estimate of the error of F");
    add("area", matrix.area, {n}, "m^2", "the area of each front that nothing covers");
    add("whole_area", named.whole_area, {n}, "m^2", "the area of each front with what is covered");
    std::vector<double> sums;
    for (std::size_t row = 0; row < n; ++row) sums.push_back(matrix.RowSum(row));
    add("closure", sums, {n}, "1", "the sum of each row of F: 1 in a closed scene");
    add("data", matrix.factor, {matrix.factor.size()}, "1",
        "the entries of F that are not 0, as sparse rows (CSR) with indices and indptr");
    file.Write("indices", ScalarType::kInt32, {matrix.column.size()}, matrix.column.data());
    const std::vector<std::int32_t> first(matrix.first.begin(), matrix.first.end());
    file.Write("indptr", ScalarType::kInt32, {first.size()}, first.data());
    file.WriteStrings("names", named.names);
    if (!named.objects.empty()) file.WriteStrings("objects", named.objects);
    return file.Finish();
  }
};

}  // namespace

MatrixWriterRegistry::Method Hdf5MatrixMethod() {
  return {
      "h5", "HDF5: F, error, area, closure and names, and F as sparse rows: data, indices, indptr", {}, [] {
        return std::make_unique<const Hdf5Matrix>();
      }};
}

}  // namespace penumbra
