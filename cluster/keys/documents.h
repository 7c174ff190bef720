// The two documents of OMG DDS Security 1.1 (section 9.4.1) as XML, not yet signed: governance says
// what is protected on the wall, permissions what one participant may do.
#pragma once

#include <chrono>
#include <string>

#include "cluster/topics.h"

namespace vindu {

/// By the hosts' own clocks, in whole seconds.
struct Validity {
  std::chrono::system_clock::time_point from{}, until{};
};

/// Nobody without a certificate takes part; every packet is encrypted, and marked for each of its
/// receivers, so that no member of the wall can speak for another.
std::string governance_document();

/// Of whoever has a certificate with this subject; `subject` as RFC 2253 writes it.
std::string permissions_document(const std::string& subject, Role role, const Validity& validity);

}  // namespace vindu
