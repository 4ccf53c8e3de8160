#include "phone-gateway/bluetooth/bluez_service.h"

#include <systemd/sd-bus.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

#include "phone-gateway/bluetooth/fragments.h"

namespace nao {
namespace {

constexpr const char* kBluez = "org.bluez";
constexpr const char* kAdapter = "org.bluez.Adapter1";
constexpr const char* kGattManager = "org.bluez.GattManager1";
constexpr const char* kAdvertisingManager = "org.bluez.LEAdvertisingManager1";
constexpr const char* kCharacteristic = "org.bluez.GattCharacteristic1";
constexpr const char* kDevice = "org.bluez.Device1";
constexpr const char* kRootPath = "/nao_remote";
constexpr const char* kServicePath = "/nao_remote/service";
constexpr const char* kMessagesPath = "/nao_remote/service/messages";
constexpr const char* kAdvertisementPath = "/nao_remote_advertisement";
/** Time until BlueZ or its adapter is looked for again, s. Chosen. */
constexpr double kRetryTime = 5;
/** Bytes of a name in the scan response: 31 less two of its head (Bluetooth Core Specification 5.4,
 * Vol 3, Part C, 11). */
constexpr size_t kMaxNameBytes = 29;
/** Header of a notification or write, bytes (ibid., Part F, 3.4.7.1). */
constexpr size_t kAttributeHeader = 3;

int append_bytes(sd_bus_message* reply, std::string_view bytes) {
  return sd_bus_message_append_array(reply, 'y', bytes.data(), bytes.size());
}

}  // namespace

struct BluezService::Impl {
  using Handler = int (Impl::*)(sd_bus_message*);
  using Getter = int (Impl::*)(sd_bus_message*);
  using Step = sd_bus_message_handler_t;

  Impl(const std::string& new_name, BluetoothHandlers new_handlers)
      : name(new_name.substr(0, kMaxNameBytes)), handlers(std::move(new_handlers)) {}
  ~Impl() {
    // BlueZ withdraws what a client has registered when its connection ends.
    if (bus != nullptr) sd_bus_flush_close_unref(bus);
  }

  /** A handler of messages. */
  template <Handler handler>
  static int call(sd_bus_message* message, void* self, sd_bus_error* /*error*/) {
    return (static_cast<Impl*>(self)->*handler)(message);
  }
  /** A getter of a property. */
  template <Getter getter>
  static int get(sd_bus* /*bus*/, const char* /*path*/, const char* /*interface*/,
                 const char* /*property*/, sd_bus_message* reply, void* self,
                 sd_bus_error* /*error*/) {
    return (static_cast<Impl*>(self)->*getter)(reply);
  }

  // ---- What BlueZ reads of the service ---------------------------------------------------------

  int get_service_uuid(sd_bus_message* reply) {
    return sd_bus_message_append(reply, "s", kBluetoothServiceUuid);
  }
  int get_service_uuids(sd_bus_message* reply) {
    return sd_bus_message_append(reply, "as", 1, kBluetoothServiceUuid);
  }
  int get_messages_uuid(sd_bus_message* reply) {
    return sd_bus_message_append(reply, "s", kBluetoothMessagesUuid);
  }
  int get_true(sd_bus_message* reply) { return sd_bus_message_append(reply, "b", 1); }
  int get_service(sd_bus_message* reply) { return sd_bus_message_append(reply, "o", kServicePath); }
  int get_flags(sd_bus_message* reply) {
    return sd_bus_message_append(reply, "as", 3, "read", "write-without-response", "notify");
  }
  int get_value(sd_bus_message* reply) { return append_bytes(reply, value); }
  int get_type(sd_bus_message* reply) { return sd_bus_message_append(reply, "s", "peripheral"); }
  int get_name(sd_bus_message* reply) { return sd_bus_message_append(reply, "s", name.c_str()); }

  // ---- What phones do --------------------------------------------------------------------------

  /** Options of ReadValue and WriteValue. */
  struct Options {
    std::string phone;
    size_t value_bytes = kMinValueBytes;
  };
  static Options read_options(sd_bus_message* message) {
    Options options;
    if (sd_bus_message_enter_container(message, 'a', "{sv}") < 0) return options;
    while (sd_bus_message_enter_container(message, 'e', "sv") > 0) {
      const char* key = nullptr;
      sd_bus_message_read(message, "s", &key);
      const char* path = nullptr;
      uint16_t mtu = 0;
      if (std::strcmp(key, "device") == 0 && sd_bus_message_read(message, "v", "o", &path) > 0) {
        options.phone = path;
      } else if (std::strcmp(key, "mtu") == 0 && sd_bus_message_read(message, "v", "q", &mtu) > 0) {
        options.value_bytes =
            std::clamp(mtu > kAttributeHeader ? mtu - kAttributeHeader : size_t{0}, kMinValueBytes,
                       kMaxValueBytes);
      } else {
        sd_bus_message_skip(message, "v");
      }
      sd_bus_message_exit_container(message);
    }
    sd_bus_message_exit_container(message);
    return options;
  }

