// Who makes a wall's keys: two certificate authorities of the wall's own. One certifies
// participants; the other signs what they may do, and certifies nobody, since otherwise whoever it
// had certified could sign permissions for himself.
#pragma once

#include <memory>
#include <string>

#include "cluster/keys/documents.h"
#include "cluster/keys/key_folder.h"

namespace vindu {

class Authority {
 public:
  /// Of this folder (key_folder.h); made where there is none yet. Throws Error where its private
  /// keys are missing or not private.
  explicit Authority(const std::string& folder);
  ~Authority();

  bool is_new() const { return is_new_; }
  /// Nothing that it signs counts longer.
  std::chrono::system_clock::time_point until() const;

  /// A new key with its certificate and permissions, in place of what there was. The certificates
  /// that were count on, until they end or are revoked.
  void issue(const KeyOwner& owner, const Validity& validity);

  /// All certificates that the owner ever had; how many. Participants hear of it when they start
  /// again with the new revoked.pem.
  int revoke(const KeyOwner& owner);

 private:
  struct Keys;
  void make();
  void open();
  std::vector<std::string> issued_to(const std::string& name) const;

  std::string folder_;
  bool is_new_ = false;
  std::unique_ptr<Keys> keys_;
};

}  // namespace vindu
