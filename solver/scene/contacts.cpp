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

struct ReachBox {
  Vec3 low, high;

  void Add(const ReachBox& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  bool Meets(const ReachBox& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

// Patches that are pieces of one flat face: none of them stands on another. Of a star of many spikes, each
// piece's box meets those of very many others.
struct FlatSheet {
  std::vector<PatchId> patches;
  ReachBox box;
};

// Whether the patch is a piece of the same flat face as another one.
bool IsPieceOf(const Patch& first, const Patch& patch, double diagonal) {
  // Within what a flat face's vertices deviate by, relative to the scene; and the sine of the angle by which
  // this turns the narrowest pieces that matter.
  constexpr double kFlat = 1e-6, kTurned = 1e-3;
  if (first.faces != patch.faces || first.normal.dot(patch.normal) <= 0) return false;
  if (first.normal.cross(patch.normal).norm() > kTurned) return false;
  for (const Vec3& v : patch.Vertices())
    if (std::abs(first.normal.dot(v - first.vertex[0])) > kFlat * diagonal) return false;
  return true;
}

std::vector<FlatSheet> SheetsOf(const Scene& scene) {
  const double diagonal = scene.Diagonal();
  std::vector<FlatSheet> sheets;
  for (PatchId p = 0; p < Size(scene.patches); ++p) {
    // The pieces of a face follow each other.
    if (p == 0 || !IsPieceOf(scene.patches[sheets.back().patches[0]], scene.patches[p], diagonal))
      sheets.emplace_back();
    sheets.back().patches.push_back(p);
  }
  return sheets;
}

}  // namespace

std::vector<Contact> FindContacts(const Scene& scene, PatchId receiver) {
  return ContactFinder(scene, receiver, ContactGap(scene)).Find();
}

// Sweeps along x for pairs of sheets whose boxes meet.
ContactSearch::ContactSearch(const Scene& scene)
    : scene_(scene), gap_(ContactGap(scene)), near_(scene.patches.size()) {
  std::vector<ReachBox> boxes;
  for (PatchId p = 0; p < Size(scene.patches); ++p) {
    const auto vertices = scene.patches[p].Vertices();
    ReachBox box{vertices[0], vertices[0]};
    for (const Vec3& v : vertices) box.Add({v, v});
    const double reach = gap_ + kMaxHangingHeight * Diameter(vertices);
    box.low.array() -= reach;
    box.high.array() += reach;
    boxes.push_back(box);
  }
  std::vector<FlatSheet> sheets = SheetsOf(scene);
  for (FlatSheet& sheet : sheets) {
    sheet.box = boxes[sheet.patches[0]];
    for (const PatchId p : sheet.patches) sheet.box.Add(boxes[p]);
  }
  std::stable_sort(sheets.begin(), sheets.end(),
                   [](const FlatSheet& p, const FlatSheet& q) { return p.box.low.x() < q.box.low.x(); });
  for (std::size_t i = 0; i < sheets.size(); ++i)
    for (std::size_t j = i + 1; j < sheets.size() && sheets[j].box.low.x() <= sheets[i].box.high.x(); ++j) {
      if (!sheets[i].box.Meets(sheets[j].box)) continue;
      for (const PatchId p : sheets[i].patches) {
        if (!boxes[p].Meets(sheets[j].box)) continue;
        for (const PatchId q : sheets[j].patches) {
          if (!boxes[p].Meets(boxes[q])) continue;
          near_[p].push_back(q);
          near_[q].push_back(p);
        }
      }
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
