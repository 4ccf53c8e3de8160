/** Joints mode on the stage: the robot becomes translucent, each joint group gets a ball to tap, and
 * arcs show how far the chosen one turns. */
import {
  BufferGeometry, Float32BufferAttribute, Group, Line, LineBasicMaterial, Matrix4, Mesh, MeshBasicMaterial,
  Quaternion, RingGeometry, SphereGeometry, Vector3,
} from "three";
import type {Object3D} from "three";
import type {JointGroup} from "../protocol/generated/remote_pb";
import {jointOfAxis, kAxes, kAxisColors} from "./joint_axes";
import type {Axis} from "./joint_axes";
import type {RobotSurface} from "./robot_surface";
import {quaternionFromRpy} from "./robot_tree";
import type {RobotTree} from "./robot_tree";
import type {Stage} from "./stage";

const kBallRadius = 0.015;
const kArcRadius = 0.075;
const kArcWidth = 0.008;
/** Radius of a tap, px, about a fingertip: the nearest ball within it is selected. */
const kReach = 44;

type Canvas = Pick<Stage, "onCanvas">;

interface Ball {
  group: JointGroup;
  mesh: Mesh<SphereGeometry, MeshBasicMaterial>;
}

interface Arc {
  joint: string;
  object: Group;
  needle: Object3D;
}

export class JointBalls {
  private readonly balls: Ball[] = [];
  private arcs: readonly Arc[] = [];
  /** Arcs of each group that was chosen before: they are made once, since some graphics drivers leak memory at
   * each change. */
  private readonly arcsOfGroup = new Map<string, readonly Arc[]>();
  private readonly place = new Vector3();
  private readonly sphere = new SphereGeometry(kBallRadius, 20, 14);

  constructor(private readonly tree: RobotTree, private readonly surface: RobotSurface,
              groups: readonly JointGroup[]) {
    for (const group of groups) {
      const link = linkOfGroup(tree, group);
      if (!link) continue;
      const material = new MeshBasicMaterial({color: 0xdfe9f2, depthTest: false, transparent: true,
                                              opacity: 0.9});
      const mesh = new Mesh(this.sphere, material);
      mesh.renderOrder = 10;
      mesh.visible = false;
      link.add(mesh);
      this.balls.push({group, mesh});
    }
  }

  /** Balls and a translucent robot, or the robot as it is. */
  show(isShown: boolean): void {
    for (const {mesh} of this.balls) mesh.visible = isShown;
    this.surface.setGhost(isShown, this.tree.torso);
    if (!isShown) this.select("");
  }

  /** Chooses a group by name; empty: none. */
  select(name: string): void {
    for (const {group, mesh} of this.balls) {
      const isSelected = group.name === name;
      mesh.material.color.set(isSelected ? 0x4fb4f5 : 0xdfe9f2);
      mesh.scale.setScalar(isSelected ? 1.45 : 1);
    }
    for (const {object} of this.arcs) object.visible = false;
    const group = this.balls.find((ball) => ball.group.name === name)?.group;
    this.arcs = group ? this.arcsOf(group) : [];
    for (const {object} of this.arcs) object.visible = true;
    this.update();
  }

  /** The group whose ball is nearest to a tap; empty if none is within reach.
   * @param x,y  px from the canvas's top left. @param canvas  says where a point is on it. */
  pick(x: number, y: number, canvas: Canvas): string {
    const distances = this.places(canvas)
        .map(([group, place]) => ({group, distance: Math.hypot(place[0] - x, place[1] - y)}))
        .filter(({distance}) => distance < kReach).sort((a, b) => a.distance - b.distance);
    return distances[0]?.group ?? "";
  }

  /** The link that a group's ball is fixed to; null if there is no such ball. */
  linkOf(name: string): Object3D | null {
    return this.balls.find((ball) => ball.group.name === name)?.mesh.parent ?? null;
  }

  /** Where each ball is on the canvas, px, by joint group. */
  places({onCanvas}: Canvas): [string, [number, number]][] {
    return this.balls.map(({group, mesh}) => [group.name, onCanvas(mesh.getWorldPosition(this.place))]);
  }

  /** Moves the arcs' needles to the angles shown. */
  update(): void {
    for (const arc of this.arcs) arc.needle.rotation.z = this.tree.jointAngle(arc.joint);
  }

  private arcsOf(group: JointGroup): readonly Arc[] {
    let arcs = this.arcsOfGroup.get(group.name);
    if (!arcs) {
      arcs = kAxes.flatMap((axis) => this.makeArc(jointOfAxis(group, axis), axis));
      this.arcsOfGroup.set(group.name, arcs);
    }
    return arcs;
  }

  private makeArc(name: string, axis: Axis): Arc[] {
    const joint = this.tree.joint(name);
    const link = this.tree.linkOfJoint(name);
    if (!joint || !link?.parent) return [];
    const {lower, upper} = joint;
    const object = new Group();
    object.position.copy(link.position);
    object.quaternion.copy(quaternionFromRpy(joint.rpy))
        .multiply(arcFrame(new Vector3(...joint.axis), zeroDirection(link)));
    const material = {color: kAxisColors[axis], depthTest: false, transparent: true, side: 2} as const;
    const ring = new Mesh(
        new RingGeometry(kArcRadius, kArcRadius + kArcWidth, 48, 1, lower, upper - lower),
        new MeshBasicMaterial({...material, opacity: 0.8}));
    ring.renderOrder = 8;
    const needle = new Group();
    const tip = new Mesh(this.sphere, new MeshBasicMaterial(material));
    tip.scale.setScalar(0.6);
    tip.position.x = kArcRadius + kArcWidth / 2;
    tip.renderOrder = 11;
    const hand = new Line(
        new BufferGeometry().setAttribute("position", new Float32BufferAttribute(
            [0, 0, 0, kArcRadius, 0, 0], 3)), new LineBasicMaterial({...material, opacity: 0.8}));
    hand.renderOrder = 9;
    needle.add(tip, hand);
    object.add(ring, needle);
    link.parent.add(object);
    return [{joint: name, object, needle}];
  }
}

/** Link whose frame stands for the group: where its last axis turns. */
function linkOfGroup(tree: RobotTree, group: JointGroup): Object3D | null {
  return tree.linkOfJoint(group.pitchJoint) ?? tree.linkOfJoint(group.rollJoint) ??
      tree.linkOfJoint(group.yawJoint);
}

/** Turns z to the joint's axis and x to where the arc's zero is. */
function arcFrame(axis: Vector3, zero: Vector3): Quaternion {
  const flat = zero.clone().addScaledVector(axis, -zero.dot(axis));
  if (flat.lengthSq() < 1e-4) flat.set(1, 0, 0).addScaledVector(axis, -axis.x);
  if (flat.lengthSq() < 1e-4) flat.set(0, 0, -1).addScaledVector(axis, axis.z);
  flat.normalize();
  return new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(flat, axis.clone().cross(flat), axis));
}

/** Where the link points at angle 0: to the next link that is not at the same place. */
function zeroDirection(link: Object3D): Vector3 {
  for (let child = link.children.find(isLink); child; child = child.children.find(isLink)) {
    if (child.position.length() > 0.02) return child.position.clone().normalize();
  }
  return new Vector3(1, 0, 0);
}

const isLink = (object: Object3D) => (object as Group).isGroup && object.name !== "";
