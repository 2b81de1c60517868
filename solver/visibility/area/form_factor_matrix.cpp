#include "solver/visibility/area/form_factor_matrix.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "solver/base/processes.h"
#include "solver/base/size.h"
#include "solver/visibility/area/pair_counter.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {
namespace {

// Relative tolerance of the first estimate of a pair with blockers; it shows which pairs need more points.
constexpr double kRoughFactor = 1e-2;

// Pairs without blockers are computed at once to this fraction of the tolerance: they are cheap, and the rows
// may then spend their errors on the others.
constexpr double kClearShare = 1e-3;

// A pair whose error is at most this fraction of its share of a row's error is left as it is.
constexpr double kGoodEnough = 0.5;

// The points of a pair whose factor's error is at most the tolerance. Where many edges cast penumbras, each
// further digit takes three times as many points.
constexpr std::size_t kPointsOfPair = 100'000;

double AreaOf(const AreaPart& part) { return VectorArea(part.polygon).norm(); }

// Two parts that may see each other, and what passes between them.
struct PartExchange {
  std::size_t a, b;       // parts; a belongs to the patch with the lower number
  double exchange = 0;    // A_a F_ab = A_b F_ba [m^2]
  double error = 0;       // of it [m^2]
  double sufficient = 0;  // the error that the rows of both parts bear [m^2]
};

class MatrixBuilder {
 public:
  MatrixBuilder(const Scene& scene, std::span<const std::vector<AreaPart>> groups,
                const FormFactorMatrixOptions& options)
      : scene_(scene), options_(options), group_count_(groups.size()), area_(groups.size(), 0.0) {
    std::vector<PatchId> all(scene.patches.size());
    std::iota(all.begin(), all.end(), 0);
    patches_ = PatchHierarchy(scene, std::move(all));
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (const AreaPart& part : groups[g]) {
        parts_.push_back(&part);
        group_.push_back(g);
        area_[g] += AreaOf(part);
      }
  }

  FormFactorMatrix Build() {
    FindPairs();
    AreaFormFactorOptions rough = PairOptions();
    rough.tolerance = std::max(options_.tolerance, kRoughFactor);
    rough.clear_tolerance = std::max(rough.clear_tolerance, kClearShare * options_.tolerance);
    std::vector<std::size_t> all(pairs_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    Integrate("estimate", all, rough);
    Integrate("integrate", PairsToRefine(), PairOptions());
    return Matrix();
  }

 private:
  AreaFormFactorOptions PairOptions() const {
    AreaFormFactorOptions options;
    options.method = options_.method;
    options.context = options_.context;
    options.small_error = options_.tolerance;
    options.sufficient_points = kPointsOfPair;
    return options;
  }

  bool Cancelled() const { return options_.context && options_.context->Cancelled(); }

  // The pairs of parts of patches that may see each other.
  void FindPairs() {
    std::vector<std::vector<std::size_t>> of_patch(scene_.patches.size());
    for (std::size_t k = 0; k < parts_.size(); ++k)
      of_patch[static_cast<std::size_t>(parts_[k]->patch)].push_back(k);
    const ExecutionContext unheard;
    const PatchVisibility visibility(scene_, options_.context ? *options_.context : unheard);
    for (PatchId p = 0; p < Size(scene_.patches); ++p)
      for (const PatchPair& pair : visibility.SourcesOf(p)) {
        if (pair.source <= p) continue;
        for (const std::size_t a : of_patch[static_cast<std::size_t>(p)])
          for (const std::size_t b : of_patch[static_cast<std::size_t>(pair.source)])
            pairs_.push_back({a, b});
      }
  }

  void Integrate(const char* phase, std::span<const std::size_t> which,
                 const AreaFormFactorOptions& options) {
    PairCounter counter(options_.context, phase, which.size());
    const auto compute = [&](std::size_t i) {
      if (Cancelled()) return;
      PartExchange& pair = pairs_[which[i]];
      AreaFormFactorOptions how = options;
      if (pair.sufficient > 0) {
        how.tolerance = how.clear_tolerance = 0;
        how.sufficient_error = pair.sufficient;
      }
      const AreaPart &a = *parts_[pair.a], &b = *parts_[pair.b];
      const FormFactorEstimate found = AreaFormFactor(scene_, patches_, a, b, how);
      pair.exchange = found.factor * AreaOf(a);
      pair.error = found.error * AreaOf(a);
      counter.Add();
    };
    const auto transfer = [&](std::size_t i, auto& archive) {
      Transfer(archive, pairs_[which[i]].exchange);
      Transfer(archive, pairs_[which[i]].error);
    };
    DealOut({which.size(), 1, compute, transfer, transfer});
  }

  // Calls visit(pair, row) for both rows of each pair, in the order of the pairs.
  void ForBothRows(const auto& visit) {
    for (PartExchange& pair : pairs_) {
      visit(pair, group_[pair.a]);
      visit(pair, group_[pair.b]);
    }
  }

  // The pairs that make up too much of the error of a row, each with the error that its rows bear.
  std::vector<std::size_t> PairsToRefine() {
    std::vector<double> error(group_count_, 0.0);
    std::vector<std::size_t> inexact(group_count_, 0);
    ForBothRows([&](PartExchange& pair, std::size_t row) {
      error[row] += pair.error;
      inexact[row] += pair.error > 0;
    });
    ForBothRows([&](PartExchange& pair, std::size_t row) {
      const double allowed = options_.tolerance * area_[row];
      if (error[row] <= allowed) return;
      const double share = kGoodEnough * allowed / static_cast<double>(inexact[row]);
      if (pair.error > share)
        pair.sufficient = pair.sufficient > 0 ? std::min(pair.sufficient, share) : share;
    });
    std::vector<std::size_t> which;
    for (std::size_t k = 0; k < pairs_.size(); ++k)
      if (pairs_[k].sufficient > 0) which.push_back(k);
    return which;
  }

  // The exchanges of parts, added up for each pair of groups in the order of the parts' pairs: A_i F_ij and
  // A_j F_ji are the same sum.
  FormFactorMatrix Matrix() {
    struct Entry {
      std::size_t row;
      std::int32_t column;
      double exchange, error;
    };
    std::vector<Entry> entries;
    for (const PartExchange& pair : pairs_) {
      if (pair.exchange == 0 && pair.error == 0) continue;
      const std::size_t g = group_[pair.a], h = group_[pair.b];
      entries.push_back({g, static_cast<std::int32_t>(h), pair.exchange, pair.error});
      entries.push_back({h, static_cast<std::int32_t>(g), pair.exchange, pair.error});
    }
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& x, const Entry& y) {
      return std::pair(x.row, x.column) < std::pair(y.row, y.column);
    });
    FormFactorMatrix matrix;
    matrix.area = area_;
    matrix.pairs = pairs_.size();
    matrix.first.assign(group_count_ + 1, 0);
    for (std::size_t i = 0; i < entries.size();) {
      const std::size_t row = entries[i].row;
      const std::int32_t column = entries[i].column;
      double exchange = 0, error = 0;
      for (; i < entries.size() && entries[i].row == row && entries[i].column == column; ++i) {
        exchange += entries[i].exchange;
        error += entries[i].error;
      }
      matrix.column.push_back(column);
      matrix.factor.push_back(exchange / area_[row]);
      matrix.error.push_back(error / area_[row]);
      ++matrix.first[row + 1];
    }
    std::partial_sum(matrix.first.begin(), matrix.first.end(), matrix.first.begin());
    return matrix;
  }

