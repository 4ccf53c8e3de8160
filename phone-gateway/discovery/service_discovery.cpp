#include "phone-gateway/discovery/service_discovery.h"

#include <systemd/sd-bus.h>

#include <cstdlib>
#include <cstring>
#include <map>
#include <set>
#include <utility>

namespace nao {
namespace {

constexpr const char* kServiceType = "_nao-remote._tcp";
constexpr const char* kAvahi = "org.freedesktop.Avahi";
constexpr const char* kServer = "org.freedesktop.Avahi.Server";
constexpr const char* kGroup = "org.freedesktop.Avahi.EntryGroup";
constexpr const char* kBrowser = "org.freedesktop.Avahi.ServiceBrowser";
/** Values of Avahi's protocol, avahi-common/address.h and defs.h. */
constexpr int kAnyInterface = -1;
constexpr int kIpv4 = 0;
constexpr uint32_t kNoReverse = 16;
constexpr int kEstablished = 2;
constexpr int kCollision = 3;
constexpr int kFailure = 4;
/** Time until the bus is looked for again, s. Chosen. */
constexpr double kRetryTime = 5;
/** Names that are tried for the alias, and for the service. */
constexpr int kMaxNames = 9;

/** Name number n: "nao", "nao-2". */
std::string numbered(const std::string& name, int number, const std::string& separator) {
  return number == 1 ? name : name + separator + std::to_string(number);
}

uint16_t to_port(const std::string& text) {
  const int value = std::atoi(text.c_str());
  return value > 0 && value <= UINT16_MAX ? static_cast<uint16_t>(value) : uint16_t{0};
}

}  // namespace

std::vector<std::string> ServiceDiscovery::alias_names(const std::string& alias) {
  std::vector<std::string> names;
  for (int i = 1; i <= kMaxNames; ++i) names.push_back(numbered(alias, i, "-") + ".local");
  return names;
}

/** Every handler gets the D-Bus message and returns 0; errors of the D-Bus library mean that the
 * bus is unavailable, which step() notices. */
struct ServiceDiscovery::Impl {
  using Handler = int (Impl::*)(sd_bus_message*);

  explicit Impl(std::optional<Announcement> what) : announcement(std::move(what)) {}
  ~Impl() { disconnect(); }

  template <Handler handler>
  static int call(sd_bus_message* message, void* self, sd_bus_error* /*error*/) {
    return (static_cast<Impl*>(self)->*handler)(message);
  }

  void connect() {
    if (const int result = sd_bus_open_system(&bus); result < 0) {
      bus = nullptr;
      problem = std::string("no D-Bus: ") + std::strerror(-result);
      return;
    }
    sd_bus_add_match_async(bus, nullptr,
                           "type='signal',sender='org.freedesktop.DBus',"
                           "member='NameOwnerChanged',arg0='org.freedesktop.Avahi'",
                           call<&Impl::handle_owner>, nullptr, this);
    // Before the browser exists: avahi-daemon may send what it knows at once.
    sd_bus_match_signal_async(bus, nullptr, kAvahi, nullptr, kBrowser, "ItemNew",
                              call<&Impl::handle_new_item>, nullptr, this);
    sd_bus_match_signal_async(bus, nullptr, kAvahi, nullptr, kBrowser, "ItemRemove",
                              call<&Impl::handle_removed_item>, nullptr, this);
    sd_bus_match_signal_async(bus, nullptr, kAvahi, nullptr, kGroup, "StateChanged",
                              call<&Impl::handle_group_state>, nullptr, this);
    begin();
  }

  void disconnect() {
    if (bus == nullptr) return;
    // avahi-daemon withdraws what a client has announced when its connection ends.
    sd_bus_flush_close_unref(bus);
    bus = nullptr;
    end("no D-Bus");
  }

  void begin() {
    end("");
    sd_bus_message* message = make_call("/", kServer, "ServiceBrowserNew");
    sd_bus_message_append(message, "iissu", kAnyInterface, kIpv4, kServiceType, "", 0U);
    send(message, call<&Impl::handle_done>);
    if (!announcement) return;
    send(make_call("/", kServer, "EntryGroupNew"), call<&Impl::handle_service_group>);
    if (announcement->alias.empty() || announcement->addresses.empty()) return;
    send(make_call("/", kServer, "EntryGroupNew"), call<&Impl::handle_alias_group>);
  }

  void end(const std::string& why) {
    problem = why;
    announced.clear();
    accepted_alias.clear();
    service_group.clear();
    alias_group.clear();
    service_number = alias_number = 1;
    num_addresses = 0;
    seen.clear();
    services.clear();
  }

  sd_bus_message* make_call(const std::string& path, const char* interface, const char* member) {
    sd_bus_message* message = nullptr;
    sd_bus_message_new_method_call(bus, &message, kAvahi, path.c_str(), interface, member);
    // A host whose owner does not run avahi-daemon shall not run it because of this program.
    sd_bus_message_set_auto_start(message, 0);
    return message;
  }

