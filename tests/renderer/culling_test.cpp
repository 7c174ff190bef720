// Which boxes a view sees, against the same by its definition in double precision.
#include "renderer/culling.h"

#include <gmock/gmock.h>

#include <numeric>
#include <random>

#include "renderer/view.h"

namespace vindu {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// How deep the box reaches into the half-space in which it lies least, metres of clip space; below
/// 0 it lies wholly outside of one. By its eight corners.
double depth_in(const Mat4& clip_from_world, const Box3f& box) {
  double least = std::numeric_limits<double>::infinity();
  const Eigen::RowVector4d w = clip_from_world.row(3), x = clip_from_world.row(0),
                           y = clip_from_world.row(1), z = clip_from_world.row(2);
  for (const Eigen::RowVector4d& plane :
       {Eigen::RowVector4d(w + x), Eigen::RowVector4d(w - x), Eigen::RowVector4d(w + y),
        Eigen::RowVector4d(w - y), Eigen::RowVector4d(w - z)}) {
    double farthest = -std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 point = box.corner(static_cast<Box3f::CornerType>(corner)).cast<double>();
      farthest = std::max(farthest, plane.dot(point.homogeneous()));
    }
    least = std::min(least, farthest);
  }
  return least;
}

/// Views from before the wall, near it and aside; boxes from a millimetre to ten metres.
class Boxes : public ::testing::Test {
 protected:
  double between(double least, double largest) {
    return std::uniform_real_distribution(least, largest)(random_);
  }
  View view() {
    for (;;) {
      const Vec3 low(between(-3, 3), between(-1, 1), 0);
      const TileCorners tile{low, low + Vec3(0.7, 0, between(-0.3, 0.3)), low + Vec3(0, 0.5, 0)};
      if (auto view = tile_view(tile, {between(-3, 3), between(-1, 1), between(0.3, 4)}))
        return *view;
    }
  }
  Box3f box() {
    const auto size = static_cast<float>(std::pow(10, between(-3, 1)));
    const Eigen::Vector3f low(static_cast<float>(between(-8, 8)),
                              static_cast<float>(between(-5, 5)),
                              static_cast<float>(between(-20, 5)));
    return {low, low + size * Eigen::Vector3f(1, static_cast<float>(between(0, 1)),
                                              static_cast<float>(between(0, 1)))};
  }

  std::mt19937_64 random_{7};
};

TEST_F(Boxes, AreMissedWhereTheyLieOutsideAndNeverElsewhere) {
  int missed = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const View view = this->view();
    const Box3f box = this->box();
    const double depth = depth_in(view.clip_from_world, box);
    const bool miss = ViewPlanes(view.clip_from_world).miss(box);
    EXPECT_FALSE(miss && depth >= 0) << depth;
    EXPECT_FALSE(!miss && depth < -1e-3) << depth;
    missed += miss;
  }
  EXPECT_GT(missed, 2000);
  EXPECT_LT(missed, 19500);
}

/// Moved to one of the planes, as near as single precision can say.
TEST_F(Boxes, AreNotMissedByRounding) {
  int inside = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const View view = this->view();
    const Eigen::RowVector4d plane = view.clip_from_world.row(3) - view.clip_from_world.row(0);
    const Eigen::Vector3f normal = plane.head<3>().transpose().cast<float>();
    Box3f box = this->box();
    for (int step = 0; step < 3; ++step)
      box.translate(-static_cast<float>(depth_in(view.clip_from_world, box)) /
                    normal.squaredNorm() * normal);
    if (depth_in(view.clip_from_world, box) < 0) continue;
    ++inside;
    ASSERT_FALSE(ViewPlanes(view.clip_from_world).miss(box));
  }
  EXPECT_GT(inside, 1000);
}

TEST_F(Boxes, ThatOnlyTouchAreSeen) {
  const TileCorners tile{{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}};
  const ViewPlanes planes(tile_view(tile, {0, 0, 1})->clip_from_world);
  const auto across = [](float left, float right) {
    return Box3f(Eigen::Vector3f(left, 0, -1), Eigen::Vector3f(right, 0.1f, -1));
  };
  EXPECT_FALSE(planes.miss(across(2, 3)));  // at a depth of 1 m the tile's right edge is at 2 m
  EXPECT_TRUE(planes.miss(across(2.0001f, 3)));
  EXPECT_FALSE(planes.miss(across(-3, -2)));
  EXPECT_TRUE(planes.miss(across(-3, -2.0001f)));
}

TEST_F(Boxes, InRowsAreSeenAsEachOfThemAlone) {
  for (const std::size_t count : {1, 7, 8, 9, 500}) {
    const ViewPlanes planes(view().clip_from_world);
    BoxRows rows;
    std::vector<std::uint32_t> expected;
    for (std::uint32_t index = 0; index < count; ++index) {
      const Box3f box = this->box();
      rows.add(box);
      if (!planes.miss(box)) expected.push_back(index);
    }
    EXPECT_EQ(rows.size(), count);
    EXPECT_EQ(rows.seen_by(planes), expected) << count;
  }
}

TEST_F(Boxes, ThatAreEmptyAreNotSeen) {
  const ViewPlanes planes(view().clip_from_world);
  BoxRows rows;
  EXPECT_THAT(rows.seen_by(planes), IsEmpty());
  Box3f everywhere(Eigen::Vector3f::Constant(-1e7f), Eigen::Vector3f::Constant(1e7f));
  rows.add(Box3f());
  rows.add(everywhere);
  EXPECT_TRUE(planes.miss(Box3f()));
  EXPECT_THAT(rows.seen_by(planes), ElementsAre(1));
}

}  // namespace
}  // namespace vindu
