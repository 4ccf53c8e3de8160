#pragma once

#include <string>
#include <vector>

#include "phone-gateway/discovery/service_discovery.h"

namespace nao {

/** The list of gateways that the page /gateways has: an object with `announced_as` and `alias` of
 * this gateway, and `gateways`, objects with name, robot, model, host, address, http_port,
 * tcp_port, https and url. */
std::string gateways_to_json(const ServiceDiscovery& discovery);

/** A table for a terminal, one gateway a line. */
std::string gateways_to_text(const std::vector<GatewayService>& gateways);

/** Address of the app: "http://192.168.1.20:8080". */
std::string app_url(const GatewayService& gateway);

}  // namespace nao
