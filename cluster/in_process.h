// The wall in one process: many participants that share a hub, without sockets. Topics are
// delivered as topics.h says, like over the network, and messages are checked and cut like there.
#pragma once

#include "cluster/bus.h"

namespace vindu {

/// One wall; join() from any thread.
class InProcessTransport final : public Transport {
 public:
  InProcessTransport();
  ~InProcessTransport() override;

  std::unique_ptr<Bus> join(const Membership& membership) override;

 private:
  class Hub;
  class Member;
  std::unique_ptr<Hub> hub_;
};

}  // namespace vindu
