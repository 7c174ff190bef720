// Log lines: where they go, what they say, and which are left out.
#include "core/log.h"

#include <gmock/gmock.h>

namespace vindu {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string lines_at(LogLevel level) {
  set_log_level(level);
  ::testing::internal::CaptureStderr();
  log_debug("tile-0-0", "a detail");
  log_info("tile-1-0", "news");
  log_warning("camera left", "a warning");
  std::string lines = ::testing::internal::GetCapturedStderr();
  set_log_level(LogLevel::normal);
  return lines;
}

TEST(Log, NamesWhoSpeaks) {
  EXPECT_THAT(lines_at(LogLevel::normal), HasSubstr("tile-1-0: news\n"));
  EXPECT_THAT(lines_at(LogLevel::normal), HasSubstr("camera left: a warning\n"));
}

TEST(Log, ShowsWhatTheLevelAsksFor) {
  EXPECT_THAT(lines_at(LogLevel::quiet), Not(HasSubstr("news")));
  EXPECT_THAT(lines_at(LogLevel::quiet), HasSubstr("a warning"));
  EXPECT_THAT(lines_at(LogLevel::normal), Not(HasSubstr("a detail")));
  EXPECT_THAT(lines_at(LogLevel::verbose), HasSubstr("a detail"));
}

}  // namespace
}  // namespace vindu
