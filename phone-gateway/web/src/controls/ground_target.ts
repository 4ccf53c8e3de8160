/** From a spot on the ground to a walk there; pure. */
import {Vector2} from "three";
import type {Vector2Like} from "three";
import type {UseCaseValue} from "../protocol/codec";

/** Nearer than this the robot only shuffles, and keeps its heading; m. */
const kTurnDistance = 0.4;
/** As far as MoveTo goes; m. */
export const kMaxWalk = 10;

/** Pose of a spot as seen from the robot, facing where it came along. Null if it is too far.
 * @param spot,robot  m in the odometry frame. @param heading  rad. */
export function walkTo(spot: Vector2Like, robot: Vector2Like, heading: number): UseCaseValue<"moveTo"> | null {
  const {x, y} = new Vector2(spot.x, spot.y).sub(robot).rotateAround(new Vector2(), -heading);
  if (Math.max(Math.abs(x), Math.abs(y)) > kMaxWalk) return null;
  return {x, y, theta: Math.hypot(x, y) > kTurnDistance ? Math.atan2(y, x) : 0};
}
