/** The robot as a tree of three.js objects, one per link, in the robot's own axes (Z up). */
import {Euler, Group, Quaternion, Vector3} from "three";
import type {Triple, Urdf, UrdfJoint} from "./urdf";

interface JointNode {
  joint: UrdfJoint;
  /** Frame of the child link; its rest orientation is that at angle 0. */
  link: Group;
  rest: Quaternion;
  axis: Vector3;
  angle: number;
  followers: JointNode[];
}

export class RobotTree {
  /** The root link; its position and orientation are the torso's. */
  readonly torso: Group;
  private readonly links = new Map<string, Group>();
  private readonly joints = new Map<string, JointNode>();
  private readonly turn = new Quaternion();

  constructor(readonly urdf: Urdf) {
    for (const {name} of urdf.links) {
      const link = new Group();
      link.name = name;
      this.links.set(name, link);
    }
    this.torso = this.link(urdf.root);
    for (const joint of urdf.joints) this.attach(joint);
    for (const node of this.joints.values()) {
      if (node.joint.mimic) this.joints.get(node.joint.mimic.joint)?.followers.push(node);
    }
  }

  /** @throws Error if there is no such link. */
  link(name: string): Group {
    const link = this.links.get(name);
    if (!link) throw new Error(`the robot has no link ${name}`);
    return link;
  }

  /** The link that a joint moves: its frame is the joint's. Null if there is no such joint. */
  linkOfJoint(name: string): Group | null {
    return this.joints.get(name)?.link ?? null;
  }

  joint(name: string): UrdfJoint | null {
    return this.joints.get(name)?.joint ?? null;
  }

  /** Angle that is shown, rad; NaN if there is no such joint. */
  jointAngle(name: string): number {
    return this.joints.get(name)?.angle ?? NaN;
  }

  /** Names of the joints that turn, mimics among them, in the URDF's order of depth. */
  movingJoints(): string[] {
    return [...this.joints.values()].filter((node) => node.joint.type === "revolute")
        .map((node) => node.joint.name);
  }

  /** Turns a joint, and those that mimic it. A name that the robot does not have is ignored: a newer
   * gateway may know more than this page. @param angle rad. */
  setJoint(name: string, angle: number): void {
    const node = this.joints.get(name);
    if (node) this.turnNode(node, angle);
  }

  private turnNode(node: JointNode, angle: number): void {
    node.angle = angle;
    node.link.quaternion.copy(node.rest).multiply(this.turn.setFromAxisAngle(node.axis, angle));
    for (const follower of node.followers) {
      const {multiplier, offset} = follower.joint.mimic!;
      this.turnNode(follower, multiplier * angle + offset);
    }
  }

  private attach(joint: UrdfJoint): void {
    const link = this.link(joint.child);
    this.link(joint.parent).add(link);
    link.position.set(...joint.xyz);
    link.quaternion.copy(quaternionFromRpy(joint.rpy));
    this.joints.set(joint.name, {
      joint, link,
      rest: link.quaternion.clone(),
      axis: new Vector3(...joint.axis),
      angle: 0,
      followers: [],
    });
  }
}

/** URDF's rotation: R = Rz(yaw) Ry(pitch) Rx(roll). */
export function quaternionFromRpy(rpy: Triple): Quaternion {
  return new Quaternion().setFromEuler(new Euler(...rpy, "ZYX"));
}
