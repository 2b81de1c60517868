// mesh/interpolants/hermite_surface.h
//
// The light on a quadrilateral patch as bicubic Hermite pieces over the leaves of an unrestricted quadtree,
// after Bastos, Goslin and Zhang, Efficient Rendering of Radiosity using Textures and Bicubic Reconstruction,
// 1996. The light is C1 on the whole patch, also across edges with T-vertices, and has the given values at
// all vertices, T-vertices included.
//
// The report says that derivatives are approximated from samples and that T-vertices keep their values, but
// not how. Here, the light is a sum over the levels of the quadtree. The bicubic piece of the root has the
// values and derivatives of the patch's corners. Each vertex of a finer level adds a product of two cubic
// Hermite functions, which vanish with their derivatives at the distance of one element of this level. The
// product corrects value, first derivatives and mixed derivative at the vertex. It extends over the coarse
// neighbour of a T-vertex by the size of the fine element, so that no edge needs a special treatment.

#pragma once

#include <unordered_map>
#include <vector>

#include "mesh/interpolants/vertex_light.h"
#include "solver/geometry/vec.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

class HermiteSurface {
 public:
  // The irradiance [W/m^2] and its derivatives by the coordinates (u, v) of the patch, which run from (0, 0)
  // at the patch's vertex 0 to (1, 1) at vertex 2.
  struct Jet {
    Rgb value = Rgb::Zero(), by_u = Rgb::Zero(), by_v = Rgb::Zero(), by_uv = Rgb::Zero();
  };

  // First derivatives at a vertex are those of the parabola through the vertex and its two nearest
  // neighbours along the line. Where a coarse leaf has no vertex on the line, the light of the coarser levels
  // replaces the neighbour. Mixed derivatives are the means over the leaves at the vertex. A light that is
  // quadratic in (u, v) is therefore reproduced up to rounding if the root has children, and a bilinear light
  // always. REQUIRES: the patch is a quadrilateral, and `light` has all vertices of its leaves.
  HermiteSurface(const ElementForest& forest, PatchId patch, const VertexLight& light);

  // The light at the point (u, v), 0 <= u, v <= 1. Values may be below 0 where neighbouring values differ
  // much.
  Jet At(double u, double v) const { return Below(levels_, u, v); }

 private:
  struct Neighbours;
  using Vertices = std::unordered_map<LatticePoint, Neighbours, LatticePointHash>;

  Jet Below(int levels, double u, double v) const;
  Rgb DerivativeBy(int axis, const LatticePoint& at, const Vertices& vertices,
                   const VertexLight& light) const;
  Rgb ValueAt(const LatticePoint& at, int level, const VertexLight& light) const;

  int levels_ = 1;  // the number of quadtree levels that have vertices
  // The correction at each vertex, added to the light of the coarser levels.
  std::unordered_map<LatticePoint, Jet, LatticePointHash> correction_;
};

}  // namespace penumbra
