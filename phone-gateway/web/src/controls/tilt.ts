/** From the phone's tilt to a walk: away from the person is ahead, to a side turns to it. Pure. */
import type {Drive} from "./stick";

/** No command within this angle, full speed at that one; rad. */
const kDeadAngle = 0.07;
const kFullAngle = 0.45;

/** Below this, where the screen's side edge is down, gravity says nothing of ahead and back; fraction of gravity. Chosen. */
const kLeastGravity = 0.3;

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

/** Walk command for a tilt. @param neutral  the phone's attitude when the pad was touched. */
export function driveFromTilt(tilt: Tilt, neutral: Tilt): Drive {
  return {
    x: fraction(pitch(tilt) - pitch(neutral)) * (isOnSide(tilt) || isOnSide(neutral) ? 0 : 1) + 0,
    y: 0,
    theta: -fraction(roll(tilt) - roll(neutral)) + 0,
  };
}

/** Angle by which the upper edge is lowered, rad: also beyond the vertical, where a sine would turn back. */
const pitch = ({up, out}: Tilt) => Math.atan2(up, -out);
/** Angle by which the right edge is lowered, rad. */
const roll = ({right, up, out}: Tilt) => Math.atan2(right, Math.hypot(up, out));
const isOnSide = ({up, out}: Tilt) => Math.hypot(up, out) < kLeastGravity;

/** @param turned  rad; a turn of more than half is one of less in the other direction. */
function fraction(turned: number): number {
  const angle = Math.atan2(Math.sin(turned), Math.cos(turned));
  const beyond = Math.max(0, Math.abs(angle) - kDeadAngle) / (kFullAngle - kDeadAngle);
  return Math.sign(angle) * Math.min(1, beyond) + 0;
}
