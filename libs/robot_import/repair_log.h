#pragma once

#include <tinyxml.h>

#include <string>

#include "common/error.h"
#include "robot_import/finding.h"

namespace nao {

/** Collects what was repaired in a URDF, with its lines. */
struct RepairLog {
  /** Name of the URDF without its folder. */
  std::string file;
  Findings findings;

  void note(Finding::Severity severity, const TiXmlNode& node, const std::string& element,
            const std::string& problem, const std::string& remedy) {
    findings.push_back({severity, file, node.Row(), element, problem, remedy});
  }
  /** @throws ModelError  always. @param node  nullptr: the file as a whole. */
  [[noreturn]] void fail(const TiXmlNode* node, const std::string& problem,
                         const std::string& remedy) const {
    throw ModelError(to_line({Finding::Severity::kMissing, file, node == nullptr ? 0 : node->Row(),
                              "", problem, remedy}));
  }
};

}  // namespace nao
