#include "display/image.h"

#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra {

RgbImage Downsample(const RgbImage& image, int across, int down) {
  PENUMBRA_CHECK(across > 0 && image.width % across == 0 && down > 0 && image.height % down == 0);
  RgbImage small(image.width / across, image.height / down);
  const float weight = 1.0f / static_cast<float>(across * down);
  ParallelFor(static_cast<std::size_t>(small.height), 8, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (std::size_t c = 0; c < 3; ++c)
      for (int x = 0; x < small.width; ++x) {
        float sum = 0;
        for (int j = 0; j < down; ++j)
          for (int i = 0; i < across; ++i) sum += image.channel[c][image.Index(x * across + i, y * down + j)];
        small.channel[c][small.Index(x, y)] = sum * weight;
      }
  });
  return small;
}

}  // namespace penumbra
