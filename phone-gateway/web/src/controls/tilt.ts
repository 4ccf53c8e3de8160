/** From the phone's tilt to a walk: away from the person is ahead, to a side turns to it. Pure. */
import {Euler, Quaternion, Vector3} from "three";
import type {Drive} from "./stick";

/** One degree, rad. */
const kDegree = Math.PI / 180;
/** Axes of the page. */
const kRight = new Vector3(1, 0, 0);
const kOut = new Vector3(0, 0, 1);

/** No command within this angle, full speed at that one; rad. */
const kDeadAngle = 0.07;
const kFullAngle = 0.45;

/** Below this, where the screen's side edge is down, gravity says nothing of ahead and back; fraction of gravity. Chosen. */
const kLeastGravity = 0.3;

/** A phone turned farther than this was dropped, or put down on its face; rad. Chosen: no wrist turns so far. */
const kTurnedOver = 0.75 * Math.PI;

/** @param beta,gamma  DeviceOrientationEvent's angles, degrees. @param screenAngle  by which the
 * page is turned against the phone's natural position, degrees (screen.orientation.angle).
 * @return which way is down, in the page's axes: a unit vector to the right, to the upper edge, and out of the screen.
 *
 * Source: W3C DeviceOrientation, R = Rz(alpha) Rx(beta) Ry(gamma); gravity in the phone's axes is R^T (0, 0, -1). */
export function tiltFromAngles(beta: number, gamma: number, screenAngle: number): Vector3 {
  const phone = new Quaternion().setFromEuler(new Euler(beta * kDegree, gamma * kDegree, 0, "ZXY"));
  return new Vector3(0, 0, -1).applyQuaternion(phone.invert()).applyAxisAngle(kOut, screenAngle * kDegree);
}

/** Walk command for a tilt. @param neutral  the phone's attitude when the pad was touched.
 *
 * The shortest rotation from one direction of gravity to the other keeps its sign up to half a turn, where angles taken from
 * a sine turn back at the vertical. Its axis is perpendicular to `neutral`; the part along the page's right is ahead. */
export function driveFromTilt(tilt: Vector3, neutral: Vector3): Drive {
  const angle = neutral.angleTo(tilt);
  if (angle > kTurnedOver || isOnSide(neutral)) return {x: 0, y: 0, theta: 0};
  const rotation = neutral.clone().cross(tilt).setLength(angle);
  const side = neutral.clone().cross(kRight).normalize();
  // The page's right, without its part along gravity, is side x neutral.
  const pitch = rotation.dot(side.clone().cross(neutral));
  return {x: isOnSide(tilt) ? 0 : fraction(pitch), y: 0, theta: -fraction(rotation.dot(side)) + 0};
}

const isOnSide = ({y, z}: Vector3): boolean => Math.hypot(y, z) < kLeastGravity;

/** @param angle  rad. */
function fraction(angle: number): number {
  const beyond = Math.max(0, Math.abs(angle) - kDeadAngle) / (kFullAngle - kDeadAngle);
  return Math.sign(angle) * Math.min(1, beyond) + 0;
}
