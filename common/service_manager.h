#pragma once

#include <string>

namespace nao {

/** Tells systemd, if it started this process, that the process lives: once a second or so.
 *
 * A unit with Type=notify counts as started from the first call with a state that waits for nothing
 * of its own ("ready", or "waiting" for another program), and WatchdogSec= kills a process that has
 * stopped calling. Does nothing without systemd. Protocol: sd_notify(3).
 * @param state   As in daemon_status_t.
 * @param detail  The same in words, for `systemctl status`. */
void notify_service_manager(const std::string& state, const std::string& detail);

}  // namespace nao
