#pragma once

#include <string>
#include <vector>

namespace nao {

/** A fault of a robot's description, or an assumption that replaces it. */
struct Finding {
  enum class Severity { kNote, kRepaired, kMissing };

  Severity severity = Severity::kNote;
  std::string file;
  /** Line in the file; 0: the file as a whole. */
  int line = 0;
  /** "joint LKneePitch". */
  std::string element;
  std::string problem;
  /** What was done, or must be done. */
  std::string remedy;
};

using Findings = std::vector<Finding>;

/** "robot.urdf:12: joint knee: has no limit; -3.14 to 3.14 rad are assumed". */
std::string to_line(const Finding& finding);

}  // namespace nao
