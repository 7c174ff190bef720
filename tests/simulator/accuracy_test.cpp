// The accuracy that is asked of the tracker, on a few geometries and motions and with fewer poses
// than `vindu measure accuracy` has; the margins hold over seeds.
#include <gtest/gtest.h>

#include "simulator/moving_study.h"
#include "simulator/single_frame.h"

namespace vindu {
namespace {

FrameStudy frames(const CameraRow& row, const HeadConfig& head, int poses) {
  return study_frames({.row = row, .head = head, .poses = poses});
}

TEST(SingleFrame, ComesWithin15PercentOfTheBound) {
  const CameraRow rows[] = {{3, 2, 2}, {5, 1, 2}, {3, 2, 4}};
  const HeadConfig heads[] = {{}, four_led_head(), four_led_head()};
  for (int i = 0; i < 3; ++i) {
    const FrameStudy study = frames(rows[i], heads[i], 1000);
    EXPECT_LE(study.joint.eye_m, 1.15 * study.bound.eye_m) << i;
    EXPECT_GE(study.joint.eye_m, 0.9 * study.bound.eye_m) << i << ": better than possible";
    EXPECT_GE(study.joint.found, 0.99) << i;
    EXPECT_LE(study.joint.wrong, 0.005) << i;
  }
}

}  // namespace
}  // namespace vindu
