/** The part of the robot under a finger. */
import {Raycaster, Vector2} from "three";
import type {Camera, Mesh, Object3D} from "three";
import type {JointGroup} from "../protocol/generated/remote_pb";
import type {RobotTree} from "./robot_tree";

/** Lower than this fraction of the robot's height a finger means the ground: legs and feet stand in its way there. */
const kLeastHeight = 0.4;

/** Joint group that moves the part under a point; empty if there is none, or it is low.
 * @param x,y  -1 to 1, right and up. @param height  of the robot, m. */
export function groupAt({torso, urdf}: RobotTree, groups: readonly JointGroup[], camera: Camera, x: number, y: number,
                        height: number): string {
  const ray = new Raycaster();
  ray.setFromCamera(new Vector2(x, y), camera);
  const hit = ray.intersectObject(torso, true).find(({object}) => object.visible && (object as Mesh).isMesh);
  if (!hit || hit.point.y < kLeastHeight * height) return "";
  for (let link: Object3D | null = hit.object; link; link = link.parent) {
    const joint = urdf.joints.find(({child}) => child === link?.name)?.name;
    const group = joint && groups.find(({yawJoint, pitchJoint, rollJoint}) => [yawJoint, pitchJoint, rollJoint].includes(joint));
    if (group) return group.name;
  }
  return "";
}
