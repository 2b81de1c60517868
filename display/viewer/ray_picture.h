// display/viewer/ray_picture.h
//
// Pictures by rays (RayShade, LerpShade) worked out beside the view, coarse to fine: every 16th pixel of
// every 16th row first, then those between.

#pragma once

#include <memory>
#include <vector>

#include "display/image.h"
#include "display/viewer/snapshot.h"
#include "solver/scene/scene.h"

namespace penumbra::viewer {

struct RayPictureKey {
  std::shared_ptr<const LightState> light;  // what exact irradiance comes from
  std::shared_ptr<const MeshState> mesh;    // whose interpolants are shown; null: exact irradiance
  Camera camera;
  int width = 0, height = 0;

  bool operator==(const RayPictureKey& other) const;
};

// One picture at a time; asking for another ends the one under way. For one thread, that of the view.
class RayPicture {
 public:
  RayPicture();
  ~RayPicture();
  RayPicture(const RayPicture&) = delete;
  RayPicture& operator=(const RayPicture&) = delete;

  // Starts the picture, or goes on with it. Where the last one still has to end, nothing happens until it
  // did.
  void Show(const RayPictureKey& key);
  // Ends what is under way, and does not begin with that picture again.
  void Cancel();
  // Ends what is under way, and forgets it.
  void Clear();

  // Something is under way, or was not painted yet.
  bool Busy() const;
  // The part of the pixels that are there, of the picture asked for last.
  double Fraction() const;

  // Puts the pixels that are there into a picture of the same size, each also where the finer ones beside it
  // are missing, and leaves the others. Radiosity [W/m^2].
  void Paint(RgbImage* linear, std::vector<PixelKind>* kinds);

 private:
  struct Job;
  void Collect();

  std::unique_ptr<Job> job_;
  bool cancelled_ = false;  // by the user
  bool painted_ = true;     // all that is there
};

}  // namespace penumbra::viewer
