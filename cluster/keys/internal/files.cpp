#include "cluster/keys/internal/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "core/new_file.h"

namespace vindu::internal {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLongestFile = 1 << 20;

[[noreturn]] void fail(const fs::path& file, const std::string& what, const std::string& remedy) {
  throw Error({what + " (" + std::strerror(errno) + ")", file.string(), remedy});
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  if (folder.empty() || fs::exists(folder, error)) return;
  make_folder(folder.parent_path());
  if (mkdir(folder.c_str(), 0700) != 0)
    fail(folder, "cannot be made", "choose another folder (--out)");
}

void write_all(int file, const std::string& text, const fs::path& name) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(file, text.data() + done, text.size() - done);
    if (written < 0) fail(name, "cannot be written", "free some space");
    done += static_cast<std::size_t>(written);
  }
}

}  // namespace

std::string read_key_file(const fs::path& file) {
  const std::ifstream stream(file, std::ios::binary);
  std::error_code error;
  if (!stream || fs::file_size(file, error) > kLongestFile || error)
    fail(file, "cannot be read",
         "make the wall's keys (vindu keys) or, on a host, bring them "
         "(vindu deploy)");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void write_key_file(const fs::path& file, const std::string& text) {
  make_folder(file.parent_path());
  std::error_code error;
  NewFile fresh(file);
  fs::remove(fresh.beside(), error);
  const int handle =
      open(fresh.beside().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (handle < 0) fail(file, "cannot be written", "choose another folder (--out)");
  write_all(handle, text, file);
  fsync(handle);
  close(handle);
  fresh.place("choose another folder (--out)");
}

void expect_private(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) fail(file, "cannot be read", "");
  if (const mode_t others = status.st_mode & 0077; others == 0) return;
  throw Error(
      {"may be read or written by others than its owner: whoever could is to be taken for "
       "its owner",
       file.string(), "chmod 600 it, or make it again (vindu keys --renew)"});
}

}  // namespace vindu::internal
