/** From the phone's tilt to a walk: away from the person is ahead, to a side turns to it. Pure. */
import type {Drive} from "./stick";

/** No command within this angle, full speed at that one; rad. */
const kDeadAngle = 0.07;
const kFullAngle = 0.45;

/** Which way is down on the screen: sine of the angle by which its right edge and its upper edge are
 * lowered. */
export interface Tilt {
  right: number;
  up: number;
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
  return {right: c * x - s * y, up: s * x + c * y};
}

/** Walk command for a tilt. @param neutral  the phone's attitude when the pad was touched. */
export function driveFromTilt(tilt: Tilt, neutral: Tilt): Drive {
  return {
    x: share(angle(tilt.up) - angle(neutral.up)),
    y: 0,
    theta: -share(angle(tilt.right) - angle(neutral.right)) + 0,
  };
}

const angle = (sine: number) => Math.asin(Math.min(1, Math.max(-1, sine)));

function share(turned: number): number {
  const beyond = Math.max(0, Math.abs(turned) - kDeadAngle) / (kFullAngle - kDeadAngle);
  return Math.sign(turned) * Math.min(1, beyond) + 0;
}
