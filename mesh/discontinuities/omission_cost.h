// mesh/discontinuities/omission_cost.h
//
// What it costs to leave a discontinuity out of a mesh that has others already (thesis 8.2): on the cell of
// the leaf that the active lines leave around it, the error of a quadratic that knows nothing of the jumps
// along its line.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity_line.h"
#include "mesh/discontinuities/line_jumps.h"

namespace penumbra {

// A segment inside a leaf, with what jumps across its line there.
struct OmittedPart {
  std::size_t leaf = 0;
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();  // in the frame of the patch [m]
  LineJump jump;
};

// ErrorWithout() the part on a convex piece of the mesh that it runs through [W/m^2].
double ErrorOnPiece(const OmittedPart& part, std::span<const Vec2> piece);

class OmissionCost {
 public:
  // Begins the next discontinuity.
  void Begin() { first_part_.push_back(parts_.size()); }
  // A part of it, in a leaf of this outline and area, on which errors count that many times.
  void AddPart(const OmittedPart& part, const Polygon2& outline, double area, double scale) {
    parts_.push_back({part, area, scale, scale, outline, 0});
  }

  // Makes errors on every part count so many times as `scale` says, which is told how many times they count
  // on its leaf.
  void Rescale(const std::function<double(const OmittedPart&, double)>& scale) {
    for (Part& part : parts_) part.scale = scale(part.segment, part.leaf_scale);
  }

  // `inside` are for each leaf the numbers of those `active` lines that run through it, which only grow from
  // one call to the next; `own` is that of the discontinuity's own line, which does not count; -1 if that is
  // not active.

  struct Cost {
    double by_place = 0;
    double at_most = 0;  // the same, each part counted as its leaf is where that is more
  };

  // Of leaving out discontinuity i, root mean square over the leaves that it crosses [W/m^2]. Both fall when
  // lines become active.
  Cost Of(std::size_t i, std::int32_t own, std::span<const std::vector<std::int32_t>> inside,
          std::span<const DiscontinuityLine> active);
  std::size_t LeavesOf(std::size_t i) { return PartsOf(i).size(); }
  // The parts of discontinuity i in leaves that its line does not run through, where each costs at least so
  // much [W/m^2].
  std::vector<OmittedPart> PartsWithout(std::size_t i, std::int32_t own,
                                        std::span<const std::vector<std::int32_t>> inside,
                                        std::span<const DiscontinuityLine> active, double least);

 private:
  struct Part {
    OmittedPart segment;
    double leaf_area, leaf_scale, scale;
    Polygon2 cell;          // convex
    std::size_t lines = 0;  // of the leaf that have cut it
  };

  std::span<Part> PartsOf(std::size_t i);
  void CutByLines(Part& part, std::int32_t own, std::span<const std::vector<std::int32_t>> inside,
                  std::span<const DiscontinuityLine> active);
  void Cut(Part& part, const DirectedLine& line);

  std::vector<Part> parts_;
  std::vector<std::size_t> first_part_;
  Polygon2 kept_;
};

}  // namespace penumbra
