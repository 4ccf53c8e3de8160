/** From a joystick position to a change of a joint group; pure. */
import type {UseCaseValue} from "../protocol/codec";
import type {JointGroup} from "../protocol/generated/remote_pb";
import type {StickValue} from "./stick";

/** Changes about a group's axes, as ChangeJoints takes them. */
export type JointChange = UseCaseValue<"changeJoints">;

/** Speed at the rim of the pad, rad/s: half a turn of the head in two seconds. */
export const kJointRate = 0.9;
/** A hand opens in about a second; 1/s. */
const kHandRate = 1;

/** Change of a group for a joystick position held for `dt` seconds. The ball follows the finger: up lifts
 * (negative pitch), and left turns to the left of the screen, which is the robot's right when it is
 * seen from the front. Hands open upwards. */
export function changeFromStick(group: JointGroup, stick: StickValue, isInFront: boolean,
                                dt: number): JointChange {
  const side = isInFront ? 1 : -1;
  return {
    group: group.name,
    yaw: group.yawJoint ? side * stick.right * kJointRate * dt : 0,
    pitch: !group.pitchJoint ? 0 : group.isOpening ? stick.up * kHandRate * dt : -stick.up * kJointRate * dt,
    roll: 0,
  };
}

/** True if it asks for nothing. */
export function isNoChange({yaw, pitch, roll}: JointChange): boolean {
  return !yaw && !pitch && !roll;
}
