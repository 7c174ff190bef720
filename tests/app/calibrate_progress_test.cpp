// What the terminal shows while live cameras are calibrated.
#include "app/calibrate_progress.h"

#include <gtest/gtest.h>

namespace vindu::app {
namespace {

CameraState camera(const std::string& name, bool connected) {
  return {
      .name = name, .connected = connected, .device = {}, .gaps = {}, .counts = {}, .trouble = {}};
}

class CalibrationProgress : public ::testing::Test {
 protected:
  CalibrationProgress() {
    for (const int of : {0, 0, 1}) {
      Observation seen;
      seen.camera = of;
      so_far_.observations.push_back(seen);
    }
  }
  const std::vector<CameraState> cameras_{camera("left", true), camera("ghost", false)};
  Capture so_far_;
};

TEST_F(CalibrationProgress, NamesACameraThatIsNotConnectedInsteadOfItsFigure) {
  const auto covered = [](const Capture&, std::size_t) { return "12 % covered"; };
  EXPECT_EQ(progress_line({.of_camera = covered}, so_far_, cameras_),
            "left: 12 % covered   ghost: not connected");
}

TEST_F(CalibrationProgress, CountsPicturesWhereNothingElseIsToldOfCameras) {
  EXPECT_EQ(progress_line({}, so_far_, cameras_), "left: 2 pictures   ghost: not connected");
}

TEST_F(CalibrationProgress, OfAllCamerasTogetherStillNamesOneThatIsNotConnected) {
  const auto touched = [](const Capture&) { return "2 of 5"; };
  EXPECT_EQ(progress_line({.of_all = touched}, so_far_, cameras_), "2 of 5   ghost: not connected");
}

}  // namespace
}  // namespace vindu::app
