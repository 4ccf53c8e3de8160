/** Which joint groups make up a limb: all that hang on the same branch of the robot's root link. */
import type {JointGroup} from "../protocol/generated/remote_pb";
import {jointsOf} from "../robot/joint_axes";
import type {Urdf} from "../robot/urdf";

/** Names of the groups of one limb, in the robot's order. @param name  of one of them; unknown: none. */
export function limbOf(urdf: Urdf, groups: readonly JointGroup[], name: string): string[] {
  const group = groups.find((one) => one.name === name);
  const branch = group ? branchOf(urdf, group) : "";
  return branch ? groups.filter((one) => branchOf(urdf, one) === branch).map((one) => one.name) : [];
}

/** Names of the joints of some groups. */
export function jointsOfGroups(groups: readonly JointGroup[], names: readonly string[]): string[] {
  return groups.filter(({name}) => names.includes(name)).flatMap(jointsOf);
}

/** Names of the joints that a change of a group moves. @param isMirrored  the other side moves, too. */
export function jointsOfChange(groups: readonly JointGroup[], joints: readonly {name: string; mirrorJoint: string}[],
                               name: string, isMirrored: boolean): string[] {
  const own = jointsOfGroups(groups, [name]);
  const others = own.map((joint) => joints.find((one) => one.name === joint)?.mirrorJoint ?? "");
  return isMirrored ? [...new Set([...own, ...others])].filter((joint) => joint !== "") : own;
}

/** The joint of the root link that carries a group; empty if the URDF does not have its joints. */
function branchOf(urdf: Urdf, group: JointGroup): string {
  const byChild = new Map(urdf.joints.map((joint) => [joint.child, joint]));
  const names = jointsOf(group);
  let joint = urdf.joints.find((one) => names.includes(one.name));
  for (let next = joint; next; next = byChild.get(next.parent)) joint = next;
  return joint?.name ?? "";
}
