// A file that comes into its place whole or not at all: it is written beside it first, and moved in
// one step. Whoever reads it meanwhile reads the one before.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace vindu {

class NewFile {
 public:
  explicit NewFile(const std::string& file) : NewFile(file, file + ".part") {}
  /// `beside`: where it is written, in the same folder.
  NewFile(std::string file, std::string beside)
      : file_(std::move(file)), beside_(std::move(beside)) {}
  /// What was not placed is removed.
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  const std::string& beside() const { return beside_; }

  /// All of it. Throws Error, as place() does.
  void write(std::string_view content, const std::string& remedy) const;
  /// Instead of what is there. Throws Error with that remedy where it cannot be.
  void place(const std::string& remedy);

 private:
  std::string file_, beside_;
  bool placed_ = false;
};

}  // namespace vindu
