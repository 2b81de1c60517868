// solver/visibility/point/clipping.h
//
// What blockers leave of a source, by clipping: the shadow of each blocker is cut out of the source, and the
// rest remains as convex pieces. Exact, and the fastest of the methods.

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "solver/visibility/point/image_edges.h"
#include "solver/visibility/point/image_frame.h"
#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {

// Cuts shadows out of the polygons of one image. Occluders and the lists of them keep their buffers from one
// image to the next: lease one for many (Scratch).
class Clipper {
 public:
  // Some of the occluders, on a stack.
  struct Candidates {
    std::size_t first = 0, last = 0;
    bool empty() const { return first == last; }
  };

  Clipper();
  ~Clipper();
  Clipper(const Clipper&) = delete;
  Clipper& operator=(const Clipper&) = delete;

  // Forgets the image.
  void Clear();
  // Turns to the image `frame` of `whole`, which holds all polygons to come. Returns all occluders as
  // candidates. The occluders must stay.
  Candidates Begin(const ImageFrame& frame, const ImagePolygon& whole, std::span<const Occluder> occluders);

  // How the candidates, which are on top of the stack, cover the polygon. kAll: one of them does alone.
  // kPart: those that may cover a part are pushed as `own`.
  Overlap Narrow(const ImagePolygon& polygon, const Candidates& candidates, Candidates* own);
  // Drops everything above.
  void Restore(const Candidates& candidates);

  // Cuts the candidates, which Narrow() found for this very polygon, out of it. What remains goes to
  // Visible(), with its owner and labels: `label` those of the polygon's edges, those of the source's if none
  // are given.
  void CutOut(const ImagePolygon& polygon, const Candidates& candidates, PieceOwner owner,
              std::span<const EdgeLabel> label = {});

  // The candidates as they came.
  void List(const Candidates& candidates, std::vector<Occluder>& occluders) const;

  ImageEdges& Visible();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Calls visit(directions) for every convex piece of `source` that none of the occluders covers; the pieces do
// not overlap. For a point with unit normal `normal`; the source lies above its horizon, the occluders before
// the source.
void ForEachVisiblePiece(const DirectionPolygon& source, std::span<const Occluder> occluders,
                         const Vec3& normal, const std::function<void(std::span<const Vec3>)>& visit);

// Writes the form factors of the point to what the occluders leave of each of the parts of a source, which
// lie in `whole` and do not overlap; faster than one after the other. Each is within kOcclusionError of the
// form factor of `whole`, which is more than Clipping loses of a part that is small beside it.
void VisibleFormFactors(const DirectionPolygon& whole, std::span<const DirectionPolygon> parts,
                        std::span<const Occluder> occluders, const Vec3& normal, std::span<double> factors);

class Clipping final : public OcclusionMethod {
 public:
  double VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                           const Vec3& normal) const override;
};

OcclusionRegistry::Method ClippingMethod();

}  // namespace penumbra
