// solver/visibility/point/clipping.h
//
// Occlusion by clipping: the shadow of each blocker is cut out of the source as seen from the receiver point,
// and the rest is kept as convex pieces. Clipping is exact, and the fastest of the occlusion methods.

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

// Cuts the shadows of occluders out of polygons. A Clipper works on one image (the view from one point) at a
// time. A Clipper keeps its buffers from image to image; use one Clipper, borrowed by a Scratch, for many
// images.
class Clipper {
 public:
  // A range of occluders on the Clipper's stack, the candidates that may cover a polygon.
  struct Candidates {
    std::size_t first = 0, last = 0;
    bool empty() const { return first == last; }
  };

  Clipper();
  ~Clipper();
  Clipper(const Clipper&) = delete;
  Clipper& operator=(const Clipper&) = delete;

  // Removes the present image and its occluders.
  void Clear();
  // Starts a new image with the projection `frame`. The polygon `whole` must contain all polygons that are
  // passed to Narrow() and CutOut() later. Begin() returns the range of all occluders as candidates. The
  // occluders must exist until the next call of Begin() or Clear().
  Candidates Begin(const ImageFrame& frame, const ImagePolygon& whole, std::span<const Occluder> occluders);

  // Tests whether the candidate occluders cover the polygon. Returns kAll if a single candidate covers the
  // whole polygon. If Narrow() returns kPart, the candidates that may cover a part of the polygon have been
  // pushed on the stack, and `own` is their range. REQUIRES: the candidates are on top of the Clipper's stack
  // of occluders.
  Overlap Narrow(const ImagePolygon& polygon, const Candidates& candidates, Candidates* own);
  // Removes the entries of the occluder stack above the given candidates.
  void Restore(const Candidates& candidates);

  // Cuts the shadows of the candidate occluders out of the polygon. The visible pieces of the polygon that
  // remain are added to the list Visible(), with the owner `owner` and with a label for each edge of a piece.
  // `label` holds the labels of the polygon's edges; by default, the polygon's edges are labelled as edges of
  // the source. REQUIRES: Narrow() has returned the candidates for this polygon.
  void CutOut(const ImagePolygon& polygon, const Candidates& candidates, PieceOwner owner,
              std::span<const EdgeLabel> label = {});

  // Appends the given candidates to `occluders`, in the order in which they were passed to Begin().
  void List(const Candidates& candidates, std::vector<Occluder>& occluders) const;

  ImageEdges& Visible();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Calls visit(directions) for every convex visible piece of `source`, seen from a point with unit normal
// `normal`. The visible pieces do not overlap. REQUIRES: the source lies above the point's horizon, and the
// occluders lie in front of the source.
void ForEachVisiblePiece(const DirectionPolygon& source, std::span<const Occluder> occluders,
                         const Vec3& normal, const std::function<void(std::span<const Vec3>)>& visit);

// Sets factors[i] to the form factor of the point to the unoccluded part of parts[i]. VisibleFormFactors() is
// faster than one call of VisibleFormFactor() for each part. The error of each factor is at most
// kOcclusionError * (form factor of `whole`); for parts much smaller than `whole`,
// Clipping::VisibleFormFactor() is more accurate. REQUIRES: the parts lie in `whole` and do not overlap.
void VisibleFormFactors(const DirectionPolygon& whole, std::span<const DirectionPolygon> parts,
                        std::span<const Occluder> occluders, const Vec3& normal, std::span<double> factors);

class Clipping final : public OcclusionMethod {
 public:
  double VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                           const Vec3& normal) const override;
};

OcclusionRegistry::Method ClippingMethod();

}  // namespace penumbra
