// The real program as a child process: what it prints, how it ends, and the files that it writes.
#pragma once

#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace vindu::testing {

struct ProcessResult {
  int exit_code = -1;  ///< 128 + the signal's number where one ended it, as a shell says
  std::string out;
  std::string err;
};

using Environment = std::map<std::string, std::string>;

/// Runs a program to its end; one that takes longer than 200 s (1000 s under the address
/// sanitizer) is killed. Without a display, unless
/// `environment` names one.
ProcessResult run(const std::vector<std::string>& words, const Environment& environment = {});

/// vindu ARGUMENTS...
ProcessResult vindu(std::vector<std::string> arguments, const Environment& environment = {});

/// A folder of its own for every test, removed at the end.
class AppTest : public ::testing::Test {
 protected:
  AppTest();
  ~AppTest() override;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const;
  /// Names of the files in one of its folders, sorted.
  std::vector<std::string> files_in(const std::string& name) const;

 private:
  std::filesystem::path folder_;
};

std::string bytes_of(const std::string& file);

std::vector<std::string> lines_of(const std::string& text);

/// The first number after a key of JSON, from a place on; -1 where there is no such key.
double number_after(const std::string& json, const std::string& key, std::size_t from = 0);

/// A model whose import takes no time.
std::string small_model();

/// An X server without a screen (Xvfb) on a display that nobody uses; ends with its scope.
class VirtualDisplay {
 public:
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  /// Empty when no server could be started.
  const std::string& name() const { return name_; }
  Environment environment() const { return {{"DISPLAY", name_}}; }

 private:
  pid_t server_ = -1;
  std::string name_;
};

}  // namespace vindu::testing
