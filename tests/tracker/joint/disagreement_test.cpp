// By how much cameras contradict each other, from how far their dots stand aside and from looks for
// a head that fail.
#include "tracker/joint/disagreement.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vindu {
namespace {

/// Ten seconds of two Wiimotes' reports.
void stand_aside(Disagreement& disagreement, double px) {
  for (int i = 0; i < 2000; ++i) disagreement.note_aside(px);
}

TEST(Disagreement, is_what_dots_stand_aside_by_where_that_is_more_than_usual) {
  Disagreement disagreement;
  stand_aside(disagreement, 1);
  EXPECT_EQ(disagreement.sigma_px(), 0);
  for (const double px : {1.5, 4.0, 9.0}) {
    stand_aside(disagreement, px);
    EXPECT_NEAR(disagreement.sigma_px(), px, 0.01);
  }
  stand_aside(disagreement, 100);
  EXPECT_NEAR(disagreement.sigma_px(), 12, 0.01);
}

TEST(Disagreement, ends_when_they_stand_aside_no_more) {
  Disagreement disagreement;
  stand_aside(disagreement, 9);
  for (int i = 0; i < 3; ++i) stand_aside(disagreement, 0.3);
  EXPECT_EQ(disagreement.sigma_px(), 0);
}

TEST(Disagreement, is_allowed_for_in_looks_that_fail_though_there_are_dots_enough) {
  Disagreement disagreement;
  double most_px = 0;
  for (int i = 0; i < 60; ++i) {
    disagreement.look_failed(/*dots_enough=*/true);
    most_px = std::max(most_px, disagreement.sigma_of_look_px());
  }
  EXPECT_EQ(most_px, 12);
  EXPECT_EQ(disagreement.sigma_px(), 0) << "nothing was found by it yet";
  disagreement.look_succeeded(5);
  EXPECT_EQ(disagreement.sigma_of_look_px(), 5);
}

TEST(Disagreement, is_not_allowed_for_where_too_little_is_seen) {
  Disagreement disagreement;
  for (int i = 0; i < 1000; ++i) {
    disagreement.look_failed(/*dots_enough=*/i % 2 == 0);
    EXPECT_EQ(disagreement.sigma_of_look_px(), 0);
    EXPECT_FALSE(disagreement.nothing_fits());
  }
}

TEST(Disagreement, is_given_up_after_seconds_and_forgotten_when_nobody_is_there) {
  Disagreement disagreement;
  for (int i = 0; i < 5000; ++i) disagreement.look_failed(true);
  EXPECT_TRUE(disagreement.nothing_fits());
  for (int i = 0; i < 100; ++i) disagreement.look_failed(false);
  EXPECT_FALSE(disagreement.nothing_fits());
}

}  // namespace
}  // namespace vindu
