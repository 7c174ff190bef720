// Many names as a few words, in the notation of ClusterShell: tile-[0-4,6]-[0-3],tile-5-1. What
// this prints, clush and nodeset read.
#pragma once

#include <string>
#include <vector>

namespace vindu {

/// Each name once; names that differ in their numbers alone share a word where they can. Empty for
/// no names.
std::string fold_names(const std::vector<std::string>& names);

}  // namespace vindu
