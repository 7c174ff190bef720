// Random good values of everything that travels.
#pragma once

#include <string>

#include "cluster/topics.h"
#include "core/random.h"

namespace vindu::testing {

FrameState random_state(Random& random);

/// Of each topic but presence.
Message random_message(Random& random, Topic topic);

}  // namespace vindu::testing
