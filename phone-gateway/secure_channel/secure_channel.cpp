#include "phone-gateway/secure_channel/secure_channel.h"

#include <openssl/core_names.h>
#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/kdf.h>
#include <openssl/x509.h>

#include "common/error.h"

namespace nao {
namespace {

constexpr char kVersion = 1;
constexpr std::string_view kKeyLabel = "nao-remote relay 1";
constexpr size_t kNumberBytes = 8;
constexpr size_t kHeaderBytes = 2 * kNumberBytes;
constexpr size_t kTagBytes = 16;
constexpr size_t kKeyBytes = 32;
constexpr int kNonceBytes = 12;

void check(bool is_good, const char* what) {
  if (!is_good) throw Error(std::string("OpenSSL fails: ") + what);
}

const unsigned char* bytes(std::string_view text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}
unsigned char* bytes(std::string& text) {
  return reinterpret_cast<unsigned char*>(text.data());
}
int length(std::string_view text) {
  return static_cast<int>(text.size());
}

void append_number(std::string& to, uint64_t number) {
  for (int shift = 56; shift >= 0; shift -= 8) to.push_back(static_cast<char>(number >> shift));
}
uint64_t read_number(std::string_view from) {
  uint64_t number = 0;
  for (size_t i = 0; i < kNumberBytes; ++i) {
    number = number << 8 | static_cast<unsigned char>(from[i]);
  }
  return number;
}

/** Nonce of a frame, by its header. */
std::string make_nonce(std::string_view header) {
  return std::string(kNonceBytes - kNumberBytes, '\0').append(header.substr(0, kNumberBytes));
}

struct FreeContext {
  void operator()(EVP_PKEY_CTX* context) const { EVP_PKEY_CTX_free(context); }
};
using Context = std::unique_ptr<EVP_PKEY_CTX, FreeContext>;

std::string derive_keys(std::string_view shared, std::string_view secret, const std::string& info) {
  const Context context(EVP_PKEY_CTX_new_id(EVP_PKEY_HKDF, nullptr));
  std::string keys(2 * kKeyBytes, '\0');
  size_t size = keys.size();
  check(context && EVP_PKEY_derive_init(context.get()) > 0 &&
            EVP_PKEY_CTX_set_hkdf_md(context.get(), EVP_sha256()) > 0 &&
            EVP_PKEY_CTX_set1_hkdf_salt(context.get(), bytes(secret), length(secret)) > 0 &&
            EVP_PKEY_CTX_set1_hkdf_key(context.get(), bytes(shared), length(shared)) > 0 &&
            EVP_PKEY_CTX_add1_hkdf_info(context.get(), bytes(info), length(info)) > 0 &&
            EVP_PKEY_derive(context.get(), bytes(keys), &size) > 0,
        "HKDF");
  return keys;
}

}  // namespace

void EphemeralKey::Free::operator()(evp_pkey_st* key) const {
  EVP_PKEY_free(key);
}
void SecureChannel::FreeCipher::operator()(evp_cipher_ctx_st* cipher) const {
  EVP_CIPHER_CTX_free(cipher);
}

EphemeralKey::EphemeralKey() : key_(EVP_EC_gen("P-256")) {
  check(key_ != nullptr, "new P-256 key");
}

EphemeralKey::EphemeralKey(std::string_view pkcs8) {
  const unsigned char* position = bytes(pkcs8);
  key_.reset(d2i_AutoPrivateKey(nullptr, &position, length(pkcs8)));
  check(key_ != nullptr, "private key");
}

std::string EphemeralKey::public_key() const {
  std::string key(kPublicKeyBytes, '\0');
  size_t size = 0;
  check(EVP_PKEY_get_octet_string_param(key_.get(), OSSL_PKEY_PARAM_PUB_KEY, bytes(key), key.size(),
                                        &size) == 1 &&
            size == key.size(),
        "public key");
  return key;
}

std::optional<std::string> EphemeralKey::agree(std::string_view other_public_key) const {
  const std::unique_ptr<evp_pkey_st, Free> other(EVP_PKEY_new());
  check(other && EVP_PKEY_copy_parameters(other.get(), key_.get()) == 1, "P-256");
  // Checks that the point is on the curve (SEC 1, 3.2.2.1); the curve's cofactor is 1.
  if (other_public_key.size() != kPublicKeyBytes ||
      EVP_PKEY_set1_encoded_public_key(other.get(), bytes(other_public_key),
                                       other_public_key.size()) != 1) {
    return std::nullopt;
  }
  const Context context(EVP_PKEY_CTX_new(key_.get(), nullptr));
  std::string shared(32, '\0');
  size_t size = shared.size();
  if (!context || EVP_PKEY_derive_init(context.get()) != 1 ||
      EVP_PKEY_derive_set_peer(context.get(), other.get()) != 1 ||
      EVP_PKEY_derive(context.get(), bytes(shared), &size) != 1 || size != shared.size()) {
    return std::nullopt;
  }
  return shared;
}

std::optional<std::string_view> hello_invitation(std::string_view hello) {
  if (hello.size() != kHelloBytes || hello.front() != kVersion) return std::nullopt;
  return hello.substr(1, kInvitationIdBytes);
}

const char* describe(FrameFault fault) {
  switch (fault) {
    case FrameFault::kNone:
      return "The message is good.";
    case FrameFault::kTooShort:
      return "The message is too short to be encrypted.";
    case FrameFault::kReplayed:
      return "The message was received before.";
    case FrameFault::kOutOfOrder:
      return "A message before this one is missing.";
    case FrameFault::kTampered:
      return "The message was changed on its way, or its sender lacks the secret.";
  }
  return "";
}

SecureChannel::SecureChannel(Side side, std::string_view shared, std::string_view secret,
                             std::string_view hello, std::string_view gateway_public_key)
    : sealing_(EVP_CIPHER_CTX_new()), opening_(EVP_CIPHER_CTX_new()) {
  const std::string keys =
      derive_keys(shared, secret, std::string(kKeyLabel).append(hello).append(gateway_public_key));
  const unsigned char* of_phone = bytes(std::string_view(keys));
  const unsigned char* of_gateway = of_phone + kKeyBytes;
  const bool is_phone = side == Side::kPhone;
  check(sealing_ && opening_ &&
            EVP_EncryptInit_ex(sealing_.get(), EVP_aes_256_gcm(), nullptr,
                               is_phone ? of_phone : of_gateway, nullptr) == 1 &&
            EVP_DecryptInit_ex(opening_.get(), EVP_aes_256_gcm(), nullptr,
                               is_phone ? of_gateway : of_phone, nullptr) == 1,
        "AES-256-GCM");
}

SecureChannel::~SecureChannel() = default;
SecureChannel::SecureChannel(SecureChannel&&) noexcept = default;
SecureChannel& SecureChannel::operator=(SecureChannel&&) noexcept = default;

std::string SecureChannel::seal(std::string_view text) {
  std::string frame;
  frame.reserve(text.size() + kFrameOverheadBytes);
  append_number(frame, num_sealed_++);
  append_number(frame, num_opened_);
  const std::string nonce = make_nonce(frame);
  frame.resize(text.size() + kFrameOverheadBytes);
  EVP_CIPHER_CTX* cipher = sealing_.get();
  unsigned char* out = bytes(frame);
  unsigned char* tag = out + kHeaderBytes + text.size();
  int size = 0;
  check(
      EVP_EncryptInit_ex(cipher, nullptr, nullptr, nullptr, bytes(std::string_view(nonce))) == 1 &&
          EVP_EncryptUpdate(cipher, nullptr, &size, out, kHeaderBytes) == 1 &&
          EVP_EncryptUpdate(cipher, out + kHeaderBytes, &size, bytes(text), length(text)) == 1 &&
          EVP_EncryptFinal_ex(cipher, tag, &size) == 1 &&
          EVP_CIPHER_CTX_ctrl(cipher, EVP_CTRL_GCM_GET_TAG, kTagBytes, tag) == 1,
      "encryption");
  return frame;
}

OpenedFrame SecureChannel::open(std::string_view frame) {
  if (frame.size() < kFrameOverheadBytes) return {FrameFault::kTooShort, "", 0};
  const uint64_t number = read_number(frame);
  if (number != num_opened_) {
    return {number < num_opened_ ? FrameFault::kReplayed : FrameFault::kOutOfOrder, "", 0};
  }
  const std::string_view header = frame.substr(0, kHeaderBytes);
  const std::string_view text = frame.substr(kHeaderBytes, frame.size() - kFrameOverheadBytes);
  std::string tag(frame.substr(frame.size() - kTagBytes));
  const std::string nonce = make_nonce(header);
  EVP_CIPHER_CTX* cipher = opening_.get();
  OpenedFrame opened;
  opened.text.resize(text.size());
  int size = 0;
  const bool is_good =
      EVP_DecryptInit_ex(cipher, nullptr, nullptr, nullptr, bytes(std::string_view(nonce))) == 1 &&
      EVP_DecryptUpdate(cipher, nullptr, &size, bytes(header), length(header)) == 1 &&
      EVP_DecryptUpdate(cipher, bytes(opened.text), &size, bytes(text), length(text)) == 1 &&
      EVP_CIPHER_CTX_ctrl(cipher, EVP_CTRL_GCM_SET_TAG, kTagBytes, tag.data()) == 1 &&
      EVP_DecryptFinal_ex(cipher, bytes(tag), &size) == 1;
  if (!is_good) return {FrameFault::kTampered, "", 0};
  ++num_opened_;
  opened.num_received_by_other = read_number(frame.substr(kNumberBytes));
  return opened;
}

std::optional<AnsweredHello> answer_hello(const EphemeralKey& key, std::string_view hello,
                                          std::string_view secret) {
  if (!hello_invitation(hello)) return std::nullopt;
  const auto shared = key.agree(hello.substr(1 + kInvitationIdBytes));
  if (!shared) return std::nullopt;
  const std::string public_key = key.public_key();
  AnsweredHello answered{
      std::string(1, kVersion) + public_key,
      SecureChannel(SecureChannel::Side::kGateway, *shared, secret, hello, public_key)};
  answered.answer += answered.channel.seal("");
  return answered;
}

}  // namespace nao
