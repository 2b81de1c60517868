// display/viewer/ray_picture.h
//
// Pictures by ray casting (RayShade, LerpShade), computed in the background from coarse to fine: first every
// 16th pixel of every 16th row, then the pixels between these.

#pragma once

#include <memory>
#include <vector>

#include "display/image.h"
#include "display/viewer/snapshot.h"
#include "solver/scene/scene.h"

namespace penumbra::viewer {

struct RayPictureKey {
  std::shared_ptr<const LightState> light;  // the source of exact irradiance
  std::shared_ptr<const MeshState> mesh;    // the mesh whose interpolants are shown; null: exact irradiance
  Camera camera;
  int width = 0, height = 0;

  bool operator==(const RayPictureKey& other) const;
};

// Computes one picture at a time. A request for another picture cancels the running computation. Only the
// thread of the view may call the functions.
class RayPicture {
 public:
  RayPicture();
  ~RayPicture();
  RayPicture(const RayPicture&) = delete;
  RayPicture& operator=(const RayPicture&) = delete;

  // Starts the computation of the picture, or continues it. If the computation of another picture has been
  // cancelled but has not yet ended, the call has no effect, and a later call starts the computation.
  void Show(const RayPictureKey& key);
  // Cancels the running computation. Show() with the same key does not restart the computation.
  void Cancel();
  // Cancels the running computation and discards the picture.
  void Clear();

  // True if a picture is being computed, or if Paint() has not yet copied all computed pixels.
  bool Busy() const;
  // The fraction of complete pixels of the last picture.
  double Fraction() const;

  // Copies the complete pixels into a picture of the same size [W/m^2 of radiosity]. Pixels that a finer
  // round has yet to compute get the value of a complete pixel in their neighbourhood. Other pixels remain
  // unchanged.
  void Paint(RgbImage* linear, std::vector<PixelKind>* kinds);

 private:
  struct Job;
  void Collect();

  std::unique_ptr<Job> job_;
  bool cancelled_ = false;  // by a call of Cancel()
  bool painted_ = true;     // all complete pixels have been painted
};

}  // namespace penumbra::viewer
