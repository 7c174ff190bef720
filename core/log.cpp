#include "core/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace vindu {
namespace {

spdlog::logger& logger() {
  static const auto instance = [] {
    auto made = spdlog::stderr_color_mt("vindu");
    made->set_pattern("%^%l%$ %v");
    return made;
  }();
  return *instance;
}

}  // namespace

void set_log_level(LogLevel level) {
  logger().set_level(level == LogLevel::quiet     ? spdlog::level::warn
                     : level == LogLevel::verbose ? spdlog::level::debug
                                                  : spdlog::level::info);
}

void log_debug(std::string_view who, std::string_view what) { logger().debug("{}: {}", who, what); }
void log_info(std::string_view who, std::string_view what) { logger().info("{}: {}", who, what); }
void log_warning(std::string_view who, std::string_view what) {
  logger().warn("{}: {}", who, what);
}

}  // namespace vindu
