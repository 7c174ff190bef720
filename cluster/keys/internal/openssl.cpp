#include "cluster/keys/internal/openssl.h"

#include <openssl/err.h>
#include <openssl/x509v3.h>

#include <ctime>
#include <utility>

#include "core/error.h"

namespace vindu::internal {
namespace {

using Memory = std::unique_ptr<BIO, Freed<&BIO_free_all>>;
using Number = std::unique_ptr<BIGNUM, Freed<&BN_free>>;
using SerialNumber = std::unique_ptr<ASN1_INTEGER, Freed<&ASN1_INTEGER_free>>;
using ClockTime = std::unique_ptr<ASN1_TIME, Freed<&ASN1_TIME_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Freed<&X509_EXTENSION_free>>;
using Store = std::unique_ptr<X509_STORE, Freed<&X509_STORE_free>>;
using StoreContext = std::unique_ptr<X509_STORE_CTX, Freed<&X509_STORE_CTX_free>>;
using SignedDocument = std::unique_ptr<PKCS7, Freed<&PKCS7_free>>;

std::string last_reason() {
  const char* const reason = ERR_reason_error_string(ERR_get_error());
  ERR_clear_error();
  return reason ? reason : "no reason given";
}

/// Most of these fail for lack of memory alone.
template <class T>
T expect(T result, const char* what) {
  if (!result) throw Error({std::string("OpenSSL: ") + last_reason(), what, ""});
  return result;
}

Memory memory_of(const std::string& text) {
  return Memory(expect(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())), "memory"));
}

template <class Write>
std::string written(Write write) {
  const Memory memory(expect(BIO_new(BIO_s_mem()), "memory"));
  expect(write(memory.get()), "writing");
  char* begin = nullptr;
  const long size = BIO_get_mem_data(memory.get(), &begin);
  return {begin, static_cast<std::size_t>(size)};
}

[[noreturn]] void refuse(const std::string& what, const std::string& file) {
  throw Error({"is no " + what + " (" + last_reason() + ")", file,
               "bring it again (vindu deploy), or make it again (vindu keys --renew)"});
}

void add_extension(X509& certificate, const X509& issuer, int kind, const char* value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, const_cast<X509*>(&issuer), &certificate, nullptr, nullptr, 0);
  const Extension extension(expect(X509V3_EXT_conf_nid(nullptr, &context, kind, value), value));
  expect(X509_add_ext(&certificate, extension.get(), -1), value);
}

/// A document is believed that is signed by whom the permissions CA certified, too: so that one may
/// certify nobody (no keyCertSign).
void add_uses(X509& certificate, const X509& issuer, Use use) {
  const bool authority = use != Use::is_a_participant;
  add_extension(certificate, issuer, NID_basic_constraints,
                authority ? "critical,CA:TRUE,pathlen:0" : "critical,CA:FALSE");
  add_extension(certificate, issuer, NID_key_usage,
                use == Use::signs_certificates ? "critical,keyCertSign,cRLSign"
                                               : "critical,digitalSignature");
  add_extension(certificate, issuer, NID_subject_key_identifier, "hash");
  if (!authority) add_extension(certificate, issuer, NID_authority_key_identifier, "keyid:always");
}

void set_name(X509& certificate, const CertificateRequest& request) {
  X509_NAME* const name = X509_get_subject_name(&certificate);
  const auto add = [name](const char* field, const std::string& value) {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(value.data());
    if (!X509_NAME_add_entry_by_txt(name, field, MBSTRING_ASC, bytes,
                                    static_cast<int>(value.size()), -1, 0))
      throw Error({"cannot stand in a certificate (" + last_reason() + ")", "\"" + value + "\"",
                   "use a host name of up to 64 letters"});
  };
  add("OU", request.unit);
  add("CN", request.name);
}

SerialNumber serial_from(const std::string& hexadecimal) {
  BIGNUM* parsed = nullptr;
  expect(BN_hex2bn(&parsed, hexadecimal.c_str()), "serial number");
  const Number number(parsed);
  return SerialNumber(expect(BN_to_ASN1_INTEGER(number.get(), nullptr), "serial number"));
}

