#include "robot_import/finding.h"

namespace nao {

std::string to_line(const Finding& finding) {
  std::string text = finding.file;
  if (finding.line > 0) text += ":" + std::to_string(finding.line);
  text += ": ";
  if (!finding.element.empty()) text += finding.element + ": ";
  text += finding.problem;
  if (!finding.remedy.empty()) text += "; " + finding.remedy;
  return text;
}

}  // namespace nao
