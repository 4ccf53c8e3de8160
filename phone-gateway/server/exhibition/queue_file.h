#pragma once

#include <string>
#include <string_view>

#include "phone-gateway/server/exhibition/visitor_queue.h"

namespace nao::gateway {

/** The state of the queue as JSON, for the file with which it survives a restart. */
std::string write_queue_state(const QueueState& state);

/** @throws Error  It is not what write_queue_state() writes. */
QueueState read_queue_state(std::string_view text);

/** What happened at the exhibition, as a page of text for people. */
std::string write_exhibition_report(const QueueState& state);

}  // namespace nao::gateway
