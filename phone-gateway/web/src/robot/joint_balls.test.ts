import {create} from "@bufbuild/protobuf";
import {BufferGeometry, PerspectiveCamera} from "three";
import {afterEach, describe, expect, it, vi} from "vitest";
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

afterEach(() => vi.restoreAllMocks());

describe("JointBalls", () => {
  it("takes the nearest ball within a thumb's width, and none beyond", () => {
    const balls = makeBalls();
    const camera = makeCamera();
    const [x, y] = balls.places(camera, 400, 400)["left shoulder"]!;
    expect(balls.pick(x + 20, y + 10, camera, 400, 400)).toBe("left shoulder");
    expect(balls.pick(x + 200, y + 200, camera, 400, 400)).toBe("");
  });

  it("gives back what the arcs of the last choice took from the graphics chip", () => {
    const dispose = vi.spyOn(BufferGeometry.prototype, "dispose");
    const balls = makeBalls();
    balls.select("head");
    expect(dispose).not.toHaveBeenCalled();
    // A ring and a hand for each of two axes; the ball that all share stays.
    balls.select("left shoulder");
    expect(dispose).toHaveBeenCalledTimes(4);
    balls.select("");
    expect(dispose).toHaveBeenCalledTimes(8);
  });
});
