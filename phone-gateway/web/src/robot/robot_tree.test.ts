import {create} from "@bufbuild/protobuf";
import {Quaternion, Vector3} from "three";
import {describe, expect, it} from "vitest";
import {readJoints, readPostures, readUrdf} from "../../test_support/nao_files";
import {StateSchema} from "../protocol/generated/remote_pb";
import {makeRobotAxes, robotToScene} from "./frames";
import {PoseMirror} from "./pose_mirror";
import {RobotTree} from "./robot_tree";

const kRobot = new URL("../../../../data/robots/nao", import.meta.url).pathname;
const urdf = readUrdf(kRobot);
const joints = readJoints(kRobot);

/** Place of a link's frame in the torso's frame, m. */
function placeOf(tree: RobotTree, link: string): Vector3 {
  tree.torso.updateMatrixWorld(true);
  return tree.link(link).getWorldPosition(new Vector3());
}

describe("RobotTree of the NAO", () => {
  it("has 25 motors and 26 joints that turn", () => {
    expect(joints).toHaveLength(25);
    expect(new RobotTree(urdf).movingJoints()).toHaveLength(26);
  });

  it("stands with its soles 333.09 mm below the torso in zero posture", () => {
    const tree = new RobotTree(urdf);
    expect(placeOf(tree, "LSole").z).toBeCloseTo(-0.33309, 5);
    expect(placeOf(tree, "RSole").z).toBeCloseTo(-0.33309, 5);
  });

  it("shows each joint at the angle it is given", () => {
    const tree = new RobotTree(urdf);
    joints.forEach(({name}, i) => tree.setJoint(name, 0.01 * (i + 1)));
    joints.forEach(({name}, i) => expect(tree.jointAngle(name)).toBeCloseTo(0.01 * (i + 1), 9));
  });

  it("turns each joint about its axis by the right hand", () => {
    for (const joint of urdf.joints.filter(({type, mimic}) => type === "revolute" && !mimic)) {
      const tree = new RobotTree(urdf);
      const link = tree.linkOfJoint(joint.name)!;
      const before = link.quaternion.clone();
      tree.setJoint(joint.name, 0.4);
      const turn = before.invert().multiply(link.quaternion);
      const expected = new Quaternion().setFromAxisAngle(new Vector3(...joint.axis), 0.4);
      expect(turn.angleTo(expected), joint.name).toBeLessThan(1e-6);
    }
  });

  it("moves the right hip's yaw-pitch with the left one's", () => {
    const tree = new RobotTree(urdf);
    tree.setJoint("LHipYawPitch", -0.5);
    expect(tree.jointAngle("RHipYawPitch")).toBeCloseTo(-0.5, 9);
    // Both toes point outwards, mirrored.
    const left = new Vector3(1, 0, 0).applyQuaternion(tree.link("LSole").getWorldQuaternion(new Quaternion()));
    const right = new Vector3(1, 0, 0).applyQuaternion(tree.link("RSole").getWorldQuaternion(new Quaternion()));
    expect(left.y).toBeGreaterThan(0.2);
    expect(right.y).toBeCloseTo(-left.y, 6);
  });

  it("looks ahead with the top camera and down with the bottom one", () => {
    const tree = new RobotTree(urdf);
    const view = (link: string) => new Vector3(1, 0, 0).applyQuaternion(
        tree.link(link).getWorldQuaternion(new Quaternion()));
    tree.torso.updateMatrixWorld(true);
    // Both cameras follow the head: 0.1 m above the neck in front, and the lower looks 0.69 rad down.
    expect(placeOf(tree, "CameraTop").z).toBeGreaterThan(placeOf(tree, "CameraBottom").z);
    expect(view("CameraBottom").z).toBeLessThan(view("CameraTop").z - 0.3);
    const before = view("CameraTop").z;
    tree.setJoint("HeadPitch", 0.3);
    tree.torso.updateMatrixWorld(true);
    expect(view("CameraTop").z).toBeLessThan(before - 0.25);
  });

  it("ignores a joint that it does not have", () => {
    const tree = new RobotTree(urdf);
    tree.setJoint("Tail", 1);
    expect(tree.jointAngle("Tail")).toBeNaN();
  });
});

describe("PoseMirror", () => {
  const crouch = readPostures(kRobot)["Crouch"]!;
  const state = (height: number, share = 1) => create(StateSchema, {
    jointPosition: joints.map(({name}) => share * (crouch.angles[name] ?? 0)),
    torsoOrientation: [1, 0, 0, 0], torsoPosition: [0, 0, height],
  });

  it("shows the first state at once and follows the next within 0.2 s", () => {
    const tree = new RobotTree(urdf);
    const mirror = new PoseMirror(tree, joints);
    mirror.setTarget(state(0.333, 0));
    mirror.step(0);
    expect(tree.torso.position.z).toBeCloseTo(0.333, 6);
    mirror.setTarget(state(0.229));
    for (let i = 0; i < 12; i++) mirror.step(1 / 60);
    for (const {name} of joints) {
      expect(Math.abs(tree.jointAngle(name) - (crouch.angles[name] ?? 0)), name).toBeLessThan(0.005);
    }
    expect(tree.torso.position.z).toBeCloseTo(0.229, 3);
  });

  it("asks for no frame while it shows the state, and for one as soon as any joint is an encoder's step away", () => {
    const tree = new RobotTree(urdf);
    const mirror = new PoseMirror(tree, joints);
    mirror.setTarget(state(0.229));
    expect(mirror.step(1 / 60)).toBe(true);
    expect(mirror.step(1 / 60)).toBe(false);
    for (let i = 0; i < joints.length; i++) {
      const moved = state(0.229);
      moved.jointPosition[i]! += 0.0015;
      mirror.setTarget(moved);
      expect(mirror.step(1 / 60), joints[i]!.name).toBe(true);
      mirror.setTarget(state(0.229));
      for (let frame = 0; frame < 20; frame++) mirror.step(1 / 60);
      expect(mirror.step(1 / 60), joints[i]!.name).toBe(false);
    }
    mirror.setTarget(state(0.231));
    expect(mirror.step(1 / 60)).toBe(true);
  });

  it("keeps what it shows where a state is not finite", () => {
    const tree = new RobotTree(urdf);
    const mirror = new PoseMirror(tree, joints);
    mirror.setTarget(state(0.229));
    const bad = state(NaN);
    bad.jointPosition[0] = NaN;
    bad.torsoOrientation = [0, 0, 0, 0];
    mirror.setTarget(bad);
    mirror.step(1);
    expect(tree.torso.position.z).toBeCloseTo(0.229, 6);
    expect(tree.jointAngle("HeadYaw")).toBeCloseTo(crouch.angles["HeadYaw"] ?? 0, 6);
  });
});

describe("frames", () => {
  it("put the robot's axes into three.js's the same way for points and for objects", () => {
    const tree = new RobotTree(urdf);
    tree.torso.position.set(1, 2, 3);
    const root = tree.torso.clone().clear();
    makeRobotAxes(root);
    const point = new Vector3(1, 2, 3).applyQuaternion(root.quaternion);
    expect(point.distanceTo(robotToScene(1, 2, 3, new Vector3()))).toBeLessThan(1e-9);
    expect(point.y).toBeCloseTo(3, 9);
  });
});