  void send(sd_bus_message* message, sd_bus_message_handler_t handler) {
    sd_bus_call_async(bus, nullptr, message, handler, this, 0);
    sd_bus_message_unref(message);
  }

  /** Notes an error reply. @return Whether it is one. */
  bool is_error(sd_bus_message* reply) {
    const sd_bus_error* error = sd_bus_message_get_error(reply);
    if (error == nullptr) return false;
    const std::string name = error->name != nullptr ? error->name : "";
    if (name == SD_BUS_ERROR_SERVICE_UNKNOWN || name == SD_BUS_ERROR_NAME_HAS_NO_OWNER) {
      problem = "avahi-daemon does not run";
    } else {
      problem = std::string("avahi-daemon: ") +
                (error->message != nullptr ? error->message : name.c_str());
    }
    return true;
  }

  static bool is_collision(sd_bus_message* reply) {
    return sd_bus_message_is_method_error(reply, "org.freedesktop.Avahi.CollisionError") > 0;
  }

  int handle_owner(sd_bus_message* message) {
    const char* name = nullptr;
    const char* before = nullptr;
    const char* after = nullptr;
    if (sd_bus_message_read(message, "sss", &name, &before, &after) < 0) return 0;
    if (*after != '\0') {
      begin();
    } else {
      end("avahi-daemon does not run");
    }
    return 0;
  }

  int handle_done(sd_bus_message* reply) {
    is_error(reply);
    return 0;
  }

  int handle_new_item(sd_bus_message* message) {
    int interface = 0;
    int protocol = 0;
    const char* name = nullptr;
    const char* type = nullptr;
    const char* domain = nullptr;
    uint32_t flags = 0;
    if (sd_bus_message_read(message, "iisssu", &interface, &protocol, &name, &type, &domain,
                            &flags) < 0) {
      return 0;
    }
    if (std::string(type) != kServiceType) return 0;
    seen[name].insert(interface);
    sd_bus_message* resolve = make_call("/", kServer, "ResolveService");
    sd_bus_message_append(resolve, "iisssiu", interface, protocol, name, type, domain, kIpv4, 0U);
    send(resolve, call<&Impl::handle_resolved>);
    return 0;
  }

  int handle_removed_item(sd_bus_message* message) {
    int interface = 0;
    int protocol = 0;
    const char* name = nullptr;
    if (sd_bus_message_read(message, "iis", &interface, &protocol, &name) < 0) return 0;
    const auto known = seen.find(name);
    if (known == seen.end()) return 0;
    known->second.erase(interface);
    // A host may be seen through several interfaces.
    if (!known->second.empty()) return 0;
    services.erase(name);
    seen.erase(known);
    return 0;
  }

  int handle_resolved(sd_bus_message* reply) {
    // One that has gone meanwhile cannot be resolved.
    if (sd_bus_message_is_method_error(reply, nullptr) > 0) return 0;
    int interface = 0;
    int protocol = 0;
    const char* name = nullptr;
    const char* type = nullptr;
    const char* domain = nullptr;
    const char* host = nullptr;
    int address_protocol = 0;
    const char* address = nullptr;
    uint16_t port = 0;
    if (sd_bus_message_read(reply, "iissssisq", &interface, &protocol, &name, &type, &domain, &host,
                            &address_protocol, &address, &port) < 0) {
      return 0;
    }
    GatewayService service;
    service.name = name;
    service.host = host;
    service.address = address;
    service.http_port = port;
    read_texts(reply, service);
    if (seen.count(name) != 0 && name != announced) services[name] = service;
    return 0;
  }

  /** The TXT record: a list of "key=value" as bytes. */
  static void read_texts(sd_bus_message* reply, GatewayService& service) {
    if (sd_bus_message_enter_container(reply, 'a', "ay") < 0) return;
    while (true) {
      const void* bytes = nullptr;
      size_t size = 0;
      if (sd_bus_message_read_array(reply, 'y', &bytes, &size) <= 0) break;
      const std::string text(static_cast<const char*>(bytes), size);
      const size_t sign = text.find('=');
      if (sign == std::string::npos) continue;
      const std::string key = text.substr(0, sign);
      const std::string value = text.substr(sign + 1);
      if (key == "robot") service.robot = value;
      if (key == "model") service.model = value;
      if (key == "tcp") service.tcp_port = to_port(value);
      if (key == "https") service.uses_tls = value == "1";
    }
    sd_bus_message_exit_container(reply);
  }

  int handle_service_group(sd_bus_message* reply) {
    const char* path = nullptr;
    if (is_error(reply) || sd_bus_message_read(reply, "o", &path) < 0) return 0;
    service_group = path;
    add_service();
    return 0;
  }

  int handle_alias_group(sd_bus_message* reply) {
    const char* path = nullptr;
    if (is_error(reply) || sd_bus_message_read(reply, "o", &path) < 0) return 0;
    alias_group = path;
    add_alias();
    return 0;
  }

