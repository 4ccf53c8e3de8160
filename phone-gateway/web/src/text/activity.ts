/** Mode and activity of the robot in the page's language; pure. */
import {CommandKind, Mode} from "../protocol/generated/remote_pb";
import type {Activity} from "../protocol/generated/remote_pb";
import {nameOf} from "../protocol/names";
import {kTemporaryName} from "../teach/motion_name";
import {say, sayName} from "./texts";

/** @param isByItself  The robot acts by itself: standing for a moment, it does not wait for anybody. */
export function modeInWords(mode: Mode, isByItself = false): string {
  if (isByItself && mode === Mode.HOLDING) return say("mode.playing");
  return say(`mode.${nameOf(Mode, mode, "no-robot")}`);
}

/** What the robot does beyond what its mode says; empty for a walk, a stop or no activity. */
export function activityInWords(activity: Activity | undefined): string {
  if (!activity) return "";
  if (activity.needsHelp) return say("activity.needsHelp");
  switch (activity.kind) {
    case CommandKind.POSTURE: return sayName("posture", activity.name);
    case CommandKind.ACTION:
      return activity.name === kTemporaryName ? say("teach.draftName") : sayName("action", activity.name);
    case CommandKind.MOVE_TO: return say("activity.moveTo");
    case CommandKind.JOINT_CHANGE: return say("activity.joints");
    default: return "";
  }
}
