#include "renderer/scene_cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <system_error>
#include <thread>
#include <vector>

#include "core/error.h"
#include "core/sha256.h"

namespace vindu {
namespace {

namespace fs = std::filesystem;

/// Held by one process at a time.
class FileLock {
 public:
  /// Throws Error after a stop.
  FileLock(const fs::path& file, const std::stop_token& stop)
      : descriptor_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
    if (descriptor_ < 0)
      throw fs::filesystem_error("cannot be written", file,
                                 std::error_code(errno, std::generic_category()));
    while (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && (errno == EINTR || errno == EWOULDBLOCK)) {
      if (stop.stop_requested()) {
        close(descriptor_);
        throw Error({"is being packed by another process, and was not waited for", file, ""});
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  ~FileLock() { close(descriptor_); }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_;
};

/// A model that was moved has its other files where it has gone.
std::string moved(const std::string& source, const std::string& packed_model,
                  const std::string& model) {
  const fs::path relative =
      fs::path(source).lexically_relative(fs::path(packed_model).parent_path());
  return fs::absolute(model).parent_path() / relative;
}

bool unchanged(const PackedScene& packed, const std::string& model) {
  if (packed.sources.empty()) return false;
  return std::all_of(
      packed.sources.begin() + 1, packed.sources.end(), [&](const SceneSource& source) {
        const std::string file = moved(source.path, packed.sources.front().path, model);
        std::error_code gone;
        return fs::file_size(file, gone) == source.bytes && sha256_of_file(file) == source.sha256;
      });
}

}  // namespace

SceneCache::SceneCache(fs::path folder, std::uintmax_t most_bytes)
    : folder_(std::move(folder)), most_bytes_(most_bytes) {}

fs::path SceneCache::usual_folder() {
  const auto named = [](const char* variable) {
    const char* const value = std::getenv(variable);
    return fs::path(value ? value : "");
  };
  if (const fs::path cache = named("XDG_CACHE_HOME"); cache.is_absolute())
    return cache / "vindu/scenes";
  const fs::path home = named("HOME");
  return home.is_absolute() ? home / ".cache/vindu/scenes" : fs::path();
}

fs::path SceneCache::entry_of(const std::string& model_sha256) const {
  return folder_ / (model_sha256 + kSceneFileExtension);
}

std::optional<PackedScene> SceneCache::find(const std::string& model_sha256,
                                            const std::string& model) const {
  const fs::path entry = entry_of(model_sha256);
  std::error_code error;
  if (!fs::is_regular_file(entry, error)) return std::nullopt;
  try {
    PackedScene packed = read_scene_file(entry);
    if (!unchanged(packed, model)) return std::nullopt;
    fs::last_write_time(entry, fs::file_time_type::clock::now(), error);  // used
    return packed;
  } catch (const Error&) {  // of another Vindu, or damaged
    return std::nullopt;
  }
}

PackedScene SceneCache::find_or_pack(const std::string& model, const std::string& model_sha256,
                                     const std::function<void(const std::string& file)>& pack,
                                     const std::stop_token& stop) const {
  if (auto found = find(model_sha256, model)) return std::move(*found);
  fs::create_directories(folder_);
  const FileLock lock(folder_ / (model_sha256 + ".lock"), stop);
  if (auto found = find(model_sha256, model)) return std::move(*found);  // somebody else did it
  const fs::path entry = entry_of(model_sha256);
  pack(entry);
  forget_oldest();
  return read_scene_file(entry);
}

void SceneCache::forget_oldest() const {
  struct Entry {
    fs::file_time_type used;
    std::uintmax_t bytes = 0;
    fs::path path;
  };
  std::vector<Entry> entries;
  std::error_code error;
  for (const auto& file : fs::directory_iterator(folder_, error))
    if (file.path().extension() == kSceneFileExtension)
      entries.push_back({file.last_write_time(error), file.file_size(error), file.path()});
  std::ranges::sort(entries, std::ranges::greater(), &Entry::used);
  std::uintmax_t kept = 0;
  for (const Entry& entry : entries) {
    kept += entry.bytes;
    if (kept > most_bytes_ && &entry != &entries.front()) fs::remove(entry.path, error);
  }
}

}  // namespace vindu
