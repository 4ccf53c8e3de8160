// nao invite: invitations for phones that connect over nao-relay.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>

#include "common/command_line.h"
#include "common/error.h"
#include "phone-gateway/secure_channel/hexadecimal.h"
#include "phone-gateway/secure_channel/invitations.h"
#include "phone-gateway/server/pairing/qr_code.h"
#include "tools/nao/subcommand.h"

namespace nao {
namespace {

/** s. Chosen: a visitor of a year; longer is a mistake. */
constexpr double kLongestTime = 366.0 * 24 * 3600;

struct InviteOptions {
  std::string role = "drive";
  std::string time = "2h";
  bool lists = false;
  std::string revoked;
  std::string file;
};

double unix_seconds() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/** "2h" in s. @throws UsageError */
double parse_time(const std::string& text) {
  char* unit = nullptr;
  const double number = std::strtod(text.c_str(), &unit);
  const std::string name = unit;
  const double scale = name == "min" ? 60 : name == "h" ? 3600 : name == "d" ? 86400 : 0;
  const double time = number * scale;
  if (!std::isfinite(time) || time <= 0 || time > kLongestTime) {
    throw UsageError("--for", "'" + text + "' is no time up to 366d, such as 30min, 2h or 7d");
  }
  return time;
}

std::string local_time(double time) {
  const auto seconds = static_cast<std::time_t>(time);
  std::tm parts{};
  localtime_r(&seconds, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &parts);
  return text;
}

void print(const Invitation& invitation) {
  std::printf("%s  %s  until %s\n", to_hex(invitation.id).c_str(),
              role_name(invitation.role).c_str(), local_time(invitation.until).c_str());
}

int list(RelayAccess access) {
  std::erase_if(access.invitations, [now = unix_seconds()](const Invitation& invitation) {
    return invitation.until <= now;
  });
  for (const Invitation& invitation : access.invitations) print(invitation);
  if (access.invitations.empty()) std::puts("There is no invitation.");
  return 0;
}

int revoke(const std::string& file, const std::string& id) {
  size_t count = 0;
  change_relay_access(file, [&](RelayAccess& access) {
    count = std::erase_if(access.invitations, [&](const Invitation& invitation) {
      return invitation.until > unix_seconds() && (id == "all" || to_hex(invitation.id) == id);
    });
    if (count == 0 && id != "all") {
      throw Error("there is no invitation " + id + ": see nao invite --list");
    }
  });
  std::printf("%zu withdrawn; their phones are disconnected within a second.\n", count);
  return 0;
}

int invite(const std::string& file, const InviteOptions& options) {
  const double now = unix_seconds();
  const Invitation invitation =
      make_invitation(role_of_name(options.role), now + parse_time(options.time));
  const RelayAccess access = change_relay_access(file, [&](RelayAccess& changed) {
    if (changed.relay.empty()) {
      throw Error("no relay is known: start the robot with scripts/start --relay HOST first");
    }
    std::erase_if(changed.invitations, [&](const Invitation& old) { return old.until <= now; });
    changed.invitations.push_back(invitation);
  });
  const std::string link = invitation_link(access, invitation);
  std::printf("%s%s\n", gateway::draw_on_terminal(gateway::make_qr_code(link)).c_str(),
              link.c_str());
  print(invitation);
  return 0;
}

int execute(const InviteOptions& options) {
  const std::string file = options.file.empty() ? default_relay_file().string() : options.file;
  if (options.lists) return list(load_relay_access(file));
  if (!options.revoked.empty()) return revoke(file, options.revoked);
  return invite(file, options);
}

}  // namespace

void add_invite_command(CommandLine& app, Invocation& invocation) {
  CommandLine* command = app.add_subcommand(
      "invite",
      "Make a link, also as a QR code, with which a phone drives or watches the robot "
      "from anywhere, over nao-relay: docs/anywhere.md");
  const auto options = std::make_shared<InviteOptions>();
  command->add_option("--role", options->role, "What its phones may do")
      ->one_of({"drive", "watch", "operate"});
  command->add_option("--for", options->time, "How long it is valid: 30min, 2h, 7d");
  command->add_flag("--list", options->lists, "Show the valid invitations instead");
  command->add_option("--revoke", options->revoked,
                      "Withdraw the invitation of this number, or all, instead");
  command->add_option("--relay-file", options->file,
                      "The gateway's file of this name; default: "
                      "~/.local/state/nao-remote/relay.json");
  command->on_parsed([&invocation, options] {
    if (!options->lists && options->revoked.empty()) (void)parse_time(options->time);
    invocation.run = [options] { return execute(*options); };
  });
}

}  // namespace nao
