#include "core/new_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/error.h"

namespace vindu {

NewFile::~NewFile() {
  std::error_code ignored;
  if (!placed_) std::filesystem::remove(beside_, ignored);
}

void NewFile::write(std::string_view content, const std::string& remedy) const {
  errno = 0;
  std::ofstream stream(beside_, std::ios::binary);
  stream << content;
  stream.close();
  if (!stream)
    throw Error({std::string("cannot be written: ") + std::strerror(errno), file_, remedy});
}

void NewFile::place(const std::string& remedy) {
  std::error_code error;
  std::filesystem::rename(beside_, file_, error);
  if (error) throw Error({"cannot be written: " + error.message(), file_, remedy});
  placed_ = true;
}

}  // namespace vindu
