// The test that matters: an eye looks, the tiles draw, and their pictures are compared with what an
// ordinary camera at the eye sees. With the true eye the geometry must be right to a fraction of a
// pixel; with the tracked eye the displacement is what tracking costs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/clock.h"
#include "renderer/surface.h"
#include "renderer/wall_renderer.h"
#include "simulator/emulated_room.h"
#include "tests/closed_loop/displacement.h"
#include "tests/closed_loop/position_code.h"
#include "tracker/tracker.h"
#include "tracker/wiimote/reader.h"

namespace vindu::test {
namespace {

Site thesis_site() { return read_site(VINDU_SOURCE_DIR "/assets/walls/tromso.toml"); }

WallGrid thesis_grid() { return thesis_site().wall.grid; }

Wall flat_wall() { return expand_wall(thesis_grid(), {}, {}); }

Wall wall_with_bezels() {
  WallGrid grid = thesis_grid();
  grid.bezel_x_mm = 12;
  grid.bezel_y_mm = 9;
  return expand_wall(grid, {}, {});
}

Wall curved_wall() {
  WallGrid grid = thesis_grid();
  grid.curve_deg = 30;
  return expand_wall(grid, {}, {});
}

/// The middle tile of the second row leans and is turned out of the wall's plane.
Wall wall_with_tilted_tile() {
  const Wall flat = flat_wall();
  const TileCorners& corners = flat.find("tile-3-1")->corners;
  const Quat turn = Quat(Eigen::AngleAxisd(radians(18), Vec3::UnitY())) *
                    Quat(Eigen::AngleAxisd(radians(9), Vec3::UnitX()));
  const Vec3 middle = corners.centre_in_wall(), out(0, 0, 0.12);
  const auto turned = [&](const Vec3& corner) {
    return Vec3(middle + out + turn * (corner - middle));
  };
  const TileCorners tilted{turned(corners.lower_left_in_wall), turned(corners.lower_right_in_wall),
                           turned(corners.upper_left_in_wall)};
  return expand_wall(thesis_grid(),
                     {{.name = "tile-3-1", .corners = tilted, .host = {}, .mount = {}}}, {});
}

constexpr double kFineCell_m = 0.05, kCoarseCell_m = 0.25;

const Vec3 kMiddle(0, 0.1, 2.0), kFarLeft(-3.2, 0.2, 1.8), kClose(0.5, 0.15, 0.4),
    kLow(0.3, -1.35, 1.6);

Displacements pooled(const std::vector<Displacements>& tiles) {
  Displacements all;
  for (const Displacements& tile : tiles) all.append(tile);
  return all;
}

/// Tiles of one row, alone.
Wall part_of(const Wall& wall, std::size_t first, std::size_t count) {
  Wall part = wall;
  part.tiles.assign(wall.tiles.begin() + first, wall.tiles.begin() + first + count);
  for (std::size_t index = 0; index < count; ++index) {
    part.tiles[index].column = static_cast<int>(index);
    part.tiles[index].row = 0;
  }
  return part;
}

/// One end of an edge that two tiles share: by how much more one picture is displaced there than
/// the other.
struct Seam {
  std::string between;
  float step_px = 0;
};

/// Rounding to levels alone reads as up to 0.16 px where the code is coarse, as 0.04 px elsewhere.
constexpr float kNoStep_px = 0.2f;

/// Where both sides can be read.
std::vector<Seam> seams_of(const Wall& wall, const std::vector<Displacements>& found) {
  std::vector<Seam> seams;
  const auto add = [&](std::size_t tile, Corner corner, std::size_t other, Corner others) {
    const auto &one = found[tile].corner_px[corner], &two = found[other].corner_px[others];
    if (one && two)
      seams.push_back(
          {wall.tiles[tile].name + " and " + wall.tiles[other].name, (*one - *two).norm()});
  };
  for (std::size_t tile = 0; tile < wall.tiles.size(); ++tile)
    for (std::size_t other = 0; other < wall.tiles.size(); ++other) {
      const int right = wall.tiles[other].column - wall.tiles[tile].column,
                up = wall.tiles[other].row - wall.tiles[tile].row;
      if (right == 1 && up == 0) {
        add(tile, lower_right, other, lower_left);
        add(tile, upper_right, other, upper_left);
      } else if (right == 0 && up == 1) {
        add(tile, upper_left, other, lower_left);
        add(tile, upper_right, other, lower_right);
      }
    }
  return seams;
}

class ClosedLoop : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    surface_ = make_headless_surface();
    fine_code_ = std::make_unique<Scene>(position_coded_scene(kFineCell_m));
    coarse_code_ = std::make_unique<Scene>(position_coded_scene(kCoarseCell_m));
  }
  static void TearDownTestSuite() {
    fine_code_.reset();
    coarse_code_.reset();
    surface_.reset();
  }
  void TearDown() override { EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)); }

  /// Every tile drawn for `drawn_eye` on `drawn`, against what `true_eye` sees of `true_wall`.
  static std::vector<Displacements> compare(const Wall& drawn, const Vec3& drawn_eye,
                                            const Wall& true_wall, const Vec3& true_eye,
                                            std::size_t every = 1) {
    const Scene& code = true_eye.z() < 1 ? *coarse_code_ : *fine_code_;
    WallRenderer renderer(drawn, 1, {Style::unlit});
    renderer.show(pack(code));
    const WallFrame frame = renderer.draw({.eye_in_wall = drawn_eye});
    EXPECT_TRUE(frame.black_tiles.empty());
    const SceneRenderer reference(Style::unlit);
    const GpuScene scene = uploaded(pack(code), Look{Style::unlit});
    std::vector<Displacements> found;
    for (std::size_t index = 0; index < drawn.tiles.size(); index += every)
      found.push_back(
          displacements(renderer.read_tile(index),
                        reference_of_tile(true_wall.tiles[index], true_eye, reference, scene)));
    return found;
  }

  static void print(const char* what, const Displacements& found) {
    std::printf("  %-46s mean %.3f px, p99 %.3f px, max %.2f px over %.0f %% of the pixels\n", what,
                found.mean_px(), found.quantile_px(0.99), found.quantile_px(1),
                100 * found.readable_share());
  }

  /// Every tile is true, and the picture goes on from each to its neighbours.
  static void expect_true(const char* what, const Wall& wall, const Vec3& eye) {
    SCOPED_TRACE(what);
    const std::vector<Displacements> found = compare(wall, eye, wall, eye);
    print(what, pooled(found));
    for (std::size_t index = 0; index < found.size(); ++index)
      EXPECT_TRUE(shows_what_the_eye_sees(found[index])) << wall.tiles[index].name;
    const auto seams = seams_of(wall, found);
    ASSERT_GT(seams.size(), 75u);  // of 90
    const Seam& worst = *std::ranges::max_element(seams, {}, &Seam::step_px);
    std::printf("  %-46s largest step %.3f px at %zu ends of seams\n", "", worst.step_px,
                seams.size());
    EXPECT_LT(worst.step_px, kNoStep_px) << worst.between;
  }

  static void expect_true_from_everywhere(const Wall& wall) {
    expect_true("eye in the middle", wall, kMiddle);
    expect_true("eye far left", wall, kFarLeft);
    expect_true("eye 0.4 m from the wall", wall, kClose);
    expect_true("eye close to the floor", wall, kLow);
  }

  static inline std::unique_ptr<Surface> surface_;
  static inline std::unique_ptr<Scene> fine_code_;
  static inline std::unique_ptr<Scene> coarse_code_;
};

