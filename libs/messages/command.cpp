#include "messages/command.h"

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
  switch (kind) {
    case CommandKind::kWalk:
      return "walk";
    case CommandKind::kMoveTo:
      return "move-to";
    case CommandKind::kPosture:
      return "posture";
    case CommandKind::kJointChange:
      return "joint-change";
    case CommandKind::kAction:
      return "action";
    case CommandKind::kStop:
      return "stop";
    case CommandKind::kPlay:
      return "play";
    case CommandKind::kSpeech:
      return "speech";
    case CommandKind::kLight:
      return "light";
    case CommandKind::kMatch:
      return "match";
  }
  return "unknown";
}

const char* to_string(ResultStatus status) {
  switch (status) {
    case ResultStatus::kAccepted:
      return "accepted";
    case ResultStatus::kRefused:
      return "refused";
    case ResultStatus::kDone:
      return "done";
    case ResultStatus::kInterrupted:
      return "interrupted";
    case ResultStatus::kFailed:
      return "failed";
  }
  return "unknown";
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
