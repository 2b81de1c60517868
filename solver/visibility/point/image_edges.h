// solver/visibility/point/image_edges.h
//
// Stores the outlines of many convex pieces of one image (the view from one point), and evaluates Lambert's
// form factor formula as one vectorised sum over all edges.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/visibility/point/image_frame.h"

namespace penumbra {

// The owner of a visible piece: the part of the source, or the group of parts, from which the piece was cut.
// The caller chooses the numbers of parts and groups of the source. A default-constructed PieceOwner is
// uninitialised.
class PieceOwner {
 public:
  PieceOwner() = default;

  static constexpr PieceOwner Part(std::int32_t number) { return PieceOwner(number, false); }
  static constexpr PieceOwner Group(std::size_t number) {
    return PieceOwner(static_cast<std::int32_t>(number), true);
  }

  constexpr bool IsGroup() const { return group_; }
  constexpr std::int32_t Number() const { return number_; }

 private:
  constexpr PieceOwner(std::int32_t number, bool group) : number_(number), group_(group) {}

  std::int32_t number_;
  bool group_;
};

class ImageEdges {
 public:
  struct Sum {
    double value = 0;   // 2 pi times the form factor of the polygon
    double angles = 0;  // the sum of the angles under which the point sees all edges of the polygon [rad]
  };

  void Clear();
  // Appends a convex polygon, given by the image coordinates of its vertices and the labels of its edges.
  void AddPiece(const double* x, const double* y, const EdgeLabel* label, int size, PieceOwner owner);

  std::size_t Pieces() const { return start_.size(); }
  PieceOwner Owner(std::size_t piece) const { return owner_[piece]; }
  // The index of the first edge of a piece; piece p has the edges [Begin(p), Begin(p + 1)).
  std::size_t Begin(std::size_t piece) const { return piece < start_.size() ? start_[piece] : label_.size(); }
  Vec2 Start(std::size_t edge) const { return {edge_[0][edge], edge_[1][edge]}; }
  Vec2 Difference(std::size_t edge) const { return {edge_[2][edge], edge_[3][edge]}; }
  // The centroid of a piece in the image; the first vertex if the area of the piece is zero.
  Vec2 Centroid(std::size_t piece) const;
  EdgeLabel Label(std::size_t edge) const { return label_[edge]; }

  // Lambert's sum over the edges of all pieces, for a point with unit normal `normal`. Lambert's sum is the
  // same for every SIMD vector width.
  Sum FormFactorSum(const ImageFrame& frame, const Vec3& normal);
  // The value 2 pi * (form factor of a piece), as computed by the last call of FormFactorSum().
  double PieceSum(std::size_t piece) const;
  // The form factor of a piece by quadrature, which has no cancellation.
  double PieceByQuadrature(const ImageFrame& frame, const Vec3& normal, std::size_t piece) const;

 private:
  // for each edge: x and y of its start, then x and y of (end - start)
  std::array<std::vector<double>, 4> edge_;
  std::vector<EdgeLabel> label_;
  std::vector<std::size_t> start_;  // start_[i] is the index of the first edge of piece i
  std::vector<PieceOwner> owner_;
  std::vector<double> term_, angle_;
};

}  // namespace penumbra
