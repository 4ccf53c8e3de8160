#pragma once

#include <string>

#include "robot_import/repair_log.h"

namespace nao {

/** The bytes of a file as UTF-8 that begins with its first element: UTF-16, and what is not UTF-8
 * (read as the encoding that the file states, else as Windows-1252), are converted; a byte order
 * mark, the lines of another program above the XML, DOCTYPE and NUL are left out. Lines keep their
 * numbers.
 * @throws ModelError  if the bytes do not fit their encoding. */
std::string to_xml_text(const std::string& bytes, RepairLog& log);

}  // namespace nao
