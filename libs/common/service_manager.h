#pragma once

#include <string>

namespace nao {

/** Reports to systemd, if it started this process, that the process is alive. Call it about once a
 * second.
 *
 * A unit with Type=notify counts as started at the first call with state "ready" or "waiting" (for
 * another program). WatchdogSec= kills a process that has stopped calling. Without systemd the call
 * has no effect. Protocol: sd_notify(3).
 * @param state   As in daemon_status_t.
 * @param detail  Explanation for `systemctl status`; may be empty. */
void notify_service_manager(const std::string& state, const std::string& detail);

}  // namespace nao
