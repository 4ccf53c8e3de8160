#include "messages/command.h"

#include "messages/enum_names.h"

namespace nao {
namespace {

// Limits of a command's description, characters and joints: it goes into one line of a log or of an
// app. Chosen.
constexpr size_t kMaxQuotedLength = 40;
constexpr size_t kMaxNamesListed = 4;
// Longest name of a source, characters. Chosen: a host name and a program name fit in.
constexpr size_t kMaxSourceLength = 64;

}  // namespace

const char* to_string(CommandKind kind) {
  if (kind == CommandKind::kMatch) return "match";
  static constexpr auto kNames = std::to_array<const char*>(
      {"walk", "move-to", "posture", "joint-change", "action", "stop", "play", "speech", "light"});
  return name_in(kNames, kind);
}

const char* to_string(ResultStatus status) {
  static constexpr auto kNames =
      std::to_array<const char*>({"accepted", "refused", "done", "interrupted", "failed"});
  return name_in(kNames, status);
}

std::string quoted(const std::string& text) {
  std::string result = "\"" + text.substr(0, kMaxQuotedLength);
  // What a sender wrote must not break a line of a log, or hide in it.
  for (char& c : result) {
    if (c < ' ' || c > '~') c = '?';
  }
  return result + (text.size() > kMaxQuotedLength ? "...\"" : "\"");
}

std::optional<Reason> check_sender(const std::string& source, int64_t id) {
  if (source.empty()) return Reason("source-missing");
  if (source.size() > kMaxSourceLength) {
    return Reason("source-too-long",
                  {std::to_string(source.size()), std::to_string(kMaxSourceLength)});
  }
  if (id == 0) return Reason("command-id-zero");
  return std::nullopt;
}

std::string describe(const Command& command) {
  switch (kind_of(command)) {
    case CommandKind::kPosture:
      return std::get<PostureCommand>(command.request).posture;
    case CommandKind::kAction:
      return std::get<ActionCommand>(command.request).action;
    case CommandKind::kJointChange: {
      const auto& names = std::get<JointChangeCommand>(command.request).joint_names;
      std::string result;
      for (size_t i = 0; i < names.size() && i < kMaxNamesListed; ++i) {
        result += (i == 0 ? "" : ", ") + names[i];
      }
      return result + (names.size() > kMaxNamesListed ? ", ..." : "");
    }
    default:
      return to_string(kind_of(command));
  }
}

}  // namespace nao
