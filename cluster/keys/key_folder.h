// The folder in which a wall's keys lie: what every participant has, one folder for each of them,
// and ca/, which never leaves the machine of vindu keys.
//
//   identity_ca.pem  permissions_ca.pem  governance.p7s  revoked.pem
//   master/  tracker/  console/  hosts/tile-3-0/:  certificate.pem  private.pem  permissions.p7s
//   ca/: identity_private.pem  permissions_private.pem  issued
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "cluster/credentials.h"
#include "cluster/topics.h"

namespace vindu {

/// Whose key it is: a role's or, of tiles, their host's.
struct KeyOwner {
  Role role = Role::tile;
  std::string host{};  ///< of tiles, as the wall file calls it; else empty

  bool operator==(const KeyOwner&) const = default;
};

/// "master", "hosts/tile-3-0". Throws Error for a host whose name is no file's.
std::string name_of(const KeyOwner& owner);

enum class KeyState { missing, good, ends_soon, expired, revoked, unusable };

constexpr std::string_view name_of(KeyState state) {
  constexpr std::string_view names[] = {"missing", "good",    "ends soon",
                                        "expired", "revoked", "unusable"};
  return names[static_cast<int>(state)];
}

struct KeyInfo {
  KeyOwner owner{};
  KeyState state = KeyState::missing;
  std::chrono::system_clock::time_point until{};  ///< not of a missing or unusable one
  std::string why{};                              ///< it is unusable
};

/// Less than that before its end a key is to be made anew.
constexpr std::chrono::hours kEndsSoon = std::chrono::days(30);

/// Never throws for what is in the folder.
KeyInfo inspect_key(const std::string& folder, const KeyOwner& owner);

/// What a participant needs, checked: its private files are nobody else's to read, the certificate
/// counts today and is this key's, the documents are signed. Throws Error with the file and what
/// to do; warns in the log of one that ends soon.
Credentials read_credentials(const std::string& folder, const KeyOwner& owner);
/// The same, unchecked but for being there.
Credentials read_credential_files(const std::string& folder, const KeyOwner& owner);

/// What its host must have, relative to the folder: nothing of anybody else's, nothing of the CA's.
std::vector<std::string> files_of(const KeyOwner& owner);

}  // namespace vindu