TEST_F(ClosedLoop, FlatThesisWallIsAWindow) { expect_true_from_everywhere(flat_wall()); }

TEST_F(ClosedLoop, WallWithBezelsIsAWindow) { expect_true_from_everywhere(wall_with_bezels()); }

TEST_F(ClosedLoop, CurvedWallIsAWindow) { expect_true_from_everywhere(curved_wall()); }

TEST_F(ClosedLoop, WallWithATiltedTileIsAWindow) {
  expect_true_from_everywhere(wall_with_tilted_tile());
}

/// Those in the wall's plane move the picture for every eye, one out of it for an eye that looks
/// at it from the side.
TEST_F(ClosedLoop, ACornerMovedByAMillimetreIsFound) {
  const Wall true_part = part_of(flat_wall(), 10, 1);
  const std::pair<Vec3, Vec3> moves[] = {{Vec3(1e-3, 0, 0), kMiddle},
                                         {Vec3(0, 1e-3, 0), kMiddle},
                                         {Vec3(0, 0, 1e-3), kFarLeft},
                                         {Vec3(0, 0, -1e-3), kFarLeft}};
  for (Vec3 TileCorners::*corner :
       {&TileCorners::lower_left_in_wall, &TileCorners::lower_right_in_wall,
        &TileCorners::upper_left_in_wall})
    for (const auto& [step, eye] : moves) {
      Wall moved = true_part;
      moved.tiles[0].corners.*corner += step;
      const Displacements found = pooled(compare(moved, eye, true_part, eye));
      EXPECT_GT(found.quantile_px(0.99), 1.0) << step.transpose();
      EXPECT_FALSE(shows_what_the_eye_sees(found)) << step.transpose();
    }
}

