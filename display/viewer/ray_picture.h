// display/viewer/ray_picture.h
//
// Pictures by ray casting (RayShade, LerpShade), computed in the background from coarse to fine: first every
// 16th pixel of every 16th row, then the pixels between.

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

// Computes one picture at a time. A request for another picture cancels the running one. For use by one
// thread, the view's.
class RayPicture {
 public:
  RayPicture();
  ~RayPicture();
  RayPicture(const RayPicture&) = delete;
  RayPicture& operator=(const RayPicture&) = delete;

  // Starts the picture, or continues it. If another picture is still being cancelled, the call has no effect;
  // a later call starts the picture.
  void Show(const RayPictureKey& key);
  // Cancels the running picture. Show() does not restart it.
  void Cancel();
  // Cancels the running picture and discards it.
  void Clear();

  // True if a picture is running, or pixels of it have not been painted yet.
  bool Busy() const;
  // The fraction of complete pixels of the last picture.
  double Fraction() const;

  // Copies the complete pixels into a picture of the same size [W/m^2 of radiosity]. A complete pixel also
  // fills neighbouring pixels of finer rounds that are missing. Other pixels remain unchanged.
  void Paint(RgbImage* linear, std::vector<PixelKind>* kinds);

 private:
  struct Job;
  void Collect();

  std::unique_ptr<Job> job_;
  bool cancelled_ = false;  // by a call of Cancel()
  bool painted_ = true;     // all complete pixels have been painted
};

}  // namespace penumbra::viewer
