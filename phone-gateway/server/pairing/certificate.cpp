#include "phone-gateway/server/pairing/certificate.h"

#include <openssl/bn.h>
#include <openssl/ec.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

#include "common/error.h"
#include "common/output_file.h"

namespace nao::gateway {
namespace {

/** Apple's devices accept at most 825 days (support.apple.com/HT210176). */
constexpr long kLifeSeconds = 800L * 24 * 3600;
/** A certificate that expires sooner is replaced. Chosen: a gateway that
 * runs for less than a week does not outlive its certificate. */
constexpr long kRenewSeconds = 7L * 24 * 3600;
/** Beginning of validity before now: the clocks of phones may be slow. */
constexpr long kBackdateSeconds = 24L * 3600;

template <class T, void (*Free)(T*)>
struct Freer {
  void operator()(T* object) const { Free(object); }
};
using Key = std::unique_ptr<EVP_PKEY, Freer<EVP_PKEY, EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Freer<X509, X509_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Freer<X509_EXTENSION, X509_EXTENSION_free>>;

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

void check(bool is_good, const std::string& what) {
  if (is_good) return;
  std::array<char, 256> text{};
  ERR_error_string_n(ERR_get_error(), text.data(), text.size());
  throw Error("cannot create a certificate: " + what + ": " + text.data());
}

Certificate read_certificate(const std::filesystem::path& path) {
  const File file(std::fopen(path.c_str(), "rb"));
  return Certificate(file ? PEM_read_X509(file.get(), nullptr, nullptr, nullptr) : nullptr);
}

bool is_good_for(X509* certificate, const CertificateNames& names) {
  time_t soon = time(nullptr) + kRenewSeconds;
  if (X509_cmp_time(X509_get0_notAfter(certificate), &soon) < 0) return false;
  const auto has_host = [&](const std::string& name) {
    return X509_check_host(certificate, name.c_str(), name.size(), 0, nullptr) == 1;
  };
  const auto has_address = [&](const std::string& address) {
    return X509_check_ip_asc(certificate, address.c_str(), 0) == 1;
  };
  return std::all_of(names.host_names.begin(), names.host_names.end(), has_host) &&
         std::all_of(names.addresses.begin(), names.addresses.end(), has_address);
}

void add_extension(X509* certificate, int kind, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, certificate, certificate, nullptr, nullptr, 0);
  const Extension extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str()));
  check(extension != nullptr, value);
  check(X509_add_ext(certificate, extension.get(), -1) == 1, value);
}

Certificate make_certificate(EVP_PKEY* key, const CertificateNames& names) {
  Certificate certificate(X509_new());
  X509* x509 = certificate.get();
  check(x509 != nullptr && X509_set_version(x509, X509_VERSION_3) == 1, "version");
  const std::unique_ptr<BIGNUM, Freer<BIGNUM, BN_free>> serial(BN_new());
  check(BN_rand(serial.get(), 127, BN_RAND_TOP_ANY, BN_RAND_BOTTOM_ANY) == 1, "serial number");
  check(BN_to_ASN1_INTEGER(serial.get(), X509_get_serialNumber(x509)) != nullptr, "serial number");
  X509_gmtime_adj(X509_getm_notBefore(x509), -kBackdateSeconds);
  X509_gmtime_adj(X509_getm_notAfter(x509), kLifeSeconds - kBackdateSeconds);
  X509_NAME* subject = X509_get_subject_name(x509);
  const auto* common_name = reinterpret_cast<const unsigned char*>(names.host_names.at(0).c_str());
  check(X509_NAME_add_entry_by_txt(subject, "CN", MBSTRING_UTF8, common_name, -1, -1, 0) == 1,
        "name");
  check(X509_set_issuer_name(x509, subject) == 1, "issuer");
  check(X509_set_pubkey(x509, key) == 1, "key");
  std::string alternatives;
  for (const std::string& name : names.host_names) alternatives += ",DNS:" + name;
  for (const std::string& address : names.addresses) alternatives += ",IP:" + address;
  add_extension(x509, NID_subject_alt_name, alternatives.substr(1));
  add_extension(x509, NID_basic_constraints, "critical,CA:FALSE");
  add_extension(x509, NID_key_usage, "critical,digitalSignature");
  add_extension(x509, NID_ext_key_usage, "serverAuth");
  check(X509_sign(x509, key, EVP_sha256()) != 0, "signature");
  return certificate;
}

/** A PEM text that a function of OpenSSL writes. */
template <class Write>
std::string to_pem(Write write, const std::string& what) {
  const std::unique_ptr<BIO, Freer<BIO, BIO_free_all>> memory(BIO_new(BIO_s_mem()));
  check(memory && write(memory.get()) == 1, what);
  char* text = nullptr;
  const long size = BIO_get_mem_data(memory.get(), &text);
  return {text, static_cast<size_t>(size)};
}

bool have_same_key(X509* certificate, const std::filesystem::path& key_file) {
  const File file(std::fopen(key_file.c_str(), "rb"));
  const Key key(file ? PEM_read_PrivateKey(file.get(), nullptr, nullptr, nullptr) : nullptr);
  return key && X509_check_private_key(certificate, key.get()) == 1;
}

}  // namespace

CertificateFiles own_certificate(const std::filesystem::path& folder,
                                 const CertificateNames& names) {
  CertificateFiles files{folder / "gateway-certificate.pem", folder / "gateway-key.pem"};
  const Certificate old = read_certificate(files.certificate);
  // A start that was interrupted may have left the key of another certificate.
  if (old && have_same_key(old.get(), files.key) && is_good_for(old.get(), names)) return files;

  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error("cannot create the folder " + folder.string() + ": " + error.message());
  const Key key(EVP_EC_gen("P-256"));
  check(key != nullptr, "key");
  const Certificate certificate = make_certificate(key.get(), names);
  const auto write_key = [&](BIO* memory) {
    return PEM_write_bio_PrivateKey(memory, key.get(), nullptr, nullptr, 0, nullptr, nullptr);
  };
  const auto write_certificate = [&](BIO* memory) {
    return PEM_write_bio_X509(memory, certificate.get());
  };
  replace_file(files.key, to_pem(write_key, "key file"), S_IRUSR | S_IWUSR);
  replace_file(files.certificate, to_pem(write_certificate, "certificate file"));
  return files;
}

std::string certificate_fingerprint(const std::filesystem::path& path) {
  const Certificate certificate = read_certificate(path);
  if (!certificate) throw Error(path.string() + " is not a certificate");
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  check(X509_digest(certificate.get(), EVP_sha256(), digest.data(), &size) == 1, "fingerprint");
  std::string text;
  for (unsigned i = 0; i < size; ++i) {
    std::array<char, 4> byte{};
    std::snprintf(byte.data(), byte.size(), "%s%02X", i == 0 ? "" : ":", digest[i]);
    text += byte.data();
  }
  return text;
}

}  // namespace nao::gateway
