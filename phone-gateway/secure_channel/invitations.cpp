#include "phone-gateway/secure_channel/invitations.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "common/data_path.h"
#include "common/error.h"
#include "common/json_text.h"
#include "common/json_writer.h"
#include "common/output_file.h"
#include "common/text_file.h"
#include "phone-gateway/secure_channel/hexadecimal.h"
#include "phone-gateway/secure_channel/relay_target.h"
#include "phone-gateway/secure_channel/secure_channel.h"

namespace nao {
namespace {

/** Waits until no other program has the folder locked; ends with the object. */
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder)
      : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (descriptor_ < 0 || flock(descriptor_, LOCK_EX) != 0) {
      throw Error("cannot lock the folder " + folder.string() + ": " + std::strerror(errno));
    }
  }
  ~FolderLock() { close(descriptor_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

/** That of nao-relay. */
constexpr const char* kDefaultPort = "8443";
/** A name of the domain name system has at most 253 letters (RFC 1035, 2.3.4). */
constexpr size_t kMaxHostLetters = 253;

std::string require_hex(const nlohmann::json& value, size_t num_bytes) {
  const auto bytes = from_hex(value.get<std::string>(), num_bytes);
  if (!bytes) throw ConfigError("expected " + std::to_string(2 * num_bytes) + " digits");
  return *bytes;
}

bool is_host_letter(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '.' ||
         c == '-' || c == '_' || c == ':';
}

}  // namespace

const Invitation* RelayAccess::find(std::string_view id, double now) const {
  const auto found = std::find_if(invitations.begin(), invitations.end(),
                                  [&](const Invitation& other) { return other.id == id; });
  return found == invitations.end() || found->until <= now ? nullptr : &*found;
}

std::string role_name(Invitation::Role role) {
  switch (role) {
    case Invitation::Role::kDrive:
      return "drive";
    case Invitation::Role::kOperate:
      return "operate";
    default:
      return "watch";
  }
}

Invitation::Role role_of_name(const std::string& name) {
  if (name == "drive") return Invitation::Role::kDrive;
  if (name == "watch") return Invitation::Role::kWatch;
  if (name == "operate") return Invitation::Role::kOperate;
  throw ConfigError("there is no role " + name + ": use drive, watch or operate");
}

RelayAccess parse_relay_access(const std::string& text, const std::string& where) {
  RelayAccess access;
  try {
    const nlohmann::json file = parse_json(text);
    access.relay = file.at("relay").get<std::string>();
    if (!access.relay.empty()) (void)parse_relay_address(access.relay);
    access.key = to_hex(require_hex(file.at("key"), kRobotKeyBytes));
    for (const nlohmann::json& item : file.at("invitations")) {
      Invitation invitation;
      invitation.id = require_hex(item.at("id"), kInvitationIdBytes);
      invitation.secret = require_hex(item.at("secret"), kInvitationSecretBytes);
      invitation.role = role_of_name(item.at("role").get<std::string>());
      invitation.until = item.at("until").get<double>();
      access.invitations.push_back(invitation);
    }
  } catch (const nlohmann::json::exception& error) {
    throw ConfigError(where + ": " + error.what() + "; delete the file to begin anew");
  } catch (const ConfigError& error) {
    throw ConfigError(where + ": " + error.what() + "; delete the file to begin anew");
  }
  return access;
}

std::string write_relay_access(const RelayAccess& access) {
  JsonWriter json;
  json.begin_object();
  json.add("relay", access.relay);
  json.add("key", access.key);
  json.begin_array("invitations");
  for (const Invitation& invitation : access.invitations) {
    json.begin_object();
    json.add("id", to_hex(invitation.id));
    json.add("secret", to_hex(invitation.secret));
    json.add("role", role_name(invitation.role));
    json.add("until", invitation.until);
    json.end();
  }
  return json.take() + "\n";
}

RelayAccess load_relay_access(const std::filesystem::path& file) {
  return change_relay_access(file, [](RelayAccess&) {});
}

RelayAccess change_relay_access(const std::filesystem::path& file,
                                const std::function<void(RelayAccess&)>& change) {
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const FolderLock lock(folder);
  RelayAccess access;
  std::string old_text;
  if (std::filesystem::exists(file)) {
    old_text = read_file(file);
    access = parse_relay_access(old_text, file.string());
  } else {
    access.key = to_hex(random_bytes(kRobotKeyBytes));
  }
  change(access);
  const std::string text = write_relay_access(access);
  if (text != old_text) replace_file(file, text, S_IRUSR | S_IWUSR);
  return access;
}

std::filesystem::path default_relay_file() {
  return state_path() / "relay.json";
}

Invitation make_invitation(Invitation::Role role, double until) {
  return {random_bytes(kInvitationIdBytes), random_bytes(kInvitationSecretBytes), role, until};
}

std::string invitation_link(const RelayAccess& access, const Invitation& invitation) {
  const RelayAddress relay = parse_relay_address(access.relay);
  const bool is_v6 = relay.host.find(':') != std::string::npos;
  return "https://" + (is_v6 ? "[" + relay.host + "]" : relay.host) +
         (relay.port == "443" ? "" : ":" + relay.port) + "/#token=" + robot_of_key(access.key) +
         "." + to_hex(invitation.id) + "." + to_hex(invitation.secret);
}

RelayAddress parse_relay_address(const std::string& text) {
  RelayAddress address{text, kDefaultPort};
  const bool is_v6 = text.starts_with("[");
  const size_t end = is_v6 ? text.find(']') : std::min(text.find(':'), text.size());
  if (end != std::string::npos) {
    address.host = text.substr(is_v6 ? 1 : 0, end - (is_v6 ? 1 : 0));
    const std::string rest = text.substr(is_v6 ? end + 1 : end);
    if (rest.starts_with(":"))
      address.port = rest.substr(1);
    else if (!rest.empty())
      address.host.clear();
  }
  const bool is_port = !address.port.empty() && address.port.size() <= 5 &&
                       std::all_of(address.port.begin(), address.port.end(),
                                   [](char c) { return '0' <= c && c <= '9'; }) &&
                       std::stoi(address.port) >= 1 && std::stoi(address.port) <= 65535;
  if (end == std::string::npos || address.host.empty() || address.host.size() > kMaxHostLetters ||
      !is_port || !std::all_of(address.host.begin(), address.host.end(), is_host_letter)) {
    throw ConfigError("\"" + text + "\" is no address of a relay: use HOST or HOST:PORT");
  }
  return address;
}

}  // namespace nao
