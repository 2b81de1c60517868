// display/viewer/ray_picture.h
//
// Pictures by ray casting (RayShade, LerpShade, ReconstructedLight), computed in the background from coarse
// to fine: first every 16th pixel of every 16th row, then the pixels in between.

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "display/image.h"
#include "display/viewer/snapshot.h"
#include "solver/scene/scene.h"

namespace penumbra::viewer {

struct RayPictureKey {
  std::shared_ptr<const LightState> light;  // the solution from which exact irradiance is computed
  // the mesh whose interpolants the picture shows; null: the picture shows exact irradiance
  std::shared_ptr<const MeshState> mesh;
  Camera camera;
  int width = 0, height = 0;
  // The reconstruction from the vertices of leaves that the picture shows, if it shows one.
  std::optional<Reconstruction> reconstruction = {};

  bool operator==(const RayPictureKey& other) const;
};

// A RayPicture computes one picture at a time. A request for another picture cancels the computation of the
// present picture. Only the thread of the view may call the functions of RayPicture.
class RayPicture {
 public:
  RayPicture();
  ~RayPicture();
  RayPicture(const RayPicture&) = delete;
  RayPicture& operator=(const RayPicture&) = delete;

  // Starts or continues the computation of the picture `key`. If the computation of another picture has been
  // cancelled but has not yet ended, the call of Show() has no effect, and a later call starts the
  // computation.
  void Show(const RayPictureKey& key);
  // Cancels the running computation of the picture. Show() with the same key does not restart a cancelled
  // computation.
  void Cancel();
  // Cancels the running computation of the picture and discards the picture.
  void Clear();

  // True if a picture is being computed, or if Paint() has not yet copied all computed pixels.
  bool Busy() const;
  // The fraction of complete pixels of the last picture.
  double Fraction() const;

  // Copies the complete pixels of the ray picture into a picture of radiosity of the same size [W/m^2].
  // Pixels that are not complete get the value of a complete pixel nearby, if the computation, which goes
  // from coarse to fine, has already computed such a pixel. Paint() leaves all other pixels of the target
  // picture unchanged.
  void Paint(RgbImage* linear, std::vector<PixelKind>* kinds);

 private:
  struct Job;
  void Collect();

  std::unique_ptr<Job> job_;
  bool cancelled_ = false;  // true after a call of Cancel()
  bool painted_ = true;     // true if Paint() has copied all complete pixels
};

}  // namespace penumbra::viewer
