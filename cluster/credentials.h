// What a participant of a secured wall shows the others (OMG DDS Security 1.1, section 9.3.1): who
// it is, by a certificate; what it may read and write, by permissions that are signed. vindu keys
// makes them and cluster/keys reads them; a transport that is given some lets nobody in without.
#pragma once

#include <string>

namespace vindu {

/// The content of the files: PEM, or S/MIME where it is a signed document.
struct Credentials {
  // The same for the whole wall.
  std::string identity_ca{};     ///< who signs certificates
  std::string permissions_ca{};  ///< who signs the documents; never the same as identity_ca
  std::string governance{};      ///< signed: what is protected, and how
  std::string revoked{};         ///< the identity CA's list of certificates that count no more
  // The participant's own.
  std::string certificate{};
  std::string private_key{};
  std::string permissions{};  ///< signed
};

}  // namespace vindu
