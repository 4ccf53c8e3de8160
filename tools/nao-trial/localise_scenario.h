#pragma once

#include "tools/nao-trial/scenario.h"

namespace nao::trial {

/** Walks about the field as a driver would, and compares the estimated pose with the true one; then
 * is placed elsewhere several times. */
class LocaliseScenario : public Scenario {
 public:
  /** @param is_rendered  nao-vision's perception on rendered images, or detections by
   * FieldErrorModel. */
  explicit LocaliseScenario(bool is_rendered) : is_rendered_(is_rendered) {}

  const char* name() const override { return is_rendered_ ? "localise" : "localise-error-model"; }
  const char* summary() const override {
    return is_rendered_
               ? "Estimate the pose on the field from rendered images for --duration (600 s), then "
                 "after being placed elsewhere"
               : "localise, with an error model instead of images";
  }
  std::map<std::string, std::string> units() const override;
  const char* scene() const override { return "soccer"; }
  std::vector<RunResult> run(const ScenarioOptions& options, uint64_t seed) const override;

 private:
  bool is_rendered_;
};

}  // namespace nao::trial
