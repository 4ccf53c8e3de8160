#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "message_reflection/message_walk.h"

namespace nao {

/** Base of visitors that identify each value by its path from the outermost struct, such as
 * joint_position[HeadYaw] or contacts[0].force_on_a_in_world[2]. */
class PathVisitor : public MessageVisitor {
 public:
  void begin_struct(const std::string& key) override { levels_.push_back({path(key), false}); }
  void end_struct() override { levels_.pop_back(); }
  void begin_list(const std::string& key) override { levels_.push_back({path(key), true}); }
  void end_list() override { levels_.pop_back(); }

 protected:
  /** Path of the value that is visited with this key. */
  std::string path(const std::string& key) const;

 private:
  struct Level {
    std::string path;
    bool is_list;
  };
  /** The enclosing structs and arrays, outermost first. */
  std::vector<Level> levels_;
};

/** A number in a message. */
struct NumberField {
  /** As PathVisitor names it. */
  std::string path;
  /** Booleans are 0 and 1. */
  double value = 0;
  /** Name of the constant that an enumeration field equals, "STATUS_DONE"; empty for all others. */
  std::string constant;
};

/** Calls `visit` for every number of an encoded message of any type of lcmtypes/.
 * @return false if the bytes are not a message of such a type. */
bool visit_numbers(std::span<const uint8_t> message,
                   const std::function<void(const NumberField&)>& visit);

}  // namespace nao
