#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "daemons/motion/generators/motion_generator.h"
#include "messages/command.h"
#include "messages/reason.h"

namespace nao::motion {

/** Joint changes of head and arms during a walk: they overwrite what the walk commands for these
 * joints, while the legs walk on.
 *
 * After a change its joints keep their angles until the walk ends, so that the walk's arm swing
 * does not undo it. */
class WalkOverlay {
 public:
  /** Starts a change, which replaces the one in progress. @param command  A joint change.
   * @param start  Targets that it continues from. */
  void start(const Command& command, const MotionContext& context, const JointTargets& start);

  /** The change in progress; nullptr if there is none. */
  const Command* command() const { return change_ ? &change_->command : nullptr; }

  /** Stiffness ramps of the change in progress that have not ended. */
  std::vector<MotionGenerator::StiffnessRamp> unfinished_ramps(const RobotModel& model) const;

  /** Ends the change in progress; its joints keep their angles. */
  void stop() { change_.reset(); }

  /** Ends the change in progress and returns all joints to the walk. */
  void release();

  /** One control step. @param last  Targets of the last step.
   * @return Remark of the change if it is done with this step. */
  std::optional<Reason> step(const MotionContext& context, const JointTargets& last);

  /** Overwrites the angles of the changed joints, and the stiffness that changes now. */
  void write(JointTargets& targets) const;

 private:
  struct Change {
    std::unique_ptr<MotionGenerator> generator;
    Command command;
    /** Motors that it turns. */
    std::vector<int> motors;
    /** Motors whose stiffness it changes. */
    std::vector<int> ramps;
  };

  std::optional<Change> change_;
  /** Target angle of each motor that changes during this walk have turned, rad. */
  std::map<int, double> held_;
  /** Stiffness of the motors of the change in progress. */
  std::map<int, double> stiffness_;
};

}  // namespace nao::motion
