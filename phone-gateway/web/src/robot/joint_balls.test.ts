import {create} from "@bufbuild/protobuf";
import {PerspectiveCamera, RingGeometry} from "three";
import type {Mesh} from "three";
import {describe, expect, it} from "vitest";
import {readUrdf} from "../../test_support/nao_files";
import {JointGroupSchema} from "../protocol/generated/remote_pb";
import {JointBalls} from "./joint_balls";
import {RobotSurface} from "./robot_surface";
import {RobotTree} from "./robot_tree";

const urdf = readUrdf(new URL("../../../../robots/nao", import.meta.url).pathname);
const groups = [
  create(JointGroupSchema, {name: "head", yawJoint: "HeadYaw", pitchJoint: "HeadPitch"}),
  create(JointGroupSchema, {name: "left shoulder", pitchJoint: "LShoulderPitch", rollJoint: "LShoulderRoll"}),
];

function makeBalls(): JointBalls {
  return new JointBalls(new RobotTree(urdf), new RobotSurface(true), groups);
}

/** From 2 m in front of the robot, 400 px a side. */
function makeCamera(): PerspectiveCamera {
  const camera = new PerspectiveCamera(40, 1, 0.1, 10);
  camera.position.set(2, 0, 0.1);
  camera.up.set(0, 0, 1);
  camera.lookAt(0, 0, 0.1);
  camera.updateMatrixWorld(true);
  return camera;
}

describe("JointBalls", () => {
  it("takes the nearest ball within a thumb's width, and none beyond", () => {
    const balls = makeBalls();
    const camera = makeCamera();
    const [x, y] = balls.places(camera, 400, 400)["left shoulder"]!;
    expect(balls.pick(x + 20, y + 10, camera, 400, 400)).toBe("left shoulder");
    expect(balls.pick(x + 200, y + 200, camera, 400, 400)).toBe("");
  });

  it("shows the arcs of the chosen group only, and makes them once", () => {
    const tree = new RobotTree(urdf);
    const balls = new JointBalls(tree, new RobotSurface(true), groups);
    const rings = (): Mesh[] => {
      const found: Mesh[] = [];
      tree.torso.traverse((object) => {
        if ((object as Mesh).geometry instanceof RingGeometry) found.push(object as Mesh);
      });
      return found;
    };
    const numShown = (): number => rings().filter((ring) => ring.parent!.visible).length;
    balls.select("head");
    balls.select("left shoulder");
    expect(numShown()).toBe(2);
    const made = rings();
    balls.select("head");
    balls.select("left shoulder");
    balls.select("");
    expect(numShown()).toBe(0);
    expect(rings()).toEqual(made);
    expect(made).toHaveLength(4);
  });
});
