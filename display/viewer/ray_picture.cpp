#include "display/viewer/ray_picture.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

#include "display/glm_conversion.h"
#include "display/ray_display.h"
#include "solver/base/parallel.h"
#include "solver/base/progress.h"

namespace penumbra::viewer {
namespace {

constexpr int kCoarsest = 16;               // pixels between those of the first round, a power of two
constexpr std::size_t kPixelsAtOnce = 128;  // between two looks at whether to go on

bool SameCamera(const Camera& a, const Camera& b) {
  return a.eye == b.eye && a.look_at == b.look_at && a.up == b.up && a.vertical_fov == b.vertical_fov;
}

}  // namespace

bool RayPictureKey::operator==(const RayPictureKey& other) const {
  return light == other.light && mesh == other.mesh && SameCamera(camera, other.camera) &&
         width == other.width && height == other.height && reconstruction == other.reconstruction;
}

struct RayPicture::Job {
  explicit Job(const RayPictureKey& the_key)
      : key(the_key),
        display(key.light->scene(),
                key.reconstruction ? RayShader()
                : key.mesh         ? LerpShade(key.light->scene(), key.mesh->mesh())
                                   : RayShade(key.light->scene(), key.light->Exact()),
                1),
        rays(MakePixelRays(key.camera, key.width, key.height)),
        linear(key.width, key.height),
        kind(linear.PixelCount(), PixelKind::kBackground),
        known(linear.PixelCount(), 0) {}
  ~Job() {
    context.Cancel();
    if (thread.joinable()) thread.join();
  }

  void Work() {
    if (key.reconstruction) {
      const auto light = key.light->Reconstructed(*key.reconstruction, context);
      if (light) display.SetShader(light->Shade(key.camera, key.width, key.height));
    }
    for (int stride = kCoarsest; stride > 0 && !context.Cancelled(); stride /= 2) Round(stride);
    done = true;
  }

  // The pixels whose place is a multiple of the stride, without those of the rounds before.
  void Round(int stride) {
    std::vector<std::size_t> pixels;
    for (int y = 0; y < key.height; y += stride)
      for (int x = 0; x < key.width; x += stride)
        if (stride == kCoarsest || x % (2 * stride) != 0 || y % (2 * stride) != 0)
          pixels.push_back(linear.Index(x, y));
    std::vector<RaySample> samples(kPixelsAtOnce);
    for (std::size_t begin = 0; begin < pixels.size() && !context.Cancelled(); begin += kPixelsAtOnce) {
      const std::size_t count = std::min(kPixelsAtOnce, pixels.size() - begin);
      const auto width = static_cast<std::size_t>(key.width);
      ParallelFor(count, 8, [&](std::size_t i) {
        const std::size_t pixel = pixels[begin + i];
        samples[i] = display.Sample(rays, static_cast<double>(pixel % width) + 0.5,
                                    static_cast<double>(pixel / width) + 0.5);
      });
      const std::lock_guard lock(mutex);
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t pixel = pixels[begin + i];
        linear.Set(pixel, ToPixel(samples[i].radiosity));
        kind[pixel] = samples[i].kind;
        known[pixel] = 1;
      }
      count_known += count;
    }
  }

  RayPictureKey key;
  RayDisplay display;
  PixelRays rays;
  ExecutionContext context;
  std::mutex mutex;  // guards what follows, until it is done
  RgbImage linear;
  std::vector<PixelKind> kind;
  std::vector<char> known;
  std::atomic<std::size_t> count_known{0};
  std::atomic<bool> done{false};
  std::thread thread;
};

RayPicture::RayPicture() = default;
RayPicture::~RayPicture() = default;

void RayPicture::Show(const RayPictureKey& key) {
  if (job_ && job_->key == key) return;
  if (job_ && !job_->done) {
    job_->context.Cancel();
    return;
  }
  job_ = std::make_unique<Job>(key);
  cancelled_ = false;
  painted_ = false;
  job_->thread = std::thread([job = job_.get()] { job->Work(); });
}

void RayPicture::Cancel() {
  if (!job_ || job_->done) return;
  job_->context.Cancel();
  cancelled_ = true;
}

void RayPicture::Clear() {
  if (!job_) return;
  job_->context.Cancel();
  if (job_->done) job_.reset();
  painted_ = true;
}

bool RayPicture::Busy() const { return job_ && (!job_->done || !painted_); }

double RayPicture::Fraction() const {
  return job_ ? static_cast<double>(job_->count_known) / static_cast<double>(job_->known.size()) : 0;
}

void RayPicture::Paint(RgbImage* linear, std::vector<PixelKind>* kinds) {
  if (!job_ || job_->linear.width != linear->width || job_->linear.height != linear->height) return;
  const bool whole = job_->done;
  const std::lock_guard lock(job_->mutex);
  for (int y = 0; y < linear->height; ++y)
    for (int x = 0; x < linear->width; ++x)
      for (int stride = 1; stride <= kCoarsest; stride *= 2) {
        const std::size_t from = linear->Index(x - x % stride, y - y % stride);
        if (!job_->known[from]) continue;
        const std::size_t to = linear->Index(x, y);
        linear->Set(to, job_->linear.At(from));
        (*kinds)[to] = job_->kind[from];
        break;
      }
  painted_ = whole;
}

}  // namespace penumbra::viewer