TEST_F(ClosedLoop, ATileMovedByAFifthOfAMillimetreIsAStepBesideItsNeighbour) {
  const Wall true_part = part_of(flat_wall(), 9, 2);
  Wall moved = true_part;
  TileCorners& corners = moved.tiles[1].corners;
  for (Vec3 TileCorners::*corner :
       {&TileCorners::lower_left_in_wall, &TileCorners::lower_right_in_wall,
        &TileCorners::upper_left_in_wall})
    corners.*corner += Vec3(2e-4, 0, 0);
  const std::vector<Displacements> found = compare(moved, kMiddle, true_part, kMiddle);
  EXPECT_TRUE(shows_what_the_eye_sees(found[1]));
  const std::vector<Seam> seams = seams_of(true_part, found);
  ASSERT_EQ(seams.size(), 2u);
  for (const Seam& seam : seams) EXPECT_GT(seam.step_px, kNoStep_px);
}

TEST_F(ClosedLoop, ATileThatIsBlackOrShowsItsNeighboursPictureIsFound) {
  const Wall one = part_of(flat_wall(), 10, 1), neighbour = part_of(flat_wall(), 11, 1);
  EXPECT_FALSE(shows_what_the_eye_sees(compare(neighbour, kMiddle, one, kMiddle)[0]));
  const SceneRenderer reference(Style::unlit);
  const GpuScene scene = uploaded(pack(*fine_code_), Look{Style::unlit});
  const Tile& tile = one.tiles[0];
  const Image black = Image::filled(tile.width_px, tile.height_px, {0, 0, 0, 255});
  EXPECT_FALSE(shows_what_the_eye_sees(
      displacements(black, reference_of_tile(tile, kMiddle, reference, scene))));
}

TEST_F(ClosedLoop, AnEyeOffByFiveMillimetresIsFound) {
  const Displacements found =
      pooled(compare(flat_wall(), kMiddle + Vec3(0.005, 0, 0), flat_wall(), kMiddle, 9));
  EXPECT_GT(found.mean_px(), 1.0);
}

class TrackedClosedLoop : public ClosedLoop {
 protected:
  /// The wall for the eye that two emulated Wiimotes give, against that for the true one, on the
  /// way of the walk.
  static Displacements displaced_by_tracking(const TrackingConfig& method) {
    const Site site = thesis_site();
    ManualClock clock;
    const EmulatedRoom room(site, clock);
    Tracker tracker(site.cameras, site.heads, site.wall.room_from_wall, method);
    std::vector<WiimoteReader> readers;
    for (std::size_t camera = 0; camera < site.cameras.size(); ++camera)
      readers.emplace_back(room.connect(camera), static_cast<int>(camera));
    Displacements all;
    for (int tick = 1; tick <= 6 * 60; ++tick) {
      clock.sleep_until(Time{} + tick * std::chrono::microseconds(16667));
      for (WiimoteReader& reader : readers)
        while (const auto observation = reader.next(clock.now())) tracker.absorb(*observation);
      const auto pose = tracker.track(clock.now(), clock.now());
      if (tick % 60 != 0) continue;
      const bool found = pose && pose->level == TrackingLevel::six_dof;
      EXPECT_TRUE(found) << method.method << ", second " << tick / 60;
      if (!found) continue;
      all.append(pooled(compare(site.wall, tracker.eye_in_wall(*pose), site.wall,
                                room.person().eye_in_wall(clock.now()), 9)));
    }
    return all;
  }
};

TEST_F(TrackedClosedLoop, EyeCostsAPixelAndThatOfTheThesisMethodMore) {
  const Displacements joint = displaced_by_tracking({});
  const Displacements thesis = displaced_by_tracking({.method = "thesis"});
  print("tracked eye", joint);
  print("tracked eye, method thesis", thesis);
  EXPECT_LT(joint.mean_px(), 1.2);
  EXPECT_GT(thesis.mean_px(), 2 * joint.mean_px());
  EXPECT_LT(thesis.mean_px(), 4);
}

}  // namespace
}  // namespace vindu::test
