// Models as scenes, through the cache. What a model file does to the importer happens in a process
// of its own, with limits on memory and time: a broken or malicious file ends that process alone.
#pragma once

#include <chrono>
#include <cstdint>
#include <stop_token>
#include <string>

#include "renderer/scene_file.h"

namespace vindu::app {

struct PackLimits {
  std::uintmax_t memory_bytes = std::uintmax_t{4} << 30;
  std::chrono::seconds time{60};
};

/// More for larger files.
PackLimits limits_for(const std::string& model);

/// Imports in this process, cut into chunks, with the files that it was read from.
PackedScene import_packed(const std::string& model);

/// The same in a child that writes `file`. Throws Error: what the child says, or how it ended; soon
/// after a stop, too.
void pack_apart(const std::string& model, const std::string& file, const PackLimits& limits,
                const std::stop_token& stop = {});

/// From the cache, or packed into it; a packed scene (.vscene) as it is. Throws Error soon after a
/// stop while somebody packs it.
PackedScene packed_scene(const std::string& model, const std::stop_token& stop = {});

}  // namespace vindu::app
