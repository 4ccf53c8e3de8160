#pragma once

#include <memory>
#include <string>

#include "phone-gateway/server/network/connection_context.h"

namespace nao::gateway {

/** Serves one phone at a time by Bluetooth: BlueZ sends a notification to all that ask for them.
 * Without Bluetooth all else goes on. */
class BluetoothServer {
 public:
  /** @param name  That phones show. */
  BluetoothServer(ConnectionContext& context, const std::string& name);
  ~BluetoothServer();
  BluetoothServer(const BluetoothServer&) = delete;
  BluetoothServer& operator=(const BluetoothServer&) = delete;

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace nao::gateway
