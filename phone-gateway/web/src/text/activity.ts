/** What the robot is doing, as a person says it; pure. */
import {say, sayName} from "./texts";

/** @param activity  State.activity: the kind of command and its detail, such as "posture Sit". What the mode says
 * already, such as that it walks, is left out; what nobody knows is said as it is. */
export function activityInWords(activity: string): string {
  const [kind = "", ...rest] = activity.split(" ");
  const detail = rest.join(" ");
  switch (kind) {
    case "posture": return sayName("posture", detail);
    case "action": return sayName("action", detail);
    case "move-to": return say("activity.moveTo");
    case "joint-change": return say("activity.joints");
    case "walk":
    case "stop": return "";
    default: return activity === "needs help" ? say("activity.needsHelp") : activity;
  }
}