  std::string service_name() const {
    return numbered(announcement->service.name, service_number, " ");
  }

  void add_service() {
    const GatewayService& service = announcement->service;
    sd_bus_message* message = make_call(service_group, kGroup, "AddService");
    sd_bus_message_append(message, "iiussssq", kAnyInterface, kIpv4, 0U, service_name().c_str(),
                          kServiceType, "", "", service.http_port);
    sd_bus_message_open_container(message, 'a', "ay");
    for (const std::string& text : {"robot=" + service.robot, "model=" + service.model,
                                    "tcp=" + std::to_string(service.tcp_port),
                                    std::string("https=") + (service.uses_tls ? "1" : "0")}) {
      sd_bus_message_append_array(message, 'y', text.data(), text.size());
    }
    sd_bus_message_close_container(message);
    send(message, call<&Impl::handle_service_added>);
  }

  int handle_service_added(sd_bus_message* reply) {
    if (is_collision(reply)) {
      rename_service();
    } else if (!is_error(reply)) {
      send(make_call(service_group, kGroup, "Commit"), call<&Impl::handle_done>);
    }
    return 0;
  }

  /** Address by address, so that the answer to the last one ends it. */
  void add_alias() {
    const std::string name = numbered(announcement->alias, alias_number, "-") + ".local";
    sd_bus_message* message = make_call(alias_group, kGroup, "AddAddress");
    sd_bus_message_append(message, "iiuss", kAnyInterface, kIpv4, kNoReverse, name.c_str(),
                          announcement->addresses[num_addresses].c_str());
    send(message, call<&Impl::handle_alias_added>);
  }

  int handle_alias_added(sd_bus_message* reply) {
    if (is_collision(reply)) {
      rename_alias();
    } else if (!is_error(reply)) {
      if (++num_addresses < announcement->addresses.size()) {
        add_alias();
      } else {
        send(make_call(alias_group, kGroup, "Commit"), call<&Impl::handle_done>);
      }
    }
    return 0;
  }

  void rename_service() {
    announced.clear();
    send(make_call(service_group, kGroup, "Reset"), call<&Impl::handle_done>);
    if (++service_number > kMaxNames) return;
    add_service();
  }

  void rename_alias() {
    accepted_alias.clear();
    send(make_call(alias_group, kGroup, "Reset"), call<&Impl::handle_done>);
    if (++alias_number > kMaxNames) return;
    num_addresses = 0;
    add_alias();
  }

  int handle_group_state(sd_bus_message* message) {
    int state = 0;
    const char* error = nullptr;
    if (sd_bus_message_read(message, "is", &state, &error) < 0) return 0;
    const std::string path = sd_bus_message_get_path(message);
    if (path == service_group) {
      if (state == kEstablished) {
        announced = service_name();
        services.erase(announced);
      } else if (state == kCollision) {
        rename_service();
      }
    } else if (path == alias_group) {
      if (state == kEstablished) {
        accepted_alias = numbered(announcement->alias, alias_number, "-") + ".local";
      } else if (state == kCollision) {
        rename_alias();
      }
    } else {
      return 0;
    }
    if (state == kFailure) problem = std::string("avahi-daemon: ") + error;
    return 0;
  }

  std::optional<Announcement> announcement;
  sd_bus* bus = nullptr;
  double next_connection = 0;
  std::string announced;
  std::string accepted_alias;
  /** D-Bus objects of avahi-daemon; empty: none. */
  std::string service_group;
  std::string alias_group;
  /** Names that are tried now. */
  int service_number = 1;
  int alias_number = 1;
  /** Addresses of the alias that have been added. */
  size_t num_addresses = 0;
  /** Interfaces on which a service is seen, by its name. */
  std::map<std::string, std::set<int>> seen;
  std::map<std::string, GatewayService> services;
  std::string problem;
};

ServiceDiscovery::ServiceDiscovery(std::optional<Announcement> announcement)
    : impl_(std::make_unique<Impl>(std::move(announcement))) {}

ServiceDiscovery::~ServiceDiscovery() = default;

void ServiceDiscovery::step(double now) {
  if (impl_->bus == nullptr) {
    if (now < impl_->next_connection) return;
    impl_->next_connection = now + kRetryTime;
    impl_->connect();
    if (impl_->bus == nullptr) return;
  }
  int result = 0;
  do {
    result = sd_bus_process(impl_->bus, nullptr);
  } while (result > 0);
  if (result < 0) {
    impl_->disconnect();
    impl_->next_connection = now + kRetryTime;
  }
}

std::vector<GatewayService> ServiceDiscovery::found() const {
  std::vector<GatewayService> found;
  for (const auto& [name, service] : impl_->services) found.push_back(service);
  return found;
}

std::string ServiceDiscovery::announced_name() const {
  return impl_->announced;
}

std::string ServiceDiscovery::alias() const {
  return impl_->accepted_alias;
}

std::string ServiceDiscovery::problem() const {
  return impl_->problem;
}

}  // namespace nao
