/** From a touch position on a round pad to a command; pure. */
import {clamp} from "../clamp";

/** Dead zone, fraction of the radius: fingers tremble. */
export const kDeadZone = 0.12;

export interface StickValue {
  /** To the right and up, each -1 to 1; never outside the unit circle. */
  right: number;
  up: number;
}

/** @param dx,dy  px from the pad's centre, y down as on screens. @param radius  px. @param deadZone  fraction of it.
 * @return fractions with the dead zone removed, so that they begin at 0 at its edge; finer near the
 * middle than at the rim (square law), for slow steps. */
export function stickValue(dx: number, dy: number, radius: number, deadZone = kDeadZone): StickValue {
  const reach = Math.hypot(dx, dy) / radius;
  if (!(reach > deadZone)) return {right: 0, up: 0};
  const fraction = (Math.min(reach, 1) - deadZone) / (1 - deadZone);
  const strength = 0.35 * fraction + 0.65 * fraction * fraction;
  const length = Math.hypot(dx, dy);
  return {right: strength * dx / length, up: strength * -dy / length};
}

/** A drive command: fractions of the highest velocities forward, to the left and of turning left, -1 to 1. */
export interface Drive {
  x: number;
  y: number;
  theta: number;
}

/** Up on the walk stick is ahead, right is to the right; right on the turn stick turns right. */
export function driveFromSticks(walk: StickValue, turn: StickValue): Drive {
  return {x: unsigned(walk.up), y: unsigned(-walk.right), theta: unsigned(-turn.right)};
}

/** Sum of several sources (sticks, keys, gamepad, tilt), each axis cut at full speed. */
export function addDrives(drives: readonly Drive[]): Drive {
  const sum = (axis: keyof Drive) => clamp(drives.reduce((total, drive) => total + drive[axis], 0), -1, 1);
  return {x: sum("x"), y: sum("y"), theta: sum("theta")};
}

/** No -0. */
const unsigned = (value: number) => value === 0 ? 0 : value;
