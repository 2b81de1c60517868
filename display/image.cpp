#include "display/image.h"

#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra {

RgbImage Downsample(const RgbImage& image, int k) {
  PENUMBRA_CHECK(k > 0 && image.width % k == 0 && image.height % k == 0);
  RgbImage small(image.width / k, image.height / k);
  const float weight = 1.0f / static_cast<float>(k * k);
  ParallelFor(static_cast<std::size_t>(small.height), 8, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (std::size_t c = 0; c < 3; ++c)
      for (int x = 0; x < small.width; ++x) {
        float sum = 0;
        for (int j = 0; j < k; ++j)
          for (int i = 0; i < k; ++i) sum += image.channel[c][image.Index(x * k + i, y * k + j)];
        small.channel[c][small.Index(x, y)] = sum * weight;
      }
  });
  return small;
}

}  // namespace penumbra
