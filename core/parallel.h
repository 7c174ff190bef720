// Work shared by the cores of the machine.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>

namespace vindu {

/// Calls `work(i)` once for every i below `count`, begun in that order, on a thread for each core,
/// the caller's among them, and at most so many; returns when all are done. After an exception no
/// more are begun, and the first one is thrown here.
void for_each_in_parallel(std::size_t count, const std::function<void(std::size_t)>& work,
                          std::size_t most_threads = std::numeric_limits<std::size_t>::max());

}  // namespace vindu
