/** From the phone's tilt to a walk: away from the person is ahead, to a side turns to it. Pure. */
import type {Drive} from "./stick";

/** No command within this angle, full speed at that one; rad. */
const kDeadAngle = 0.07;
const kFullAngle = 0.45;

/** Below this, where the screen's side edge is down, gravity says nothing of ahead and back; fraction of gravity. Chosen. */
const kLeastGravity = 0.3;

/** A phone turned farther than this was dropped, or put down on its face; rad. Chosen: no wrist turns so far. */
const kTurnedOver = 0.75 * Math.PI;

/** Which way is down, in the page's axes: a unit vector to the right, to the upper edge, and out of the screen. */
export interface Tilt {
  right: number;
  up: number;
  out: number;
}

/** @param beta,gamma  DeviceOrientationEvent's angles, degrees. @param screenAngle  by which the
 * page is turned against the phone's natural position, degrees (screen.orientation.angle).
 *
 * Source: W3C DeviceOrientation, R = Rz(alpha) Rx(beta) Ry(gamma); gravity in the phone's axes is
 * R^T (0, 0, -1) = (cos b sin g, -sin b, -cos b cos g), x to the right, y to the upper edge. */
export function tiltFromAngles(beta: number, gamma: number, screenAngle: number): Tilt {
  const radians = Math.PI / 180;
  const x = Math.cos(beta * radians) * Math.sin(gamma * radians);
  const y = -Math.sin(beta * radians);
  const c = Math.cos(screenAngle * radians);
  const s = Math.sin(screenAngle * radians);
  return {right: c * x - s * y, up: s * x + c * y, out: -Math.cos(beta * radians) * Math.cos(gamma * radians)};
}

/** Walk command for a tilt. @param neutral  the phone's attitude when the pad was touched.
 *
 * The shortest rotation from one direction of gravity to the other keeps its sign up to half a turn, where angles taken from
 * a sine turn back at the vertical. Its axis is perpendicular to `neutral`; the part along the page's right is ahead. */
export function driveFromTilt(tilt: Tilt, neutral: Tilt): Drive {
  const axis = cross(neutral, tilt);
  const sine = Math.hypot(axis.right, axis.up, axis.out);
  const angle = Math.atan2(sine, dot(neutral, tilt));
  if (sine === 0 || angle > kTurnedOver || isOnSide(neutral)) return {x: 0, y: 0, theta: 0};
  const side = cross(neutral, {right: 1, up: 0, out: 0});
  const scale = angle / sine / Math.hypot(side.right, side.up, side.out);
  // The page's right, without its part along gravity, is side x neutral.
  const pitch = dot(axis, cross(side, neutral)) * scale;
  const roll = dot(axis, side) * scale;
  return {x: isOnSide(tilt) ? 0 : fraction(pitch), y: 0, theta: -fraction(roll) + 0};
}

const dot = (a: Tilt, b: Tilt): number => a.right * b.right + a.up * b.up + a.out * b.out;
const cross = (a: Tilt, b: Tilt): Tilt => ({
  right: a.up * b.out - a.out * b.up,
  up: a.out * b.right - a.right * b.out,
  out: a.right * b.up - a.up * b.right,
});
const isOnSide = ({up, out}: Tilt): boolean => Math.hypot(up, out) < kLeastGravity;

/** @param angle  rad. */
function fraction(angle: number): number {
  const beyond = Math.max(0, Math.abs(angle) - kDeadAngle) / (kFullAngle - kDeadAngle);
  return Math.sign(angle) * Math.min(1, beyond) + 0;
}
