/** The one place where the robot's axes become three.js's.
 *
 *    robot, odometry, field: Z up        three.js: Y up
 *
 *         z   x ahead                         y   x ahead
 *         |  /                                |  /
 *         | /                                 | /
 *    y ---+                                   +--- z
 *    left                                          right
 *
 * (x, y, z) in the robot's axes is (x, z, -y) in three.js's: a turn of -90 degrees about x.
 * Everything of the robot hangs below one Object3D that carries this turn, so that inside it the
 * numbers of URDF, meshes and messages hold as they are. */
import type {Object3D} from "three";
import {Vector3} from "three";

/** Turns `root` so that what hangs below it is given in the robot's axes. */
export function makeRobotAxes(root: Object3D): void {
  root.rotation.set(-Math.PI / 2, 0, 0);
}

/** A point in the robot's axes, m, as a point of the three.js scene. @param out  is written. */
export function robotToScene(x: number, y: number, z: number, out: Vector3): Vector3 {
  return out.set(x, z, -y);
}

/** Heading of a torso's orientation (w, x, y, z), rad: where its x axis points on the ground. */
export function headingOf([w = 1, x = 0, y = 0, z = 0]: readonly number[]): number {
  return Math.atan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z));
}
