/** How tall a robot is, by the shells of its links. */
import {Box3} from "three";
import type {Object3D} from "three";

/** Assumed height of a robot without shells, and until one has been loaded, m. */
export const kUnknownHeight = 0.6;

/** From the lowest to the highest point of its shells in the pose that it has, m.
 * @param torso  Upright, in the robot's own axes (Z up): not yet part of a scene. */
export function calcHeight(torso: Object3D): number {
  const box = new Box3().setFromObject(torso);
  return box.isEmpty() ? kUnknownHeight : box.max.z - box.min.z;
}
