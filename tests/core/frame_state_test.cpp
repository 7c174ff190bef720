// The hash of a frame's state: equal for equal states, different when any field is.
#include "core/frame_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <set>
#include <vector>

namespace vindu {
namespace {

FrameState some_state() {
  FrameState state;
  state.number = 17;
  state.photon_time = Time{} + std::chrono::milliseconds(283);
  state.navigation.wall_from_scene = {Quat(Eigen::AngleAxisd(0.3, Vec3::UnitY())), {1, 2, 3}};
  return state;
}

TouchPage some_page() { return {.points = {{{1, 2, 0}, "tile-0-0"}, {{3, 2, 0}, "tile-1-0"}}}; }

/// As a state that shows the page.
std::function<void(FrameState&)> page(const std::function<void(TouchPage&)>& change = {}) {
  return [change](FrameState& state) {
    state.touch_page = some_page();
    if (change) change(*state.touch_page);
  };
}

std::vector<std::function<void(FrameState&)>> pages() {
  return {page(),
          page([](TouchPage& page) { page.points.pop_back(); }),
          page([](TouchPage& page) { page.points[1].x_in_wall.x() += 1e-9; }),
          page([](TouchPage& page) { page.points[1].tile = "tile-1-1"; }),
          page([](TouchPage& page) { page.done = 1; }),
          page([](TouchPage& page) { page.held += 1e-9; }),
          page([](TouchPage& page) { page.remark = "no light"; }),
          page([](TouchPage& page) { page.ring_m += 1e-9; })};
}

TEST(FrameHash, IsEqualForEqualStates) { EXPECT_EQ(hash_of(some_state()), hash_of(some_state())); }

TEST(FrameHash, ChangesWithEveryField) {
  std::vector<std::function<void(FrameState&)>> changes = {
      [](FrameState& state) { state.number += 1; },
      [](FrameState& state) { state.photon_time += std::chrono::nanoseconds(1); },
      [](FrameState& state) { state.eye_in_wall.x() += 1e-9; },
      [](FrameState& state) { state.eye_in_wall.y() += 1e-9; },
      [](FrameState& state) { state.eye_in_wall.z() += 1e-9; },
      [](FrameState& state) { state.navigation.wall_from_scene.rotation.x() += 1e-9; },
      [](FrameState& state) { state.navigation.wall_from_scene.rotation.y() += 1e-9; },
      [](FrameState& state) { state.navigation.wall_from_scene.rotation.z() += 1e-9; },
      [](FrameState& state) { state.navigation.wall_from_scene.rotation.w() += 1e-9; },
      [](FrameState& state) { state.navigation.wall_from_scene.translation.x() += 1e-9; },
      [](FrameState& state) { state.navigation.wall_from_scene.translation.y() += 1e-9; },
      [](FrameState& state) { state.navigation.wall_from_scene.translation.z() += 1e-9; },
      [](FrameState& state) { state.navigation.scale += 1e-9; },
      [](FrameState& state) { state.animation_time_s += 1e-9; },
      [](FrameState& state) { state.clip = 1; },
      [](FrameState& state) { state.clip = -1; },
      [](FrameState& state) { state.mode = Mode::loop; },
      [](FrameState& state) { state.overlays = kStatistics; },
      [](FrameState& state) { state.pattern = Pattern::grid; },
      [](FrameState& state) { state.blank = true; }};
  std::ranges::copy(pages(), std::back_inserter(changes));
  std::set<std::uint64_t> hashes = {hash_of(some_state())};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    FrameState changed = some_state();
    changes[i](changed);
    EXPECT_TRUE(hashes.insert(hash_of(changed)).second) << "change " << i;
  }
}

TEST(ContentHash, IsThatOfWhatCanBeSeen) {
  FrameState same = some_state();
  same.number += 1;
  same.photon_time += std::chrono::seconds(1);
  same.mode = Mode::loop;
  EXPECT_EQ(content_hash_of(same), content_hash_of(some_state()));
  std::vector<std::function<void(FrameState&)>> changes = {
      [](FrameState& state) { state.eye_in_wall.x() += 1e-9; },
      [](FrameState& state) { state.navigation.wall_from_scene.rotation.w() += 1e-9; },
      [](FrameState& state) { state.navigation.wall_from_scene.translation.z() += 1e-9; },
      [](FrameState& state) { state.navigation.scale += 1e-9; },
      [](FrameState& state) { state.animation_time_s += 1e-9; },
      [](FrameState& state) { state.overlays = kStatistics; },
      [](FrameState& state) { state.pattern = Pattern::grid; },
      [](FrameState& state) { state.blank = true; }};
  std::ranges::copy(pages(), std::back_inserter(changes));
  std::set<std::uint64_t> hashes = {content_hash_of(some_state())};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    FrameState changed = some_state();
    changes[i](changed);
    EXPECT_TRUE(hashes.insert(content_hash_of(changed)).second) << "change " << i;
  }
}

TEST(ContentHash, DiffersInEveryFrameThatShowsItsFiguresUnlessItIsBlank) {
  const std::vector<std::function<void(FrameState&)>> shows = {
      [](FrameState& state) { state.overlays = kStatistics; },
      [](FrameState& state) { state.pattern = Pattern::counter; },
      [](FrameState& state) { state.pattern = Pattern::bar; }};
  for (const auto& show : shows) {
    FrameState one = some_state();
    show(one);
    FrameState next = one;
    next.number += 1;
    EXPECT_NE(content_hash_of(one), content_hash_of(next));
    one.blank = next.blank = true;
    EXPECT_EQ(content_hash_of(one), content_hash_of(next));
  }
}

TEST(ContentHash, OfAPatternThatStandsStillDoesNotCareForTheModelBehindIt) {
  FrameState one = some_state();
  one.pattern = Pattern::names;
  FrameState other = one;
  other.animation_time_s += 1;
  other.eye_in_wall.x() += 1;
  EXPECT_EQ(content_hash_of(one), content_hash_of(other));
  one.pattern = other.pattern = Pattern::eye;
  EXPECT_NE(content_hash_of(one), content_hash_of(other));
}

TEST(ContentHash, OfATouchPageDoesNotCareForWhatIsBehindIt) {
  FrameState one = some_state();
  one.touch_page = some_page();
  FrameState other = one;
  other.number += 1;
  other.eye_in_wall.x() += 1;
  for (const Pattern pattern : {Pattern::none, Pattern::eye, Pattern::bar, Pattern::counter}) {
    other.pattern = pattern;
    EXPECT_EQ(content_hash_of(one), content_hash_of(other)) << name_of(pattern);
    EXPECT_FALSE(shows_model(other));
    EXPECT_FALSE(shows_number(other));
  }
}

TEST(FrameHash, TellsExchangedCoordinatesApart) {
  FrameState one = some_state(), other = some_state();
  one.eye_in_wall = {1, 2, 3};
  other.eye_in_wall = {2, 1, 3};
  EXPECT_NE(hash_of(one), hash_of(other));
}

TEST(Mode, HasTheThesisNames) {
  EXPECT_EQ(name_of(Mode::loop), "loop");
  EXPECT_EQ(name_of(Mode::touch), "touch");
  EXPECT_EQ(name_of(Mode::track), "track");
}

}  // namespace
}  // namespace vindu
