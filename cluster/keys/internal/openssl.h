// Owners of OpenSSL's things and the few operations on them that keys need: make, sign, check.
// Private to cluster/keys.
#pragma once

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cluster/keys/documents.h"

namespace vindu::internal {

template <auto free>
struct Freed {
  template <class T>
  void operator()(T* thing) const {
    free(thing);
  }
};
using Key = std::unique_ptr<EVP_PKEY, Freed<&EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Freed<&X509_free>>;
using RevokedList = std::unique_ptr<X509_CRL, Freed<&X509_CRL_free>>;

/// On the curve P-256.
Key new_key();

std::string pem_of(const EVP_PKEY& key);
std::string pem_of(const X509& certificate);
std::string pem_of(const X509_CRL& list);
/// Throw Error where `text`, the content of `file`, is none.
Key key_from(const std::string& text, const std::string& file);
Certificate certificate_from(const std::string& text, const std::string& file);
RevokedList revoked_list_from(const std::string& text, const std::string& file);

struct Issuer {
  const X509& certificate;
  EVP_PKEY& key;
};

enum class Use {
  signs_certificates,
  signs_documents,
  is_a_participant,
};

struct CertificateRequest {
  std::string name, unit;  ///< CN and OU
  Use use{};
  Validity validity{};
};

/// With a random serial number, for the key. No issuer: it signs itself. Throws Error where the
/// name is too long (64 letters) for a certificate.
Certificate make_certificate(const CertificateRequest& request, EVP_PKEY& key,
                             const std::optional<Issuer>& issuer);

/// Hexadecimal.
std::string serial_of(const X509& certificate);
/// "CN=tile-3-0,OU=tile"
std::string subject_of(const X509& certificate);
std::chrono::system_clock::time_point end_of(const X509& certificate);

/// Of certificates with these serial numbers, for as long as the issuer's certificate counts.
RevokedList make_revoked_list(const std::vector<std::string>& serials, const Issuer& issuer);
std::vector<std::string> serials_in(const X509_CRL& list);
bool is_revoked(const X509_CRL& list, const X509& certificate);

/// As S/MIME, whose signature is beside the readable text.
std::string sign_document(const std::string& text, const Issuer& signer);
bool is_signed_by(const std::string& document, const X509& signer);

/// Why a certificate does not count now; empty where it does.
std::string why_not(const X509& certificate, const X509& authority, const X509_CRL& revoked);

}  // namespace vindu::internal
