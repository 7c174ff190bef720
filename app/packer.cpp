#include "app/packer.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <new>
#include <utility>

#include "core/clock.h"
#include "core/error.h"
#include "core/log.h"
#include "core/sha256.h"
#include "renderer/chunks.h"
#include "renderer/import.h"
#include "renderer/import_file.h"
#include "renderer/levels.h"
#include "renderer/scene_cache.h"
#include "renderer/still_parts.h"

namespace vindu::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRemedy =
    "open it in the program that made it and export it again, best as .glb";

std::optional<SceneSource> source_of(const std::string& file) {
  const auto sha256 = sha256_of_file(file);
  std::error_code error;
  const auto bytes = fs::file_size(file, error);
  if (!sha256 || error) return std::nullopt;
  return SceneSource{fs::absolute(file), bytes, *sha256};
}

/// A child whose standard output and errors come here; killed at the end of its scope.
class PackingChild {
 public:
  explicit PackingChild(std::vector<std::string> words) {
    std::array<int, 2> pipe_ends{};
    if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
      throw Error({"cannot be packed: no pipe", words[0], "close other programs"});
    output_ = pipe_ends[0];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const int failed = posix_spawn(&id_, "/proc/self/exe", &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(pipe_ends[1]);
    if (failed != 0) {
      id_ = -1;
      close(output_);
      throw Error({std::string("cannot be packed: ") + std::strerror(failed), "vindu pack", ""});
    }
  }
  ~PackingChild() {
    if (id_ > 0) {
      kill(id_, SIGKILL);
      waitpid(id_, nullptr, 0);
    }
    close(output_);
  }
  PackingChild(const PackingChild&) = delete;
  PackingChild& operator=(const PackingChild&) = delete;

  pid_t id() const { return id_; }
  /// What it said until it closed its output; false when that takes longer, or was stopped.
  bool listen(Time until, const std::stop_token& stop, std::string& said) const {
    constexpr long long kLook_ms = 50;  // for a stop
    const MonotonicClock clock;
    std::array<char, 4096> piece{};
    while (true) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - clock.now()).count();
      if (left <= 0 || stop.stop_requested()) return false;
      pollfd waiting{.fd = output_, .events = POLLIN, .revents = 0};
      if (poll(&waiting, 1, static_cast<int>(std::min<long long>(left, kLook_ms))) == 0) continue;
      const auto length = read(output_, piece.data(), piece.size());
      if (length <= 0) return true;
      if (said.size() < 65536) said.append(piece.data(), static_cast<std::size_t>(length));
    }
  }
  /// As waitpid() says.
  int end() {
    int status = 0;
    waitpid(std::exchange(id_, -1), &status, 0);
    return status;
  }

 private:
  pid_t id_ = -1;
  int output_ = -1;
};

/// Removes a file at the end of its scope, if it is there.
struct Removed {
  std::string file;
  ~Removed() {
    std::error_code unable;
    fs::remove(file, unable);
  }
};

/// "vindu: MODEL: what; remedy" without its beginning.
std::string error_in(std::string said) {
  constexpr std::string_view kBegin = "vindu: ";
  const auto at = said.rfind(kBegin);
  if (at == std::string::npos) return {};
  said.erase(0, at + kBegin.size());
  said.erase(said.find_last_not_of('\n') + 1);
  return said;
}

}  // namespace

PackLimits limits_for(const std::string& model) {
  std::error_code error;
  const auto bytes = fs::file_size(model, error);
  PackLimits limits;
  if (error) return limits;
  limits.time += 2 * std::chrono::seconds(bytes >> 20);  // and two for each MiB
  limits.memory_bytes = std::max(limits.memory_bytes, 30 * bytes);
  return limits;
}

PackedScene import_packed(const std::string& model) try {
  ImportResult imported = import_scene(model);
  join_still_parts(imported.scene);
  cut_into_chunks(imported.scene);
  make_levels(imported.scene);
  PackedScene packed = pack(std::move(imported.scene));
  packed.warnings = std::move(imported.warnings);
  for (const std::string& file : imported.files)
    if (auto source = source_of(file)) packed.sources.push_back(std::move(*source));
  return packed;
} catch (const std::bad_alloc&) {
  throw Error({"takes more memory than there is, or than it was given", model,
               "reduce it, or give more: vindu pack MODEL --memory-mib N"});
}

void pack_apart(const std::string& model, const std::string& file, const PackLimits& limits,
                const std::stop_token& stop) {
  Removed unfinished;  // what a killed child leaves
  PackingChild child({"vindu", "pack", model, "--here", "--out", file, "--memory-mib",
                      std::to_string(limits.memory_bytes >> 20)});
  unfinished.file = unfinished_scene_file(file, child.id());
  const MonotonicClock clock;
  std::string said;
  const bool ended = child.listen(clock.now() + limits.time, stop, said);
  if (stop.stop_requested()) throw Error({"was not read to its end", model, ""});
  if (!ended)
    throw Error({"reading it takes longer than " + std::to_string(limits.time.count()) + " s",
                 model, kRemedy});
  const int status = child.end();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (const std::string error = error_in(said); !error.empty()) throw Error(error);
  const std::string how = WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "without a word";
  throw Error({"the reader of this format breaks down over it (" + how + ")", model, kRemedy});
}

PackedScene packed_scene(const std::string& model, const std::stop_token& stop) {
  if (fs::path(model).extension() == kSceneFileExtension) return read_scene_file(model);
  check_model_file(model, ImportLimits{}.file_bytes);
  const auto sha256 = sha256_of_file(model);
  const fs::path folder = SceneCache::usual_folder();
  if (!sha256 || folder.empty()) return import_packed(model);
  try {
    PackedScene packed = SceneCache(folder).find_or_pack(
        model, *sha256,
        [&](const std::string& file) {
          log_info(fs::path(model).filename().string(), "is packed, once");
          pack_apart(model, file, limits_for(model), stop);
        },
        stop);
    packed.scene.name = fs::path(model).stem().string();  // a copy has its own name
    return packed;
  } catch (const fs::filesystem_error& error) {
    log_warning(fs::path(model).filename().string(),
                std::string("cannot be kept packed: ") + error.what());
    return import_packed(model);
  }
}

}  // namespace vindu::app
