// solver/visibility/point/clipping.h
//
// Occlusion by clipping: cuts the shadow of each blocker out of the source and keeps the rest as convex
// pieces. Clipping is exact, and the fastest of the occlusion methods.

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

// Cuts shadows out of the polygons of one image at a time. A clipper keeps its buffers from image to image;
// use one clipper, borrowed by a Scratch, for many images.
class Clipper {
 public:
  // A range on the clipper's stack of occluders.
  struct Candidates {
    std::size_t first = 0, last = 0;
    bool empty() const { return first == last; }
  };

  Clipper();
  ~Clipper();
  Clipper(const Clipper&) = delete;
  Clipper& operator=(const Clipper&) = delete;

  // Forgets the image and its occluders.
  void Clear();
  // Starts a new image with the projection `frame`. The polygon `whole` contains all polygons that are passed
  // to Narrow() and CutOut() later. Returns all occluders as candidates. The occluders must exist until the
  // next Begin() or Clear().
  Candidates Begin(const ImageFrame& frame, const ImagePolygon& whole, std::span<const Occluder> occluders);

  // Tests how the candidates cover the polygon. Returns kAll if a single candidate covers the whole polygon.
  // If Narrow() returns kPart, it has pushed the candidates that may cover a part of the polygon on the
  // stack, and has set `own` to their range. REQUIRES: the candidates are on top of the stack.
  Overlap Narrow(const ImagePolygon& polygon, const Candidates& candidates, Candidates* own);
  // Pops the entries of the stack above the candidates.
  void Restore(const Candidates& candidates);

  // Cuts the candidates out of the polygon and adds the remaining pieces to Visible(), with the owner `owner`
  // and the labels of their edges. `label` holds the labels of the polygon's edges; by default, the polygon's
  // edges are labelled as edges of the source. REQUIRES: Narrow() returned the candidates for this polygon.
  void CutOut(const ImagePolygon& polygon, const Candidates& candidates, PieceOwner owner,
              std::span<const EdgeLabel> label = {});

  // Appends the candidates to `occluders`, in the order of Begin().
  void List(const Candidates& candidates, std::vector<Occluder>& occluders) const;

  ImageEdges& Visible();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Calls visit(directions) for every convex piece of `source` that no occluder covers, for a point with unit
// normal `normal`. The pieces do not overlap. REQUIRES: the source lies above the point's horizon, and the
// occluders lie before the source.
void ForEachVisiblePiece(const DirectionPolygon& source, std::span<const Occluder> occluders,
                         const Vec3& normal, const std::function<void(std::span<const Vec3>)>& visit);

// Sets factors[i] to the form factor of the point to the unoccluded part of parts[i], a part of a source;
// faster than one call of VisibleFormFactor() for each part. Each error is at most kOcclusionError * (form
// factor of `whole`); for parts much smaller than `whole`, Clipping::VisibleFormFactor() is
// more accurate. REQUIRES: the parts lie in `whole` and do not overlap.
void VisibleFormFactors(const DirectionPolygon& whole, std::span<const DirectionPolygon> parts,
                        std::span<const Occluder> occluders, const Vec3& normal, std::span<double> factors);

class Clipping final : public OcclusionMethod {
 public:
  double VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                           const Vec3& normal) const override;
};

OcclusionRegistry::Method ClippingMethod();

}  // namespace penumbra