std::string hexadecimal(const ASN1_INTEGER& serial) {
  const Number number(expect(ASN1_INTEGER_to_BN(&serial, nullptr), "serial number"));
  char* const text = expect(BN_bn2hex(number.get()), "serial number");
  std::string result = text;
  OPENSSL_free(text);
  return result;
}

void set_random_serial(X509& certificate) {
  const Number number(expect(BN_new(), "serial number"));
  expect(BN_rand(number.get(), 127, BN_RAND_TOP_ONE, BN_RAND_BOTTOM_ANY), "serial number");
  expect(BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(&certificate)), "serial number");
}

}  // namespace

Key new_key() { return Key(expect(EVP_EC_gen("P-256"), "a new key")); }

std::string pem_of(const EVP_PKEY& key) {
  return written([&](BIO* to) {
    return PEM_write_bio_PKCS8PrivateKey(to, const_cast<EVP_PKEY*>(&key), nullptr, nullptr, 0,
                                         nullptr, nullptr);
  });
}

std::string pem_of(const X509& certificate) {
  return written([&](BIO* to) { return PEM_write_bio_X509(to, const_cast<X509*>(&certificate)); });
}

std::string pem_of(const X509_CRL& list) {
  return written([&](BIO* to) { return PEM_write_bio_X509_CRL(to, const_cast<X509_CRL*>(&list)); });
}

Key key_from(const std::string& text, const std::string& file) {
  Key key(PEM_read_bio_PrivateKey(memory_of(text).get(), nullptr, nullptr, nullptr));
  if (!key) refuse("private key", file);
  return key;
}

Certificate certificate_from(const std::string& text, const std::string& file) {
  Certificate certificate(PEM_read_bio_X509(memory_of(text).get(), nullptr, nullptr, nullptr));
  if (!certificate) refuse("certificate", file);
  return certificate;
}

RevokedList revoked_list_from(const std::string& text, const std::string& file) {
  RevokedList list(PEM_read_bio_X509_CRL(memory_of(text).get(), nullptr, nullptr, nullptr));
  if (!list) refuse("list of revoked certificates", file);
  return list;
}

Certificate make_certificate(const CertificateRequest& request, EVP_PKEY& key,
                             const std::optional<Issuer>& issuer) {
  using std::chrono::system_clock;
  Certificate made(expect(X509_new(), "a certificate"));
  const X509& by = issuer ? issuer->certificate : std::as_const(*made);
  expect(X509_set_version(made.get(), X509_VERSION_3), "version");
  set_random_serial(*made);
  set_name(*made, request);
  expect(X509_set_issuer_name(made.get(), X509_get_subject_name(&by)), "issuer");
  expect(X509_set_pubkey(made.get(), &key), "public key");
  const auto set = [](ASN1_TIME* time, system_clock::time_point value) {
    expect(ASN1_TIME_set(time, system_clock::to_time_t(value)), "time");
  };
  set(X509_getm_notBefore(made.get()), request.validity.from);
  set(X509_getm_notAfter(made.get()), request.validity.until);
  add_uses(*made, by, request.use);
  expect(X509_sign(made.get(), issuer ? &issuer->key : &key, EVP_sha256()), "signing");
  return made;
}

std::string serial_of(const X509& certificate) {
  return hexadecimal(*X509_get0_serialNumber(&certificate));
}

std::string subject_of(const X509& certificate) {
  return written([&](BIO* to) {
    return X509_NAME_print_ex(to, X509_get_subject_name(&certificate), 0, XN_FLAG_RFC2253) > 0;
  });
}

std::chrono::system_clock::time_point end_of(const X509& certificate) {
  std::tm time{};
  expect(ASN1_TIME_to_tm(X509_get0_notAfter(&certificate), &time), "time");
  return std::chrono::system_clock::from_time_t(timegm(&time));
}