  const Scene& scene_;
  const FormFactorMatrixOptions& options_;
  std::size_t group_count_;
  std::vector<double> area_;            // of each group [m^2]
  std::vector<const AreaPart*> parts_;  // of all groups
  std::vector<std::size_t> group_;      // of each part
  PatchHierarchy patches_;
  std::vector<PartExchange> pairs_;
};

}  // namespace

double FormFactorMatrix::RowSum(std::size_t row) const {
  return std::accumulate(factor.begin() + static_cast<std::ptrdiff_t>(first[row]),
                         factor.begin() + static_cast<std::ptrdiff_t>(first[row + 1]), 0.0);
}

double FormFactorMatrix::RowError(std::size_t row) const {
  return std::accumulate(error.begin() + static_cast<std::ptrdiff_t>(first[row]),
                         error.begin() + static_cast<std::ptrdiff_t>(first[row + 1]), 0.0);
}

void FormFactorMatrix::ReferTo(const std::vector<double>& areas) {
  for (std::size_t row = 0; row < Rows(); ++row) {
    const bool is_empty = first[row] == first[row + 1];
    if (areas[row] == 0 && !is_empty) continue;
    const double scale = is_empty ? 0 : area[row] / areas[row];
    for (std::size_t k = first[row]; k < first[row + 1]; ++k) {
      factor[k] *= scale;
      error[k] *= scale;
    }
    area[row] = areas[row];
  }
}

double FormFactorMatrix::ReciprocityError() const {
  double largest = 0;
  for (std::size_t i = 0; i < Rows(); ++i)
    for (std::size_t k = first[i]; k < first[i + 1]; ++k) {
      const auto j = static_cast<std::size_t>(column[k]);
      const auto begin = column.begin() + static_cast<std::ptrdiff_t>(first[j]);
      const auto end = column.begin() + static_cast<std::ptrdiff_t>(first[j + 1]);
      const auto back = std::lower_bound(begin, end, static_cast<std::int32_t>(i));
      const bool is_there = back != end && *back == static_cast<std::int32_t>(i);
      const double there = area[i] * factor[k];
      const double returned =
          is_there ? area[j] * factor[static_cast<std::size_t>(back - column.begin())] : 0;
      if (there > 0) largest = std::max(largest, std::abs(there - returned) / there);
    }
  return largest;
}

FormFactorMatrix ComputeFormFactorMatrix(const Scene& scene, std::span<const std::vector<AreaPart>> groups,
                                         const FormFactorMatrixOptions& options) {
  return MatrixBuilder(scene, groups, options).Build();
}

}  // namespace penumbra
