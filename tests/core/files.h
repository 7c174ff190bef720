// Files that a test writes and what reading them complains about.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"

namespace vindu::testing {

/// A file with this text, gone at the end of its scope.
class TextFile {
 public:
  explicit TextFile(const std::string& text)
      : path_(::testing::TempDir() + "vindu-" + std::to_string(::getpid()) + ".toml") {
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TextFile() { std::filesystem::remove(path_); }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The message of the Error that `read` throws, "FILE" in place of the file's path; empty when it
/// throws none.
template <class Read>
std::string complaint_about(const std::string& text, Read read) {
  const TextFile file(text);
  try {
    read(file.path());
    return "";
  } catch (const Error& error) {
    std::string message = error.what();
    for (std::size_t at; (at = message.find(file.path())) != std::string::npos;)
      message.replace(at, file.path().size(), "FILE");
    return message;
  }
}

}  // namespace vindu::testing
