#pragma once

#include <string>

#include "phone-gateway/server/core/exhibition_desk.h"

namespace nao::gateway {

/** The files of an exhibition: reads the state of the run before, and writes state and report. */
class ExhibitionFiles {
 public:
  /** Empty: no such file. */
  ExhibitionFiles(std::string state_file, std::string report_file)
      : state_file_(std::move(state_file)), report_file_(std::move(report_file)) {}

  /** @return The queue as it was; an empty one if there is no file, or, with a line in the log, if
   * it is damaged. */
  QueueState read() const;
  /** Writes at once what decides who drives, and times each 5 s. Call it once a second. */
  void write(const QueueState& state, double now);
  /** Writes in any case. */
  void write_all(const QueueState& state);

 private:
  std::string state_file_;
  std::string report_file_;
  /** What was written last, without times that always change, and when, s. */
  std::string last_order_;
  double last_write_ = -1e9;
};

}  // namespace nao::gateway
