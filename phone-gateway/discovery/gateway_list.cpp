#include "phone-gateway/discovery/gateway_list.h"

#include <algorithm>

#include "common/json_writer.h"

namespace nao {

std::string app_url(const GatewayService& gateway) {
  return "http://" + gateway.address + ":" + std::to_string(gateway.http_port);
}

std::string gateways_to_json(const ServiceDiscovery& discovery) {
  JsonWriter json;
  json.begin_object();
  json.add("announced_as", discovery.announced_name());
  json.add("alias", discovery.alias());
  json.begin_array("gateways");
  for (const GatewayService& gateway : discovery.found()) {
    json.begin_object();
    json.add("name", gateway.name);
    json.add("robot", gateway.robot);
    json.add("model", gateway.model);
    json.add("host", gateway.host);
    json.add("address", gateway.address);
    json.add("http_port", static_cast<int>(gateway.http_port));
    json.add("tcp_port", static_cast<int>(gateway.tcp_port));
    json.add("https", gateway.uses_tls);
    json.add("url", app_url(gateway));
    json.end();
  }
  return json.take();
}

std::string gateways_to_text(const std::vector<GatewayService>& gateways) {
  size_t width = 0;
  for (const GatewayService& gateway : gateways) width = std::max(width, gateway.name.size());
  std::string text;
  for (const GatewayService& gateway : gateways) {
    // What others announce may hold any bytes: nothing that moves a terminal's cursor.
    std::string name = gateway.name;
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == 127; }, '?');
    text += name + std::string(width - name.size() + 2, ' ') + app_url(gateway) + "  tcp " +
            gateway.address + ":" + std::to_string(gateway.tcp_port) + "\n";
  }
  return text;
}

}  // namespace nao
