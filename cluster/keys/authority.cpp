#include "cluster/keys/authority.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "cluster/keys/internal/files.h"
#include "cluster/keys/internal/openssl.h"
#include "core/error.h"

namespace vindu {
namespace {

namespace fs = std::filesystem;
using namespace internal;
using std::chrono::system_clock;

constexpr const char* kUnit = "Vindu";
constexpr std::chrono::days kLifeOfAuthority(20 * 365);
constexpr std::chrono::days kSkewOfClocks(1);

}  // namespace

struct Authority::Keys {
  Key identity_key, permissions_key;
  Certificate identity, permissions;
  RevokedList revoked;

  Issuer identity_issuer() const { return {*identity, *identity_key}; }
  Issuer permissions_issuer() const { return {*permissions, *permissions_key}; }
};

Authority::Authority(const std::string& folder) : folder_(folder), keys_(std::make_unique<Keys>()) {
  const fs::path at = folder_;
  if (fs::exists(at / "ca" / "identity_private.pem")) {
    open();
    return;
  }
  if (fs::exists(at / "identity_ca.pem"))
    throw Error({"the CA's private keys are not here", (at / "ca").string(),
                 "call vindu keys on the machine that made these keys, or choose another --out"});
  make();
}
Authority::~Authority() = default;

/// The public files last: with them the folder counts as made.
void Authority::make() {
  is_new_ = true;
  const auto now = system_clock::now();
  const Validity validity{now - kSkewOfClocks, now + kLifeOfAuthority};
  keys_->identity_key = new_key();
  keys_->permissions_key = new_key();
  keys_->identity = make_certificate({"identity CA", kUnit, Use::signs_certificates, validity},
                                     *keys_->identity_key, std::nullopt);
  keys_->permissions = make_certificate({"permissions CA", kUnit, Use::signs_documents, validity},
                                        *keys_->permissions_key, std::nullopt);
  keys_->revoked = make_revoked_list({}, keys_->identity_issuer());
  const fs::path at = folder_;
  write_key_file(at / "revoked.pem", pem_of(*keys_->revoked));
  write_key_file(at / "governance.p7s",
                 sign_document(governance_document(), keys_->permissions_issuer()));
  write_key_file(at / "ca" / "issued", "");
  write_key_file(at / "ca" / "permissions_private.pem", pem_of(*keys_->permissions_key));
  write_key_file(at / "permissions_ca.pem", pem_of(*keys_->permissions));
  write_key_file(at / "ca" / "identity_private.pem", pem_of(*keys_->identity_key));
  write_key_file(at / "identity_ca.pem", pem_of(*keys_->identity));
}

void Authority::open() {
  const auto file = [this](const char* name) { return fs::path(folder_) / name; };
  for (const char* name : {"ca/identity_private.pem", "ca/permissions_private.pem"})
    expect_private(file(name));
  const auto key = [&](const char* name) {
    return key_from(read_key_file(file(name)), file(name));
  };
  const auto certificate = [&](const char* name) {
    return certificate_from(read_key_file(file(name)), file(name));
  };
  keys_->identity_key = key("ca/identity_private.pem");
  keys_->permissions_key = key("ca/permissions_private.pem");
  keys_->identity = certificate("identity_ca.pem");
  keys_->permissions = certificate("permissions_ca.pem");
  keys_->revoked = revoked_list_from(read_key_file(file("revoked.pem")), file("revoked.pem"));
}

system_clock::time_point Authority::until() const { return end_of(*keys_->identity); }

void Authority::issue(const KeyOwner& owner, const Validity& validity) {
  const std::string name = name_of(owner);
  const Key key = new_key();
  const Certificate certificate =
      make_certificate({.name = owner.host.empty() ? name : owner.host,
                        .unit = std::string(name_of(owner.role)),
                        .use = Use::is_a_participant,
                        .validity = {validity.from, std::min(validity.until, until())}},
                       *key, keys_->identity_issuer());
  const fs::path at = folder_, own = at / name;
  write_key_file(at / "ca" / "issued",
                 read_key_file(at / "ca" / "issued") + serial_of(*certificate) + " " + name + "\n");
  write_key_file(own / "private.pem", pem_of(*key));
  write_key_file(own / "permissions.p7s",
                 sign_document(permissions_document(subject_of(*certificate), owner.role, validity),
                               keys_->permissions_issuer()));
  write_key_file(own / "certificate.pem", pem_of(*certificate));
}

std::vector<std::string> Authority::issued_to(const std::string& name) const {
  std::istringstream lines(read_key_file(fs::path(folder_) / "ca" / "issued"));
  std::vector<std::string> serials;
  for (std::string serial, owner; lines >> serial >> owner;)
    if (owner == name) serials.push_back(serial);
  return serials;
}

int Authority::revoke(const KeyOwner& owner) {
  const std::vector<std::string> serials = issued_to(name_of(owner));
  std::vector<std::string> all = serials_in(*keys_->revoked);
  for (const std::string& serial : serials)
    if (std::ranges::find(all, serial) == all.end()) all.push_back(serial);
  keys_->revoked = make_revoked_list(all, keys_->identity_issuer());
  write_key_file(fs::path(folder_) / "revoked.pem", pem_of(*keys_->revoked));
  return static_cast<int>(serials.size());
}

}  // namespace vindu
