#include "lola/codec.h"

#include <fmt/format.h>

#include "lola/msgpack.h"

namespace nao {
namespace {

using Kind = MsgpackReader::Kind;
using Token = MsgpackReader::Token;

/** Values of `Status` are 0 to 3. */
constexpr double kMaxStatus = 3;

void write(MsgpackWriter& writer, float value) {
  writer.number(value);
}
void write(MsgpackWriter& writer, int value) {
  writer.small_integer(value);
}
void write(MsgpackWriter& writer, bool value) {
  writer.boolean(value);
}
void write(MsgpackWriter& writer, const std::string& value) {
  writer.text(value);
}

template <class Value, size_t N>
void write_field(MsgpackWriter& writer, const char* key, const std::array<Value, N>& values) {
  writer.text(key);
  writer.array(N);
  for (const Value& value : values) write(writer, value);
}

/** @return Whether the token has the type of the value. */
bool read(const Token& token, float& value) {
  value = static_cast<float>(token.number);
  return token.kind == Kind::kNumber;
}
bool read(const Token& token, int& value) {
  // Written so that NaN fails, too.
  if (token.kind != Kind::kNumber || !(token.number >= 0 && token.number <= kMaxStatus))
    return false;
  value = static_cast<int>(token.number);
  return true;
}
bool read(const Token& token, bool& value) {
  value = token.number != 0;
  return token.kind == Kind::kBool || token.kind == Kind::kNumber;
}
bool read(const Token& token, std::string& value) {
  value = token.text;
  return token.kind == Kind::kText;
}

/** Reads the map's keys and values into a message. */
class FieldReader {
 public:
  explicit FieldReader(std::span<const uint8_t> bytes) : reader_(bytes) {}

  // Reads one map whose keys are the message's field names; foreign keys are skipped, so that a
  // newer LoLA with more of them can still be read.
  template <class Message>
  LolaDecoding read_map(Message& message) {
    const Token map = reader_.next();
    if (map.kind != Kind::kMap) return fault(map.kind, "it is not a map");
    for (uint32_t i = 0; i < map.size; ++i) {
      const Token key = reader_.next();
      if (key.kind != Kind::kText) return fault(key.kind, "a key is not text");
      bool is_known = false;
      size_t field = 0;
      // Linear search over the fields: there are a dozen. `field` is the bit of the field in
      // found_.
      for_each_field(message, [&](const char* name, auto& values) {
        if (key.text == name) {
          is_known = true;
          read_field(name, uint64_t{1} << field, values);
        }
        ++field;
      });
      if (!is_known) {
        const Kind kind = reader_.skip();
        if (kind == Kind::kIncomplete || kind == Kind::kMalformed)
          return fault(kind, "a value is unreadable");
      }
      if (result_.status != LolaDecoding::Status::kDone) return result_;
    }
    result_.size = reader_.position();
    return result_;
  }

  bool has(size_t field) const { return (found_ >> field & 1) != 0; }

 private:
  LolaDecoding fault(Kind kind, const std::string& error) {
    if (kind == Kind::kIncomplete) {
      result_ = {LolaDecoding::Status::kIncomplete, 0, {}};
    } else {
      result_ = {LolaDecoding::Status::kMalformed, 0, error};
    }
    return result_;
  }

  template <class Value, size_t N>
  void read_field(const char* name, uint64_t bit, std::array<Value, N>& values) {
    if ((found_ & bit) != 0) {
      fault(Kind::kMalformed, fmt::format("key {} is there twice", name));
      return;
    }
    found_ |= bit;
    const Token array = reader_.next();
    if (array.kind != Kind::kArray) {
      fault(array.kind, fmt::format("{} is not a list", name));
      return;
    }
    if (array.size != N) {
      fault(Kind::kMalformed,
            fmt::format("{} has {} values and must have {}", name, array.size, N));
      return;
    }
    for (Value& value : values) {
      const Token token = reader_.next();
      if (!read(token, value)) {
        fault(token.kind, fmt::format("a value of {} has a wrong type or is out of range", name));
        return;
      }
    }
  }

  template <class Values>
  // A field of a command is optional: it exists once its key was present.
  void read_field(const char* name, uint64_t bit, std::optional<Values>& values) {
    read_field(name, bit, values.emplace());
  }

  MsgpackReader reader_;
  /** A bit for every field that was found. */
  uint64_t found_ = 0;
  LolaDecoding result_{LolaDecoding::Status::kDone, 0, {}};
};

}  // namespace

// All fields of a state, in LoLA's order, into the caller's memory; returns the number of bytes.
size_t encode(const LolaState& state, std::span<uint8_t> memory) {
  MsgpackWriter writer(memory);
  size_t num_fields = 0;
  for_each_field(state, [&](const char* /*key*/, const auto& /*values*/) { ++num_fields; });
  writer.map(num_fields);
  for_each_field(state,
                 [&](const char* key, const auto& values) { write_field(writer, key, values); });
  return writer.size();
}

// Only fields that are set are written; the map's head needs their number before.
size_t encode(const LolaCommand& command, std::span<uint8_t> memory) {
  MsgpackWriter writer(memory);
  size_t num_fields = 0;
  for_each_field(command,
                 [&](const char* /*key*/, const auto& values) { num_fields += values ? 1 : 0; });
  writer.map(num_fields);
  for_each_field(command, [&](const char* key, const auto& values) {
    if (values) write_field(writer, key, *values);
  });
  return writer.size();
}

LolaDecoding decode(std::span<const uint8_t> bytes, LolaState& state) {
  FieldReader reader(bytes);
  LolaDecoding result = reader.read_map(state);
  if (result.status != LolaDecoding::Status::kDone) return result;
  size_t field = 0;
  // A state without one of its keys would leave old values in place.
  for_each_field(state, [&](const char* name, const auto& /*values*/) {
    if (reader.has(field++) || result.status != LolaDecoding::Status::kDone) return;
    result = {LolaDecoding::Status::kMalformed, 0, fmt::format("key {} is missing", name)};
  });
  return result;
}

// Every key of a command may be absent: the robot then keeps the last value.
LolaDecoding decode(std::span<const uint8_t> bytes, LolaCommand& command) {
  command = {};
  return FieldReader(bytes).read_map(command);
}

}  // namespace nao
