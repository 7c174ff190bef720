#include "renderer/culling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vindu {
namespace {

constexpr std::size_t kRow = 8;
/// More than what single precision loses in a sum of seven products.
constexpr float kRounding = 1e-6f;

struct MiddleAndHalf {
  Eigen::Vector3f middle, half;  // half: and what rounding may lose
};

MiddleAndHalf parts_of(const Box3f& box) {
  const Eigen::Vector3f middle = box.center(), half = 0.5f * (1 + kRounding) * box.sizes();
  return {middle, half.array() + kRounding * middle.cwiseAbs().maxCoeff()};
}

}  // namespace

ViewPlanes::ViewPlanes(const Mat4& clip_from_world) {
  const Eigen::RowVector4d w = clip_from_world.row(3);
  Eigen::Matrix<double, 5, 4> rows;
  rows << w + clip_from_world.row(0), w - clip_from_world.row(0), w + clip_from_world.row(1),
      w - clip_from_world.row(1), w - clip_from_world.row(2);
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    const Eigen::Vector4f plane = rows.row(static_cast<Eigen::Index>(i)).cast<float>();
    planes_[i] = {plane.head<3>(), plane.head<3>().cwiseAbs(),
                  plane[3] + kRounding * std::abs(plane[3])};
  }
}

bool ViewPlanes::miss(const Box3f& box_in_world) const {
  const auto [middle, half] = parts_of(box_in_world);
  for (const Plane& plane : planes_)  // the farthest corner along its normal decides
    if (plane.normal.dot(middle) + plane.steepness.dot(half) + plane.offset < 0) return true;
  return false;
}

void BoxRows::add(const Box3f& box_in_world) {
  const std::size_t place = size_++ % kRow;
  if (place == 0) rows_.emplace_back();
  const auto [middle, half] = parts_of(box_in_world);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    rows_.back().middle[axis][place] = middle[axis];
    rows_.back().half[axis][place] = half[axis];
  }
}

std::vector<std::uint32_t> BoxRows::seen_by(const ViewPlanes& planes) const {
  std::vector<std::uint32_t> seen;
  for (std::size_t first = 0; first < size_; first += kRow) {
    const auto& [middle, half] = rows_[first / kRow];
    Eight least = Eight::Constant(std::numeric_limits<float>::infinity());
    for (const ViewPlanes::Plane& plane : planes.planes_)
      least = least.min(plane.normal[0] * middle[0] + plane.normal[1] * middle[1] +
                        plane.normal[2] * middle[2] + plane.steepness[0] * half[0] +
                        plane.steepness[1] * half[1] + plane.steepness[2] * half[2] + plane.offset);
    if ((least < 0).all()) continue;
    for (std::size_t place = 0; place < std::min(kRow, size_ - first); ++place)
      if (!(least[place] < 0)) seen.push_back(static_cast<std::uint32_t>(first + place));
  }
  return seen;
}

}  // namespace vindu
