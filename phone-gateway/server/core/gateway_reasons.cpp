#include "phone-gateway/server/core/gateway_reasons.h"

namespace nao::gateway {

Reason gateway_reason(GatewayReasonCode code, std::vector<std::string> arguments) {
  Reason reason;
  reason.code = code.text();
  reason.arguments = std::move(arguments);
  return reason;
}

std::string describe_reason(const Reason& reason) {
  const size_t index = find_gateway_reason(reason.code);
  // Not one of the gateway's: motion's own, from the shared table.
  if (index == kGatewayReasons.size()) return to_sentence(reason);
  return fill_in_arguments(kGatewayReasons[index].sentence, reason.arguments);
}

}  // namespace nao::gateway
