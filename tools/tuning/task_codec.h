#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/tuning/task.h"

namespace nao {

/** A message between the processes of a search: CBOR (RFC 8949), in which a number arrives
 * unchanged. */
using Bytes = std::vector<uint8_t>;

/** A task and its index in the batch. */
struct IndexedTask {
  size_t index = 0;
  Task task;

  bool operator==(const IndexedTask&) const = default;
};

/** @tparam Message  IndexedTask or Outcome. */
template <class Message>
Bytes encode(const Message& message);

/** @throws Error  if the bytes are not a message of this kind. */
template <class Message>
Message decode(const Bytes& bytes);

}  // namespace nao
