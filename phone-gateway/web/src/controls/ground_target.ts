/** From a spot on the ground to a walk there; pure. */

/** Nearer than this the robot only shuffles, and keeps its heading; m. */
const kTurnDistance = 0.4;
/** As far as MoveTo goes; m. */
export const kMaxWalk = 10;

export interface RelativePose {
  x: number;
  y: number;
  theta: number;
}

/** Pose of a spot as seen from the robot, facing where it came along. Null if it is too far.
 * @param spot,robot  m in the odometry frame. @param heading  rad. */
export function walkTo(spot: {x: number; y: number}, robot: {x: number; y: number},
                       heading: number): RelativePose | null {
  const dx = spot.x - robot.x;
  const dy = spot.y - robot.y;
  const c = Math.cos(heading);
  const s = Math.sin(heading);
  const x = c * dx + s * dy;
  const y = -s * dx + c * dy;
  if (Math.max(Math.abs(x), Math.abs(y)) > kMaxWalk) return null;
  return {x, y, theta: Math.hypot(x, y) > kTurnDistance ? Math.atan2(y, x) : 0};
}
