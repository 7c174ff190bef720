// By how much cameras contradict each other, from how far their dots stand aside and from looks for
// a head that fail.
#include "tracker/joint/disagreement.h"

#include <gtest/gtest.h>

#include <vector>

namespace vindu {
namespace {

/// Ten seconds of two Wiimotes' reports.
void stand_aside(Disagreement& disagreement, double px) {
  for (int i = 0; i < 2000; ++i) disagreement.note_aside(px);
}

TEST(Disagreement, is_what_dots_stand_aside_by_where_that_is_more_than_usual) {
  Disagreement disagreement;
  stand_aside(disagreement, 0.7);
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

TEST(Disagreement, is_at_least_what_a_head_was_found_with) {
  Disagreement disagreement;
  disagreement.found_with(5);
  disagreement.found_with(2);
  EXPECT_EQ(disagreement.sigma_px(), 5);
}

TEST(FailedLooks, allow_for_more_and_more_and_for_nothing_in_between) {
  FailedLooks looks;
  std::vector<double> tried_px;
  for (int i = 0; i < 60; ++i) {
    looks.add(/*dots_enough=*/true);
    if (tried_px.empty() || tried_px.back() != looks.tried_px())
      tried_px.push_back(looks.tried_px());
  }
  EXPECT_EQ(tried_px, (std::vector<double>{0, 2, 5, 12, 0, 2}));
  looks.forget();
  EXPECT_EQ(looks.tried_px(), 0);
}

TEST(FailedLooks, allow_for_nothing_where_too_little_is_seen) {
  FailedLooks looks;
  for (int i = 0; i < 1000; ++i) {
    looks.add(/*dots_enough=*/i % 2 == 0);
    EXPECT_EQ(looks.tried_px(), 0);
    EXPECT_FALSE(looks.baffled());
  }
}

TEST(FailedLooks, are_baffled_after_seconds_until_nobody_is_there) {
  FailedLooks looks;
  for (int i = 0; i < 5000; ++i) looks.add(true);
  EXPECT_TRUE(looks.baffled());
  for (int i = 0; i < 100; ++i) looks.add(false);
  EXPECT_FALSE(looks.baffled());
}

}  // namespace
}  // namespace vindu