  int handle_read(sd_bus_message* message) {
    const Options options = read_options(message);
    if (!handlers.begin(options.phone, options.value_bytes)) {
      return sd_bus_reply_method_errorf(message, "org.bluez.Error.NotPermitted",
                                        "Another phone is connected by Bluetooth.");
    }
    const std::string size{static_cast<char>(options.value_bytes & 0xff),
                           static_cast<char>(options.value_bytes >> 8)};
    sd_bus_message* reply = nullptr;
    int result = sd_bus_message_new_method_return(message, &reply);
    if (result >= 0) result = append_bytes(reply, size);
    if (result >= 0) result = sd_bus_send(bus, reply, nullptr);
    sd_bus_message_unref(reply);
    return result < 0 ? result : 1;
  }

  int handle_write(sd_bus_message* message) {
    const void* bytes = nullptr;
    size_t size = 0;
    if (const int result = sd_bus_message_read_array(message, 'y', &bytes, &size); result < 0) {
      return result;
    }
    const std::string written(static_cast<const char*>(bytes), size);
    if (!handlers.write(read_options(message).phone, written)) {
      return sd_bus_reply_method_errorf(message, "org.bluez.Error.NotPermitted",
                                        "This phone has no connection.");
    }
    return sd_bus_reply_method_return(message, nullptr);
  }

  int handle_notifications(sd_bus_message* message) {
    return sd_bus_reply_method_return(message, nullptr);
  }

  /** No phone asks for notifications any more. */
  int handle_no_notifications(sd_bus_message* message) {
    handlers.end("");
    return sd_bus_reply_method_return(message, nullptr);
  }

  /** BlueZ has withdrawn the advertisement, such as with its adapter. */
  int handle_release(sd_bus_message* message) {
    is_advertised = false;
    handlers.end("");
    return sd_bus_reply_method_return(message, nullptr);
  }

  /** Device1's Connected. */
  int handle_device(sd_bus_message* message) {
    const char* interface = nullptr;
    if (sd_bus_message_read(message, "s", &interface) < 0) return 0;
    if (std::strcmp(interface, kDevice) != 0) return 0;
    if (sd_bus_message_enter_container(message, 'a', "{sv}") < 0) return 0;
    while (sd_bus_message_enter_container(message, 'e', "sv") > 0) {
      const char* key = nullptr;
      sd_bus_message_read(message, "s", &key);
      int is_connected = 1;
      if (std::strcmp(key, "Connected") != 0) {
        sd_bus_message_skip(message, "v");
      } else if (sd_bus_message_read(message, "v", "b", &is_connected) > 0 && is_connected == 0) {
        handlers.end(sd_bus_message_get_path(message));
      }
      sd_bus_message_exit_container(message);
    }
    return 0;
  }

  // ---- Offering the service --------------------------------------------------------------------

  void connect() {
    if (const int result = sd_bus_open_system(&bus); result < 0) {
      bus = nullptr;
      problem = std::string("no D-Bus: ") + std::strerror(-result);
      return;
    }
    sd_bus_add_object_manager(bus, nullptr, kRootPath);
    sd_bus_add_object_vtable(bus, nullptr, kServicePath, "org.bluez.GattService1", kServiceTable,
                             this);
    sd_bus_add_object_vtable(bus, nullptr, kMessagesPath, kCharacteristic, kMessagesTable, this);
    sd_bus_add_object_vtable(bus, nullptr, kAdvertisementPath, "org.bluez.LEAdvertisement1",
                             kAdvertisementTable, this);
    sd_bus_add_match_async(bus, nullptr,
                           "type='signal',sender='org.freedesktop.DBus',"
                           "member='NameOwnerChanged',arg0='org.bluez'",
                           call<&Impl::handle_owner>, nullptr, this);
    sd_bus_match_signal_async(bus, nullptr, kBluez, nullptr, "org.freedesktop.DBus.Properties",
                              "PropertiesChanged", call<&Impl::handle_device>, nullptr, this);
    find_adapter();
  }

  void disconnect(const std::string& why) {
    if (bus == nullptr) return;
    sd_bus_flush_close_unref(bus);
    bus = nullptr;
    fail(why);
  }

  void fail(const std::string& why) {
    problem = why;
    is_advertised = false;
    is_trying = false;
    handlers.end("");
  }

