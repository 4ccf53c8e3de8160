/** The part of the robot under a finger. */
import type {Mesh, Object3D, Raycaster} from "three";
import type {JointGroup} from "../protocol/generated/remote_pb";
import {jointsOf} from "./joint_axes";
import type {RobotTree} from "./robot_tree";

/** Lower than this fraction of the robot's height a finger means the ground: legs and feet stand in its way there. */
const kLeastHeight = 0.4;

/** Joint group that moves the part that a ray meets; empty if there is none, or it is low. @param height  of the robot, m. */
export function groupAt({torso, urdf}: RobotTree, groups: readonly JointGroup[], ray: Raycaster, height: number): string {
  const hit = ray.intersectObject(torso, true).find(({object}) => object.visible && (object as Mesh).isMesh);
  if (!hit || hit.point.y < kLeastHeight * height) return "";
  for (let link: Object3D | null = hit.object; link; link = link.parent) {
    const joint = urdf.joints.find(({child}) => child === link?.name)?.name;
    const group = joint && groups.find((one) => jointsOf(one).includes(joint));
    if (group) return group.name;
  }
  return "";
}
