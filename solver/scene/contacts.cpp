#include "solver/scene/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "solver/base/size.h"
#include "solver/geometry/segment_clip.h"
#include "solver/scene/tolerances.h"

namespace penumbra {
namespace {

// Finds the contacts of one receiver, one other patch after the other.
class ContactFinder {
 public:
  ContactFinder(const Scene& scene, PatchId receiver, double gap)
      : scene_(scene),
        id_(receiver),
        patch_(scene.patches[receiver]),
        snap_(SnapDistance(patch_)),
        gap_(gap),
        low_(patch_.vertex[0]),
        high_(patch_.vertex[0]) {
    for (const Vec3& v : patch_.Vertices()) {
      low_ = low_.cwiseMin((v.array() - gap_).matrix());
      high_ = high_.cwiseMax((v.array() + gap_).matrix());
    }
  }

  std::vector<Contact> Find() {
    for (std::size_t p = 0; p < scene_.patches.size(); ++p)
      if (static_cast<PatchId>(p) != id_) Meet(static_cast<PatchId>(p));
    return std::move(found_);
  }

  std::vector<Contact> Find(std::span<const PatchId> others) {
    for (const PatchId other : others) Meet(other);
    return std::move(found_);
  }

  std::vector<Contact> FindWalls(std::span<const PatchId> others) {
    lids_too_ = false;
    for (const PatchId other : others) {
      Meet(other);
      Hang(other);
    }
    return std::move(found_);
  }

 private:
  void Meet(PatchId other) {
    const Patch& patch = scene_.patches[other];
    std::array<double, 4> height{};
    bool above = false, below = false;
    double highest = 0;
    Vec3 low = patch.vertex[0], high = patch.vertex[0];
    for (std::int32_t k = 0; k < patch.size; ++k) {
      const Vec3& v = patch.vertex[k];
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
      const double h = patch_.normal.dot(v - patch_.vertex[0]);
      height[k] = std::abs(h) <= gap_ ? 0 : h;
      highest = std::max(highest, h);
      above = above || height[k] > 0;
      below = below || height[k] < 0;
    }
    if ((low.array() > high_.array()).any() || (high.array() < low_.array()).any()) return;
    if (!above && !below) {
      if (!lids_too_) return;
      // In the receiver's plane: a lid on it, unless it is a neighbour in the same plane that looks the same
      // way.
      if (patch.normal.dot(patch_.normal) > 0 && highest <= snap_) return;
      for (std::int32_t k = 0; k < patch.size; ++k)
        Add(patch.vertex[k], patch.vertex[(k + 1) % patch.size], other);
      return;
    }
    if (!above) return;  // it touches from behind
    std::vector<Vec3> met;
    for (std::int32_t k = 0; k < patch.size; ++k) {
      const std::int32_t next = (k + 1) % patch.size;
      if (height[k] == 0) met.push_back(patch.vertex[k]);
      if (height[k] * height[next] < 0)
        met.push_back(Between(patch.vertex[k], patch.vertex[next], height[k] / (height[k] - height[next])));
    }
    if (met.size() == 2) Add(met[0], met[1], other);
  }

  // The edges of a patch that hang closely above the receiver, from which the rest of the patch rises.
  void Hang(PatchId other) {
    const Patch& patch = scene_.patches[other];
    const auto height = [&](std::int32_t k) {
      return patch_.normal.dot(patch.vertex[k % patch.size] - patch_.vertex[0]);
    };
    double lowest = height(0), highest = lowest;
    for (std::int32_t k = 1; k < patch.size; ++k) {
      lowest = std::min(lowest, height(k));
      highest = std::max(highest, height(k));
    }
    if (lowest <= gap_) return;  // it touches
    for (std::int32_t k = 0; k < patch.size; ++k) {
      const Vec3 &a = patch.vertex[k], &b = patch.vertex[(k + 1) % patch.size];
      const double low = std::max(height(k), height(k + 1));
      if (low > kMaxHangingHeight * (b - a).norm() || highest <= 2 * low) continue;
      Add(a - height(k) * patch_.normal, b - height(k + 1) * patch_.normal, other);
    }
  }

  void Add(const Vec3& a, const Vec3& b, PatchId other) {
    const auto kept = ClipToPolygon(a, b, patch_.Vertices(), patch_.normal, snap_);
    if (!kept || ((*kept)[0] - (*kept)[1]).norm() <= snap_) return;
    // On the receiver's outline nothing lies beyond.
    for (std::int32_t k = 0; k < patch_.size; ++k) {
      const Vec3& v = patch_.vertex[k];
      const Vec3 inward = patch_.normal.cross((patch_.vertex[(k + 1) % patch_.size] - v).normalized());
      if (inward.dot((*kept)[0] - v) <= 2 * snap_ && inward.dot((*kept)[1] - v) <= 2 * snap_) return;
    }
    found_.push_back({(*kept)[0], (*kept)[1], other});
  }

  const Scene& scene_;
  PatchId id_;
  const Patch& patch_;
  double snap_, gap_;     // [m]
  Vec3 low_, high_;       // the receiver's bounding box, widened by the gap
  bool lids_too_ = true;  // what lies flat on the receiver
  std::vector<Contact> found_;
};

}  // namespace

std::vector<Contact> FindContacts(const Scene& scene, PatchId receiver) {
  return ContactFinder(scene, receiver, ContactGap(scene)).Find();
}

// Sweeps along x for pairs of patches whose boxes meet.
ContactSearch::ContactSearch(const Scene& scene)
    : scene_(scene), gap_(ContactGap(scene)), near_(scene.patches.size()) {
  struct Box {
    Vec3 low, high;
    PatchId patch;
  };
  std::vector<Box> boxes;
  for (PatchId p = 0; p < Size(scene.patches); ++p) {
    const auto vertices = scene.patches[p].Vertices();
    Box box{vertices[0], vertices[0], p};
    for (const Vec3& v : vertices) {
      box.low = box.low.cwiseMin(v);
      box.high = box.high.cwiseMax(v);
    }
    const double reach = gap_ + kMaxHangingHeight * Diameter(vertices);
    box.low.array() -= reach;
    box.high.array() += reach;
    boxes.push_back(box);
  }
  std::stable_sort(boxes.begin(), boxes.end(),
                   [](const Box& p, const Box& q) { return p.low.x() < q.low.x(); });
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].low.x() <= boxes[i].high.x(); ++j) {
      const Box &p = boxes[i], &q = boxes[j];
      if (p.low.y() > q.high.y() || q.low.y() > p.high.y()) continue;
      if (p.low.z() > q.high.z() || q.low.z() > p.high.z()) continue;
      near_[p.patch].push_back(q.patch);
      near_[q.patch].push_back(p.patch);
    }
  for (std::vector<PatchId>& near : near_) std::sort(near.begin(), near.end());
}

std::vector<Contact> ContactSearch::FindWalls(PatchId receiver) const {
  return ContactFinder(scene_, receiver, gap_).FindWalls(near_[receiver]);
}

std::vector<Contact> ContactSearch::Find(PatchId receiver) const {
  return ContactFinder(scene_, receiver, gap_).Find(near_[receiver]);
}

}  // namespace penumbra
