#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace nao {

/** Lets who has it drive or watch a robot over nao-relay, until a time. */
struct Invitation {
  enum class Role { kDrive, kWatch, kOperate };

  /** kInvitationIdBytes and kInvitationSecretBytes. */
  std::string id;
  std::string secret;
  Role role = Role::kWatch;
  /** s since 1970, UTC. */
  double until = 0;
};

/** What a gateway knows of its relay. The file is kept by the gateway and `nao invite`, and nobody
 * else may read it. */
struct RelayAccess {
  /** HOST[:PORT] of the relay that the gateway used last; empty: none yet. */
  std::string relay;
  /** Of the robot, kRobotKeyBytes, hexadecimal. */
  std::string key;
  std::vector<Invitation> invitations;

  /** @return The invitation with that id if it is valid at a time, s since 1970; else nullptr. */
  const Invitation* find(std::string_view id, double now) const;
};

/** "drive", "watch" or "operate". */
std::string role_name(Invitation::Role role);
/** @throws ConfigError  It is no role's name. */
Invitation::Role role_of_name(const std::string& name);

/** @param where  For the errors' text. @throws ConfigError  It is not what write_relay_access()
 * writes. */
RelayAccess parse_relay_access(const std::string& text, const std::string& where);
std::string write_relay_access(const RelayAccess& access);

/** Reads the file; one that does not exist is created with a new key, readable by its owner only.
 * @throws ConfigError, Error */
RelayAccess load_relay_access(const std::filesystem::path& file);
/** Loads, changes and saves the file while other programs that do so wait.
 * @param change  What it throws leaves the file as it was. @throws ConfigError, Error */
RelayAccess change_relay_access(const std::filesystem::path& file,
                                const std::function<void(RelayAccess&)>& change);
/** relay.json in the folder of files that programs keep. */
std::filesystem::path default_relay_file();

/** A new invitation with random id and secret. */
Invitation make_invitation(Invitation::Role role, double until);

/** The link to open on a phone: "https://HOST:PORT/#token=ROBOT.ID.SECRET", all hexadecimal. What
 * follows # is not sent to the relay. */
std::string invitation_link(const RelayAccess& access, const Invitation& invitation);

/** Host and port of "HOST[:PORT]"; IPv6 addresses in brackets. */
struct RelayAddress {
  std::string host;
  std::string port;
};
/** @throws ConfigError  It is no such address. */
RelayAddress parse_relay_address(const std::string& text);

}  // namespace nao
