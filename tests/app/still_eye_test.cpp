// The eye to show: without the trembling that its tracker knows of.
#include "app/still_eye.h"

#include <gmock/gmock.h>

#include <cmath>

namespace vindu::app {
namespace {

Site one_screen() {
  Site site;
  site.wall = single_screen(0.6, 0.34, 1600, 900);
  site.heads.resize(1);
  return site;
}

/// Trembles by 3 mm, which moves what is far behind the screen by many pixels.
EyeNow trembling(int tick) {
  return {.eye_in_wall = {0.003 * std::sin(2.4 * tick), 0, 0.7}, .tracked = true};
}

/// What is shown after two seconds of `now_of`, in the next half of one: how many places.
template <class NowOf>
int places_shown(StillEye& still, NowOf now_of) {
  int places = 0;
  Vec3 last = Vec3::Zero();
  for (int tick = 0; tick < 150; ++tick) {
    const Vec3 eye = still.at(now_of(tick), {}, Time{} + from_seconds(tick / 60.0));
    if (tick >= 120 && eye != last) ++places;
    last = eye;
  }
  return places;
}

TEST(StillEye, StandsStillWhereTheTrackerSaysThatItTremblesSo) {
  const Site site = one_screen();
  StillEye still(site);
  const auto known = [](int tick) {
    EyeNow eye = trembling(tick);
    eye.pose.emplace().covariance.diagonal().head<3>().setConstant(0.003 * 0.003);
    return eye;
  };
  EXPECT_LE(places_shown(still, known), 3);
}

TEST(StillEye, FollowsAnEyeThatMovesAsMuchByItself) {
  const Site site = one_screen();
  StillEye still(site);
  EXPECT_GT(places_shown(still, trembling), 20);
}

}  // namespace
}  // namespace vindu::app
