// Logging, so that every line looks alike and no header shows spdlog. Lines go to the error stream;
// every line names the tile or device it speaks of.
#pragma once

#include <string_view>

namespace vindu {

/// quiet: warnings and errors only; verbose: also debug.
enum class LogLevel { quiet, normal, verbose };

void set_log_level(LogLevel level);
void log_debug(std::string_view who, std::string_view what);
void log_info(std::string_view who, std::string_view what);
void log_warning(std::string_view who, std::string_view what);

}  // namespace vindu
