#include "messages/result_message.h"

namespace nao {

naolcm::command_result_t to_message(const CommandResult& result, int64_t utime) {
  naolcm::command_result_t message;
  message.utime = utime;
  message.source = result.source;
  message.command_id = result.id;
  message.command_kind = static_cast<int8_t>(result.kind);
  message.status = static_cast<int8_t>(result.status);
  message.reason_code = result.reason.code;
  message.num_reason_arguments = static_cast<int>(result.reason.arguments.size());
  message.reason_arguments = result.reason.arguments;
  message.reason = to_sentence(result.reason);
  return message;
}

}  // namespace nao
