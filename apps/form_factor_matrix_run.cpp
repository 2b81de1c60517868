#include "apps/form_factor_matrix_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include "apps/interruptible.h"
#include "apps/messages.h"
#include "apps/option_values.h"
#include "apps/output.h"
#include "mesh/pipeline/matrix_writers.h"
#include "solver/base/check.h"
#include "solver/base/file_endings.h"
#include "solver/base/stopwatch.h"
#include "solver/transport/points/free_area.h"

namespace penumbra {
namespace {

constexpr Choice<MatrixRows> kMatrixRows[] = {{"face", MatrixRows::kFaces}, {"object", MatrixRows::kObjects}};

constexpr const char* kTextFormat = "csv";  // of standard output

// The rows of the matrix, and the faces of each.
struct RowFaces {
  std::vector<std::string> names, objects;
  std::vector<std::vector<std::int32_t>> faces;
};

RowFaces RowsByFace(const Scene& scene) {
  RowFaces rows;
  for (std::size_t i = 0; i < scene.faces.size(); ++i) {
    const auto object = static_cast<std::size_t>(scene.faces[i].object);
    rows.names.push_back(std::to_string(i));
    rows.objects.push_back(object < scene.objects.size() ? scene.objects[object].name : "");
    rows.faces.push_back({static_cast<std::int32_t>(i)});
  }
  return rows;
}

// Objects of one name are one row, as for --from and --to. A face of several groups counts in the first.
RowFaces RowsByObject(const Scene& scene) {
  RowFaces rows;
  std::map<std::string, std::size_t> row_of;
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const std::string& name = scene.objects[o].name;
    const auto [place, is_new] = row_of.try_emplace(name, rows.names.size());
    if (is_new) {
      rows.names.push_back(name);
      rows.faces.emplace_back();
    }
    for (const std::int32_t face : scene.objects[o].faces)
      if (scene.faces[static_cast<std::size_t>(face)].object == static_cast<std::int32_t>(o))
        rows.faces[place->second].push_back(face);
  }
  return rows;
}

std::vector<std::vector<AreaPart>> PartsOfRows(const Scene& scene, const RowFaces& rows) {
  std::vector<std::vector<AreaPart>> groups;
  for (const std::vector<std::int32_t>& faces : rows.faces) {
    std::vector<AreaPart>& parts = groups.emplace_back();
    for (const std::int32_t face : faces)
      for (AreaPart& part : PartsOfFace(scene, face)) parts.push_back(std::move(part));
  }
  return groups;
}

// Of each row: 1 - reflectance, the mean of the channels and of the area; 1 where nothing is left of the row.
std::vector<double> AbsorptanceOf(const Scene& scene, const std::vector<std::vector<AreaPart>>& groups) {
  std::vector<double> absorptance;
  for (const std::vector<AreaPart>& parts : groups) {
    double area = 0, absorbed = 0;
    for (const AreaPart& part : parts) {
      const double a = VectorArea(part.polygon).norm();
      area += a;
      absorbed += a * (1 - scene.MaterialOf(part.patch).reflectance.mean());
    }
    absorptance.push_back(area > 0 ? absorbed / area : 1);
  }
  return absorptance;
}

// What the matrix holds, and how far the factors are from what they must add up to.
std::string MatrixSummary(const NamedMatrix& named, const char* what, double seconds) {
  const FormFactorMatrix& matrix = named.matrix;
  double low = INFINITY, high = -INFINITY, error = 0, row_error = 0;
  std::size_t with_area = 0, farthest = 0;
  for (std::size_t row = 0; row < matrix.Rows(); ++row) {
    if (matrix.area[row] == 0) continue;
    const double sum = matrix.RowSum(row);
    if (with_area++ == 0 || std::abs(sum - 1) > std::abs(matrix.RowSum(farthest) - 1)) farthest = row;
    low = std::min(low, sum);
    high = std::max(high, sum);
    row_error = std::max(row_error, matrix.RowError(row));
  }
  for (const double e : matrix.error) error = std::max(error, e);
  std::string text;
  const auto add = [&](const char* name, const std::string& value) {
    text += fmt::format("{:<14} {}\n", name, value);
  };
  add("rows", fmt::format("{} {}, {} of them with an area", matrix.Rows(), what, with_area));
  const double whole = std::accumulate(named.whole_area.begin(), named.whole_area.end(), 0.0);
  const double area = std::accumulate(matrix.area.begin(), matrix.area.end(), 0.0);
  add("area", fmt::format("{:.6g} m^2, without {:.3g} m^2 that other faces cover", area, whole - area));
  add("factors", fmt::format("{} that are not 0, from {} pairs", matrix.factor.size(), matrix.pairs));
  add("error",
      fmt::format("at most {:.2g} of a factor, {:.2g} of a row's sum, by estimate", error, row_error));
  if (with_area > 0)
    add("closure", fmt::format("rows add up to between {:.10g} and {:.10g}; row {} is farthest from 1", low,
                               high, named.names[farthest]));
  add("reciprocity", fmt::format("{:.2g} relative, at most", matrix.ReciprocityError()));
  add("seconds", fmt::format("{:.2f}", seconds));
  return text;
}

}  // namespace

