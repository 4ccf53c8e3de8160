#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace nao {

/** The service and its characteristic, chosen at random, and found by the app. */
inline constexpr const char* kBluetoothServiceUuid = "b1e6a0f2-4a53-4c0e-9d38-2f6c7e5d1a90";
inline constexpr const char* kBluetoothMessagesUuid = "b1e6a0f3-4a53-4c0e-9d38-2f6c7e5d1a90";

/** What phones do with the characteristic. A phone is named by its device's path at BlueZ. */
struct BluetoothHandlers {
  /** It reads, which begins a connection. @param value_bytes  Longest value. @return false:
   * refused.
   */
  std::function<bool(const std::string& phone, size_t value_bytes)> begin;
  /** It has written a value. @return false: it has no connection. */
  std::function<bool(const std::string& phone, std::string_view value)> write;
  /** It has gone; empty: all have. */
  std::function<void(const std::string& phone)> end;
};

/** Offers a GATT service by BlueZ's D-Bus interface, and advertises it. Without BlueZ or an adapter
 * it tries again every few seconds.
 *
 * Source: doc/org.bluez.GattManager.rst, GattCharacteristic.rst and LEAdvertisement.rst of BlueZ.
 */
class BluezService {
 public:
  /** @param name  That phones show, cut to what an advertisement holds. */
  BluezService(const std::string& name, BluetoothHandlers handlers);
  ~BluezService();
  BluezService(const BluezService&) = delete;
  BluezService& operator=(const BluezService&) = delete;

  /** Handles what has come. To be called when descriptor() is readable, and once a second.
   * @param now  s of a clock that never runs backwards. */
  void step(double now);
  /** Of the D-Bus connection; -1: there is none. It changes in step() only. */
  int descriptor() const;
  /** Sends a value to the phones that asked for notifications. */
  void notify(std::string_view value);

  /** Phones can find it. */
  bool is_offered() const;
  /** Why not; empty while it is offered or about to be. */
  std::string problem() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nao