  void send(const std::string& path, const char* interface, const char* member, Step next,
            const char* object = nullptr) {
    sd_bus_message* message = nullptr;
    sd_bus_message_new_method_call(bus, &message, kBluez, path.c_str(), interface, member);
    // A host whose owner does not run bluetoothd shall not run it because of this program.
    sd_bus_message_set_auto_start(message, 0);
    if (object != nullptr) sd_bus_message_append(message, "oa{sv}", object, 0);
    sd_bus_call_async(bus, nullptr, message, next, this, 0);
    sd_bus_message_unref(message);
  }

  /** Notes an error reply. @return Whether it is one. */
  bool is_error(sd_bus_message* reply) {
    const sd_bus_error* error = sd_bus_message_get_error(reply);
    if (error == nullptr) return false;
    const std::string error_name = error->name != nullptr ? error->name : "";
    if (error_name == SD_BUS_ERROR_SERVICE_UNKNOWN ||
        error_name == SD_BUS_ERROR_NAME_HAS_NO_OWNER) {
      fail("bluetoothd does not run (apt install bluez)");
    } else {
      fail("bluetoothd: " + (error->message != nullptr ? std::string(error->message) : error_name));
    }
    return true;
  }

  void find_adapter() {
    is_trying = true;
    send("/", "org.freedesktop.DBus.ObjectManager", "GetManagedObjects",
         call<&Impl::handle_objects>);
  }

  int handle_objects(sd_bus_message* reply) {
    if (is_error(reply)) return 0;
    adapter = read_adapter(reply);
    if (adapter.empty()) {
      fail("this host has no Bluetooth adapter");
      return 0;
    }
    sd_bus_message* message = nullptr;
    sd_bus_message_new_method_call(bus, &message, kBluez, adapter.c_str(),
                                   "org.freedesktop.DBus.Properties", "Set");
    sd_bus_message_append(message, "ssv", kAdapter, "Powered", "b", 1);
    sd_bus_call_async(bus, nullptr, message, call<&Impl::handle_powered>, this, 0);
    sd_bus_message_unref(message);
    return 0;
  }

  /** The first object with both interfaces; empty: none. */
  static std::string read_adapter(sd_bus_message* reply) {
    std::string found;
    if (sd_bus_message_enter_container(reply, 'a', "{oa{sa{sv}}}") < 0) return found;
    while (sd_bus_message_enter_container(reply, 'e', "oa{sa{sv}}") > 0) {
      const char* path = nullptr;
      sd_bus_message_read(reply, "o", &path);
      bool has_services = false;
      bool has_advertisements = false;
      sd_bus_message_enter_container(reply, 'a', "{sa{sv}}");
      while (sd_bus_message_enter_container(reply, 'e', "sa{sv}") > 0) {
        const char* interface = nullptr;
        sd_bus_message_read(reply, "s", &interface);
        has_services |= std::strcmp(interface, kGattManager) == 0;
        has_advertisements |= std::strcmp(interface, kAdvertisingManager) == 0;
        sd_bus_message_skip(reply, "a{sv}");
        sd_bus_message_exit_container(reply);
      }
      sd_bus_message_exit_container(reply);
      sd_bus_message_exit_container(reply);
      if (found.empty() && has_services && has_advertisements) found = path;
    }
    return found;
  }

  int handle_powered(sd_bus_message* reply) {
    if (is_error(reply)) return 0;
    send(adapter, kGattManager, "RegisterApplication", call<&Impl::handle_application>, kRootPath);
    return 0;
  }

  int handle_application(sd_bus_message* reply) {
    // It stays registered when an advertisement was released.
    const bool is_there =
        sd_bus_message_is_method_error(reply, "org.bluez.Error.AlreadyExists") > 0;
    if (!is_there && is_error(reply)) return 0;
    send(adapter, kAdvertisingManager, "RegisterAdvertisement", call<&Impl::handle_advertisement>,
         kAdvertisementPath);
    return 0;
  }

  int handle_advertisement(sd_bus_message* reply) {
    if (is_error(reply)) return 0;
    is_trying = false;
    is_advertised = true;
    problem.clear();
    return 0;
  }

  /** bluetoothd has begun or ended. */
  int handle_owner(sd_bus_message* message) {
    const char* bus_name = nullptr;
    const char* before = nullptr;
    const char* after = nullptr;
    if (sd_bus_message_read(message, "sss", &bus_name, &before, &after) < 0) return 0;
    if (*after != '\0') {
      find_adapter();
    } else {
      fail("bluetoothd does not run (apt install bluez)");
    }
    return 0;
  }