RevokedList make_revoked_list(const std::vector<std::string>& serials, const Issuer& issuer) {
  RevokedList list(expect(X509_CRL_new(), "a list"));
  expect(X509_CRL_set_version(list.get(), X509_CRL_VERSION_2), "version");
  expect(X509_CRL_set_issuer_name(list.get(), X509_get_subject_name(&issuer.certificate)),
         "issuer");
  const ClockTime now(expect(X509_time_adj_ex(nullptr, -1, 0, nullptr), "time"));
  expect(X509_CRL_set1_lastUpdate(list.get(), now.get()), "time");
  expect(X509_CRL_set1_nextUpdate(list.get(), X509_get0_notAfter(&issuer.certificate)), "time");
  for (const std::string& serial : serials) {
    X509_REVOKED* const entry = expect(X509_REVOKED_new(), "an entry");
    X509_REVOKED_set_serialNumber(entry, serial_from(serial).get());
    X509_REVOKED_set_revocationDate(entry, now.get());
    expect(X509_CRL_add0_revoked(list.get(), entry), "an entry");
  }
  X509_CRL_sort(list.get());
  expect(X509_CRL_sign(list.get(), &issuer.key, EVP_sha256()), "signing");
  return list;
}

std::vector<std::string> serials_in(const X509_CRL& list) {
  STACK_OF(X509_REVOKED)* const entries = X509_CRL_get_REVOKED(const_cast<X509_CRL*>(&list));
  std::vector<std::string> serials;
  for (int i = 0; i < sk_X509_REVOKED_num(entries); ++i)
    serials.push_back(
        hexadecimal(*X509_REVOKED_get0_serialNumber(sk_X509_REVOKED_value(entries, i))));
  return serials;
}

bool is_revoked(const X509_CRL& list, const X509& certificate) {
  X509_REVOKED* entry = nullptr;
  return X509_CRL_get0_by_cert(const_cast<X509_CRL*>(&list), &entry,
                               const_cast<X509*>(&certificate)) == 1;
}

std::string sign_document(const std::string& text, const Issuer& signer) {
  const Memory content = memory_of(text);
  const SignedDocument document(
      expect(PKCS7_sign(const_cast<X509*>(&signer.certificate), &signer.key, nullptr, content.get(),
                        PKCS7_TEXT | PKCS7_DETACHED),
             "signing"));
  const Memory again = memory_of(text);
  return written([&](BIO* to) {
    return SMIME_write_PKCS7(to, document.get(), again.get(), PKCS7_TEXT | PKCS7_DETACHED);
  });
}

bool is_signed_by(const std::string& document, const X509& signer) {
  BIO* content = nullptr;
  const SignedDocument read(SMIME_read_PKCS7(memory_of(document).get(), &content));
  const Memory text(content);
  const Store store(expect(X509_STORE_new(), "a store"));
  expect(X509_STORE_add_cert(store.get(), const_cast<X509*>(&signer)), "a store");
  const Memory ignored(expect(BIO_new(BIO_s_mem()), "memory"));
  const bool good =
      read && text &&
      PKCS7_verify(read.get(), nullptr, store.get(), text.get(), ignored.get(), PKCS7_TEXT) == 1;
  ERR_clear_error();
  return good;
}

std::string why_not(const X509& certificate, const X509& authority, const X509_CRL& revoked) {
  const Store store(expect(X509_STORE_new(), "a store"));
  expect(X509_STORE_add_cert(store.get(), const_cast<X509*>(&authority)), "a store");
  expect(X509_STORE_add_crl(store.get(), const_cast<X509_CRL*>(&revoked)), "a store");
  expect(X509_STORE_set_flags(store.get(), X509_V_FLAG_CRL_CHECK), "a store");
  const StoreContext context(expect(X509_STORE_CTX_new(), "a context"));
  expect(X509_STORE_CTX_init(context.get(), store.get(), const_cast<X509*>(&certificate), nullptr),
         "a context");
  const bool good = X509_verify_cert(context.get()) == 1;
  ERR_clear_error();
  return good ? "" : X509_verify_cert_error_string(X509_STORE_CTX_get_error(context.get()));
}

}  // namespace vindu::internal
