#include "common/service_manager.h"

#include <systemd/sd-daemon.h>

namespace nao {

void notify_service_manager(const std::string& state, const std::string& detail) {
  // WATCHDOG=1 with every status: systemd restarts a program whose messages stop.
  std::string message = "WATCHDOG=1\nSTATUS=" + state + (detail.empty() ? "" : ": " + detail);
  if (state == "ready" || state == "waiting") message += "\nREADY=1";
  if (state == "stopping") message += "\nSTOPPING=1";
  // An error means that no service manager runs: nothing to report.
  (void)sd_notify(0, message.c_str());
}

}  // namespace nao
