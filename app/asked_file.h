// The file in which a master keeps what its wall was asked for: one that is started again after a
// crash goes on with it.
#pragma once

#include <optional>
#include <string>

#include "cluster/messages.h"
#include "core/asked.h"

namespace vindu::app {

/// A command that changes nothing else: pattern, overlay or blank. Throws Error where its argument
/// is none.
void note(const CommandMessage& command, Asked& asked);

/// Of one launch, which `session` names, and of no other; an empty name keeps nothing. What cannot
/// be kept is a warning, once.
class AskedFile {
 public:
  AskedFile(const ClusterConfig& cluster, std::string session)
      : cluster_(cluster), session_(std::move(session)) {}

  /// What the master before kept, and no longer there then: where it is what that one died of, the
  /// next one begins anew.
  std::optional<Asked> take();
  void keep(const Asked& asked);
  /// After a good end.
  void remove();

 private:
  std::string path() const;

  ClusterConfig cluster_;
  std::string session_;
  bool warned_ = false;
};

}  // namespace vindu::app
