#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

struct evp_cipher_ctx_st;
struct evp_pkey_st;

// End-to-end encryption between a phone and the gateway over nao-relay, which sees bytes only.
// Pure: no socket, no clock. The same in TypeScript: web/src/relay/secure_channel.ts.
//
//   phone -> gateway  hello   version 1 (1 byte), invitation (8), public key of the phone (65)
//   gateway -> phone  answer  version 1 (1 byte), public key of the gateway (65), an empty frame
//   both              frame   number (8), newest number received (8), text, tag (16)
//
// Keys: HKDF-SHA256 (RFC 5869) of the P-256 ECDH secret of two keys made for this connection (X
// coordinate, SEC 1, 3.3.1), with the invitation's secret as salt and kKeyLabel, hello and the
// gateway's public key as info; 32 bytes for the phone's frames, then 32 for the gateway's. Frames
// are AES-256-GCM (NIST SP 800-38D) with the number as nonce (4 bytes 0, then 8), and the first 16
// bytes authenticated. Numbers count from 0 in each direction, most significant byte first. Who has
// not the secret can make no frame, neither can who recorded an earlier connection.

namespace nao {

inline constexpr size_t kInvitationIdBytes = 8;
inline constexpr size_t kInvitationSecretBytes = 16;
/** Uncompressed point, SEC 1, 2.3.3. */
inline constexpr size_t kPublicKeyBytes = 65;
inline constexpr size_t kHelloBytes = 1 + kInvitationIdBytes + kPublicKeyBytes;
/** What a frame is longer than its text. */
inline constexpr size_t kFrameOverheadBytes = 8 + 8 + 16;

/** A P-256 key for one connection. */
class EphemeralKey {
 public:
  /** A new one. @throws Error  OpenSSL fails. */
  EphemeralKey();
  /** @param pkcs8  DER. @throws Error  It is no P-256 key. */
  explicit EphemeralKey(std::string_view pkcs8);

  /** kPublicKeyBytes. */
  std::string public_key() const;
  /** The shared secret, 32 bytes; nothing if the other's public key is no point of the curve. */
  [[nodiscard]] std::optional<std::string> agree(std::string_view other_public_key) const;

 private:
  struct Free {
    void operator()(evp_pkey_st* key) const;
  };
  std::unique_ptr<evp_pkey_st, Free> key_;
};

/** The id in a hello. @return Nothing if it is not a hello of this version. */
[[nodiscard]] std::optional<std::string_view> hello_invitation(std::string_view hello);

/** Why a frame is refused. */
enum class FrameFault { kNone, kTooShort, kReplayed, kOutOfOrder, kTampered };

/** One sentence of it, for logs and notices. */
const char* describe(FrameFault fault);

/** A received frame. */
struct OpenedFrame {
  FrameFault fault = FrameFault::kNone;
  /** Empty after a fault. */
  std::string text;
  /** How many of this side's frames the other side had received when it made this one. */
  uint64_t num_received_by_other = 0;
};

/** The two keys of a connection, and the numbers of its frames. */
class SecureChannel {
 public:
  enum class Side { kPhone, kGateway };

  /** @param shared  EphemeralKey::agree(). @param secret  Of the invitation. @param hello  As sent.
   * @throws Error  OpenSSL fails. */
  SecureChannel(Side side, std::string_view shared, std::string_view secret, std::string_view hello,
                std::string_view gateway_public_key);
  ~SecureChannel();
  SecureChannel(SecureChannel&&) noexcept;
  SecureChannel& operator=(SecureChannel&&) noexcept;

  /** The next frame of this side. */
  std::string seal(std::string_view text);
  /** The next frame of the other side. After a fault the connection must end. */
  [[nodiscard]] OpenedFrame open(std::string_view frame);

  /** Frames sealed until now. */
  uint64_t num_sealed() const { return num_sealed_; }

 private:
  struct FreeCipher {
    void operator()(evp_cipher_ctx_st* cipher) const;
  };
  using Cipher = std::unique_ptr<evp_cipher_ctx_st, FreeCipher>;

  Cipher sealing_;
  Cipher opening_;
  uint64_t num_sealed_ = 0;
  uint64_t num_opened_ = 0;
};

/** The gateway's part of the handshake. */
struct AnsweredHello {
  /** To be sent to the phone. */
  std::string answer;
  SecureChannel channel;
};
/** @param key  Made for this connection. @return Nothing if the hello has no valid public key. */
[[nodiscard]] std::optional<AnsweredHello> answer_hello(const EphemeralKey& key,
                                                        std::string_view hello,
                                                        std::string_view secret);

}  // namespace nao
