#pragma once

#include <cstdint>
#include <string>

namespace nao::gateway {

/** An event for the audit log: who connected, who drove, who was refused. */
struct AuditEvent {
  /** connected, refused, disconnected, drives, released or operator. */
  std::string event;
  /** 0 and empty for the operator's console. */
  uint32_t client_id = 0;
  std::string name;
  std::string address;
  /** Reason code, client software, or what the operator did. */
  std::string detail;
};

}  // namespace nao::gateway
