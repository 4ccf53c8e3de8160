/** The axes about which a joint group turns, and the joints about them. */
import type {JointGroup} from "../protocol/generated/remote_pb";

/** Far apart for colour-blind eyes too, as joint_balls.test.ts holds; and named beside the controls. */
export const kAxisColors = {yaw: 0x3d9bff, pitch: 0xffb84d, roll: 0xf0c8ff} as const;
export type Axis = keyof typeof kAxisColors;
export const kAxes: readonly Axis[] = ["yaw", "pitch", "roll"];

/** Name of a group's joint about an axis; empty if it has none. */
export function jointOfAxis(group: JointGroup, axis: Axis): string {
  return group[`${axis}Joint`];
}

/** Names of a group's joints. */
export function jointsOf(group: JointGroup): string[] {
  return kAxes.map((axis) => jointOfAxis(group, axis)).filter((name) => name !== "");
}