  static const sd_bus_vtable kServiceTable[];
  static const sd_bus_vtable kMessagesTable[];
  static const sd_bus_vtable kAdvertisementTable[];

  std::string name;
  BluetoothHandlers handlers;
  sd_bus* bus = nullptr;
  /** D-Bus object of BlueZ. */
  std::string adapter;
  /** Of the notification that is being sent. */
  std::string value;
  std::string problem;
  double next_try = 0;
  bool is_trying = false;
  bool is_advertised = false;
};

const sd_bus_vtable BluezService::Impl::kServiceTable[] = {
    SD_BUS_VTABLE_START(0),
    SD_BUS_PROPERTY("UUID", "s", get<&Impl::get_service_uuid>, 0, SD_BUS_VTABLE_PROPERTY_CONST),
    SD_BUS_PROPERTY("Primary", "b", get<&Impl::get_true>, 0, SD_BUS_VTABLE_PROPERTY_CONST),
    SD_BUS_VTABLE_END};

const sd_bus_vtable BluezService::Impl::kMessagesTable[] = {
    SD_BUS_VTABLE_START(0),
    SD_BUS_PROPERTY("UUID", "s", get<&Impl::get_messages_uuid>, 0, SD_BUS_VTABLE_PROPERTY_CONST),
    SD_BUS_PROPERTY("Service", "o", get<&Impl::get_service>, 0, SD_BUS_VTABLE_PROPERTY_CONST),
    SD_BUS_PROPERTY("Flags", "as", get<&Impl::get_flags>, 0, SD_BUS_VTABLE_PROPERTY_CONST),
    SD_BUS_PROPERTY("Value", "ay", get<&Impl::get_value>, 0, SD_BUS_VTABLE_PROPERTY_EMITS_CHANGE),
    SD_BUS_METHOD("ReadValue", "a{sv}", "ay", call<&Impl::handle_read>, SD_BUS_VTABLE_UNPRIVILEGED),
    SD_BUS_METHOD("WriteValue", "aya{sv}", "", call<&Impl::handle_write>,
                  SD_BUS_VTABLE_UNPRIVILEGED),
    SD_BUS_METHOD("StartNotify", "", "", call<&Impl::handle_notifications>,
                  SD_BUS_VTABLE_UNPRIVILEGED),
    SD_BUS_METHOD("StopNotify", "", "", call<&Impl::handle_no_notifications>,
                  SD_BUS_VTABLE_UNPRIVILEGED),
    SD_BUS_VTABLE_END};

const sd_bus_vtable BluezService::Impl::kAdvertisementTable[] = {
    SD_BUS_VTABLE_START(0),
    SD_BUS_PROPERTY("Type", "s", get<&Impl::get_type>, 0, SD_BUS_VTABLE_PROPERTY_CONST),
    SD_BUS_PROPERTY("ServiceUUIDs", "as", get<&Impl::get_service_uuids>, 0,
                    SD_BUS_VTABLE_PROPERTY_CONST),
    SD_BUS_PROPERTY("LocalName", "s", get<&Impl::get_name>, 0, SD_BUS_VTABLE_PROPERTY_CONST),
    SD_BUS_METHOD("Release", "", "", call<&Impl::handle_release>, SD_BUS_VTABLE_UNPRIVILEGED),
    SD_BUS_VTABLE_END};

BluezService::BluezService(const std::string& name, BluetoothHandlers handlers)
    : impl_(std::make_unique<Impl>(name, std::move(handlers))) {}

BluezService::~BluezService() = default;

void BluezService::step(double now) {
  const bool is_due = now >= impl_->next_try;
  if (is_due) impl_->next_try = now + kRetryTime;
  if (impl_->bus == nullptr) {
    if (is_due) impl_->connect();
    if (impl_->bus == nullptr) return;
  } else if (is_due && !impl_->is_advertised && !impl_->is_trying) {
    impl_->find_adapter();
  }
  int result = 0;
  do {
    result = sd_bus_process(impl_->bus, nullptr);
  } while (result > 0);
  if (result < 0) impl_->disconnect(std::string("no D-Bus: ") + std::strerror(-result));
}

int BluezService::descriptor() const {
  return impl_->bus == nullptr ? -1 : sd_bus_get_fd(impl_->bus);
}

void BluezService::notify(std::string_view value) {
  if (impl_->bus == nullptr) return;
  impl_->value = value;
  sd_bus_emit_properties_changed(impl_->bus, kMessagesPath, kCharacteristic, "Value", nullptr);
}

bool BluezService::is_offered() const {
  return impl_->is_advertised;
}

std::string BluezService::problem() const {
  return impl_->problem;
}

}  // namespace nao
