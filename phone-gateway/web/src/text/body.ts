/** The condition of the robot's body in the page's language; pure. */
import type {Body, RobotDescription} from "../protocol/generated/remote_pb";
import {jointsOf} from "../robot/joint_axes";
import {isText, say, sayName} from "./texts";

/** A joint as a person says it: by the name of its group. */
function sayJoint(name: string, robot: RobotDescription | null): string {
  const group = robot?.jointGroups.find((one) => jointsOf(one).includes(name));
  return group ? sayName("group", group.name) : name;
}

/** Empty if nothing is known. */
export function batteryInWords(body: Body | undefined): string {
  if (body?.batteryCharge === undefined) return "";
  return say(body.isCharging ? "body.charging" : "body.battery", {percent: Math.round(100 * body.batteryCharge)});
}

/** One sentence each; a code that this page does not know as it is. */
export function warningsInWords(body: Body | undefined, robot: RobotDescription | null): string[] {
  const joints = [...new Set((body?.faultyJoints ?? []).map((name) => sayJoint(name, robot)))].join(", ");
  return (body?.warnings ?? []).map((code) => {
    const key = `body.${code}`;
    return isText(key) ? say(key, {joints: joints || "?"}) : code;
  });
}

/** Everything, one sentence each. */
export function bodyInWords(body: Body | undefined, robot: RobotDescription | null): string[] {
  if (!body) return [say("body.unknown")];
  const lines = [batteryInWords(body)];
  if (body.hottestJoint) {
    lines.push(say("body.hottest", {joint: sayJoint(body.hottestJoint, robot),
                                    temperature: Math.round(body.hottestTemperature)}));
  }
  const warnings = warningsInWords(body, robot);
  lines.push(...warnings.length > 0 ? warnings : [say("body.fine")]);
  return lines.filter((line) => line !== "");
}
