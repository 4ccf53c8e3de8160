#include "tools/tuning/task_codec.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "common/error.h"

namespace nao {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Task, point, seed, trial)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(IndexedTask, index, task)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Outcome, index, figures, duration, error)

template <class Message>
Bytes encode(const Message& message) {
  return nlohmann::json::to_cbor(nlohmann::json(message));
}

template <class Message>
Message decode(const Bytes& bytes) {
  try {
    return nlohmann::json::from_cbor(bytes).get<Message>();
  } catch (const nlohmann::json::exception& error) {
    throw Error(fmt::format("a message of {} bytes is damaged: {}", bytes.size(), error.what()));
  }
}

template Bytes encode(const IndexedTask&);
template Bytes encode(const Outcome&);
template IndexedTask decode(const Bytes&);
template Outcome decode(const Bytes&);

}  // namespace nao
