// What can be said about a model file before anything reads it: that it is there, that it is a file
// of a believable size, that Assimp has a reader for its kind, and how much memory reading it may
// take. Some of Assimp's loaders believe a file that claims a billion vertices in a hundred bytes.
#pragma once

#include <sys/resource.h>

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace vindu {

/// Throws Error with a remedy; returns only where reading the file is worth trying.
void check_model_file(const std::string& file, std::uintmax_t max_bytes);

/// "model.GLB" -> ".glb".
std::string lower_extension(const std::string& file);

/// ASCII only, as file formats and their names in the wild are.
std::string lower_case(std::string_view text);

/// While it lives, this process may grow by so much and no more; beyond that, allocating throws
/// std::bad_alloc. It holds for all threads, so keep it short; a second one waits for the first.
/// Without effect under the sanitizers, whose own memory it would count.
class MemoryBudget {
 public:
  explicit MemoryBudget(std::uintmax_t bytes);
  ~MemoryBudget();
  MemoryBudget(const MemoryBudget&) = delete;
  MemoryBudget& operator=(const MemoryBudget&) = delete;

 private:
  std::unique_lock<std::mutex> alone_;
  rlimit before_{};
  bool lowered_ = false;
};

/// Generous for what Assimp makes of honest files: a fixed part, and a multiple of the bytes that
/// the model has (a .gltf counts the files beside it), but never more than the machine has free.
std::uintmax_t reading_budget_bytes(const std::string& model_file);

}  // namespace vindu
