// Contexts without a display: on Mesa's surfaceless platform and on a device by its index.
#include <gmock/gmock.h>

#include "core/error.h"
#include "renderer/canvas.h"
#include "renderer/surface.h"

namespace vindu {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;

/// Something that only a living context does.
void expect_that_it_draws() {
  Picture picture({3, 3}, Style::unlit);
  picture.clear({9, 8, 7, 255});
  EXPECT_THAT(picture.read().pixels, Each(Rgba8{9, 8, 7, 255}));
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(HeadlessSurfaceGl, DrawsWithoutADeviceNamed) {
  const auto surface = make_headless_surface();
  expect_that_it_draws();
  EXPECT_FALSE(surface->close_wanted());
  surface->present();
}

TEST(HeadlessSurfaceGl, DrawsOnTheFirstDevice) {
  const auto surface = make_headless_surface({.device = 0});
  expect_that_it_draws();
}

TEST(HeadlessSurfaceGl, SaysWhatItDrawsOn) {
  const auto surface = make_headless_surface();
  EXPECT_THAT(gl_description(), HasSubstr(", OpenGL 4."));
}

TEST(HeadlessSurfaceGl, NamesTheDevicesThereAreForOneThatIsNot) {
  for (const int device : {99, -1}) try {
      make_headless_surface({.device = device});
      ADD_FAILURE() << "no error for device " << device;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(),
                  AllOf(HasSubstr("--device"), HasSubstr("device " + std::to_string(device)),
                        HasSubstr("choose 0 to ")));
    }
}

TEST(HeadlessSurfaceGl, CanBeMadeAgainAfterTheLastOneIsGone) {
  for (int time = 0; time < 3; ++time) {
    const auto surface = make_headless_surface();
    expect_that_it_draws();
  }
}

TEST(HeadlessSurfaceGl, LeavesAnotherContextAliveWhenItGoes) {
  const auto first = make_headless_surface({.device = 0});
  make_headless_surface().reset();
  const auto third = make_headless_surface();
  expect_that_it_draws();
}

// Both on the same EGL display: the end of one must not end the other's.
TEST(HeadlessSurfaceGl, OutlivesAnotherOneOfItsKind) {
  auto first = make_headless_surface();
  const auto second = make_headless_surface();
  first.reset();
  expect_that_it_draws();
}

}  // namespace
}  // namespace vindu
