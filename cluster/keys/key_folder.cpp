#include "cluster/keys/key_folder.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cluster/keys/internal/files.h"
#include "cluster/keys/internal/openssl.h"
#include "core/error.h"
#include "core/log.h"

namespace vindu {
namespace {

namespace fs = std::filesystem;
using std::chrono::system_clock;

bool is_file_name(const std::string& host) {
  const auto allowed = [](unsigned char c) {
    return std::isalnum(c) || c == '-' || c == '_' || c == '.';
  };
  return !host.empty() && host.front() != '.' && std::ranges::all_of(host, allowed);
}

std::string renewal(const KeyOwner& owner) {
  return "make it again (vindu keys --renew --key " + name_of(owner) +
         ") and bring it (vindu deploy)";
}

/// The owner's certificate, and what there is to say against it.
struct Examined {
  internal::Certificate certificate;
  bool revoked = false;
  std::string why_not{};  ///< empty: it counts
};

Examined examine(const Credentials& credentials, const std::string& file) {
  Examined result{.certificate = internal::certificate_from(credentials.certificate, file)};
  const auto authority = internal::certificate_from(credentials.identity_ca, "identity_ca.pem");
  const auto revoked = internal::revoked_list_from(credentials.revoked, "revoked.pem");
  result.revoked = internal::is_revoked(*revoked, *result.certificate);
  result.why_not = internal::why_not(*result.certificate, *authority, *revoked);
  return result;
}

void expect_fitting(const Credentials& credentials, const X509& certificate, const fs::path& own) {
  const auto key = internal::key_from(credentials.private_key, own / "private.pem");
  if (X509_check_private_key(&certificate, key.get()) != 1)
    throw Error({"is not the key of the certificate beside it", (own / "private.pem").string(),
                 "bring both again: vindu deploy"});
  const fs::path folder = own.parent_path();
  const auto authority =
      internal::certificate_from(credentials.permissions_ca, folder / "permissions_ca.pem");
  for (const auto& [document, file] : {std::pair(&credentials.governance, "governance.p7s"),
                                       std::pair(&credentials.permissions, "permissions.p7s")})
    if (!internal::is_signed_by(*document, *authority))
      throw Error({"is not signed by the wall's permissions_ca.pem", (own / file).string(),
                   "bring all of them again: vindu deploy"});
}

void warn_of_end(const KeyOwner& owner, system_clock::time_point until) {
  const auto left = until - system_clock::now();
  if (left > kEndsSoon) return;
  log_warning(name_of(owner),
              fmt::format("its key ends on {:%Y-%m-%d}, in {} days: {}",
                          fmt::gmtime(system_clock::to_time_t(until)),
                          std::chrono::floor<std::chrono::days>(left).count(), renewal(owner)));
}

}  // namespace

std::string name_of(const KeyOwner& owner) {
  if (owner.role != Role::tile) return std::string(name_of(owner.role));
  if (!is_file_name(owner.host))
    throw Error({"\"" + owner.host + "\" is no host name", "keys",
                 "use letters, digits, - _ and . in the wall file's hosts"});
  return "hosts/" + owner.host;
}

std::vector<std::string> files_of(const KeyOwner& owner) {
  const std::string own = name_of(owner) + "/";
  return {"identity_ca.pem",       "permissions_ca.pem", "governance.p7s",       "revoked.pem",
          own + "certificate.pem", own + "private.pem",  own + "permissions.p7s"};
}

Credentials read_credential_files(const std::string& folder, const KeyOwner& owner) {
  Credentials credentials;
  std::string* const parts[] = {&credentials.identity_ca, &credentials.permissions_ca,
                                &credentials.governance,  &credentials.revoked,
                                &credentials.certificate, &credentials.private_key,
                                &credentials.permissions};
  const std::vector<std::string> files = files_of(owner);
  for (std::size_t i = 0; i < files.size(); ++i)
    *parts[i] = internal::read_key_file(fs::path(folder) / files[i]);
  return credentials;
}

KeyInfo inspect_key(const std::string& folder, const KeyOwner& owner) {
  KeyInfo info{.owner = owner};
  const fs::path file = fs::path(folder) / name_of(owner) / "certificate.pem";
  std::error_code error;
  if (!fs::exists(file, error)) return info;
  try {
    const Examined examined = examine(read_credential_files(folder, owner), file);
    info.until = internal::end_of(*examined.certificate);
    const auto now = system_clock::now();
    info.why = examined.why_not;
    info.state = examined.revoked               ? KeyState::revoked
                 : info.until <= now            ? KeyState::expired
                 : !info.why.empty()            ? KeyState::unusable
                 : info.until < now + kEndsSoon ? KeyState::ends_soon
                                                : KeyState::good;
  } catch (const Error& problem) {
    info.state = KeyState::unusable;
    info.why = problem.what();
  }
  return info;
}

Credentials read_credentials(const std::string& folder, const KeyOwner& owner) {
  const fs::path own = fs::path(folder) / name_of(owner);
  Credentials credentials = read_credential_files(folder, owner);
  internal::expect_private(own / "private.pem");
  const fs::path file = own / "certificate.pem";
  const Examined examined = examine(credentials, file);
  if (!examined.why_not.empty())
    throw Error({"does not count: " + examined.why_not, file,
                 renewal(owner) + "; see that this machine's clock is right"});
  expect_fitting(credentials, *examined.certificate, own);
  warn_of_end(owner, internal::end_of(*examined.certificate));
  return credentials;
}

}  // namespace vindu