void AddMatrixOptions(CLI::App& app, MatrixArguments* arguments) {
  constexpr const char* kGroup = "Matrix";
  app.add_flag("--all", arguments->all,
               "The whole matrix, from every face to every face, instead of one factor")
      ->group(kGroup);
  AddChoice(app, "--by", &arguments->by, kMatrixRows, "Of --all: what a row and a column of the matrix is")
      ->group(kGroup);
  std::string formats;
  for (const MatrixWriterRegistry::Method& format : MatrixWriters().methods())
    formats += fmt::format("; .{}: {}", format.name, format.help);
  app.add_option_function<std::string>(
         "-o,--output",
         [arguments](const std::string& path) {
           if (!FindByEnding(MatrixWriters(), path))
             throw CLI::ValidationError("-o", EndingError(path, MatrixWriters().Names()));
           arguments->output = path;
         },
         fmt::format("Of --all: the matrix (default: .{} on standard output){}", kTextFormat, formats))
      ->type_name("FILE")
      ->group(kGroup);
}

const char* MatrixRowsName(MatrixRows by) { return ChoiceName(kMatrixRows, by); }

void WriteFormFactorMatrix(const Scene& scene, const MatrixArguments& arguments,
                           const OcclusionMethod* method, std::optional<double> tolerance) {
  RowFaces rows = arguments.by == MatrixRows::kFaces ? RowsByFace(scene) : RowsByObject(scene);
  const std::unique_ptr<const MatrixWriter> writer =
      arguments.output ? FindByEnding(MatrixWriters(), *arguments.output)->make()
                       : MatrixWriters().Make(kTextFormat);
  if (writer->IsDense() && rows.names.size() > kMostDenseRows)
    throw InputError(
        fmt::format("{}: error: {} rows are too many for a dense matrix, which may have {}; give -o F.{}"
                    " or --by object",
                    *arguments.output, rows.names.size(), kMostDenseRows, kTextFormat));
  const std::vector<std::vector<AreaPart>> groups = PartsOfRows(scene, rows);
  NamedMatrix named;
  const Stopwatch watch;
  RunInterruptible([&](const ExecutionContext& context) {
    FormFactorMatrixOptions options;
    options.tolerance = tolerance.value_or(options.tolerance);
    options.method = method;
    options.context = &context;
    named.matrix = ComputeFormFactorMatrix(scene, groups, options);
    if (context.Cancelled()) return;
    named.whole_area = named.matrix.area;
    named.matrix.ReferTo(UncoveredAreas(scene, ContactParts(scene, context), groups));
  });
  const double seconds = watch.Seconds();
  named.names = std::move(rows.names);
  named.objects = std::move(rows.objects);
  named.absorptance = AbsorptanceOf(scene, groups);
  WriteResult(arguments.output, writer->Bytes(named));
  const std::string summary =
      MatrixSummary(named, arguments.by == MatrixRows::kFaces ? "faces" : "objects", seconds);
  if (arguments.output)
    WriteResult(std::nullopt, summary);
  else
    PrintText(summary);
}

}  // namespace penumbra
