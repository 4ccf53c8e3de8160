#include "common/service_manager.h"

#include <systemd/sd-daemon.h>

namespace nao {

void notify_service_manager(const std::string& state, const std::string& detail) {
  std::string said = "WATCHDOG=1\nSTATUS=" + state + (detail.empty() ? "" : ": " + detail);
  if (state == "ready" || state == "waiting") said += "\nREADY=1";
  if (state == "stopping") said += "\nSTOPPING=1";
  // What fails here, fails for want of a service manager.
  (void)sd_notify(0, said.c_str());
}

}  // namespace nao
