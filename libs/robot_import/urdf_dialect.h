#pragma once

#include <string>

#include "robot_import/repair_log.h"

namespace nao {

/** Refuses a text that could exhaust the memory or the stack of an XML parser: more than 16 MiB, or
 * elements nested more than 64 deep. @throws ModelError  then. */
void check_xml_size(const std::string& text, const RepairLog& log);

/** Leaves of a URDF what RobotModel reads: elements of other programs are removed, capsules become
 * cylinders whose names end in "_capsule", shapes without a size are left out, and numbers that
 * cannot be read get their defaults. Names are not changed.
 * @throws ModelError  for an input of xacro: macros, or links and joints with `${...}`. */
void repair_dialect(TiXmlElement& robot, RepairLog& log);

}  // namespace nao
