import {create} from "@bufbuild/protobuf";
import {PerspectiveCamera, RingGeometry} from "three";
import type {Mesh, Vector3} from "three";
import {describe, expect, it} from "vitest";
import {readUrdf} from "../../test_support/nao_files";
import {JointGroupSchema} from "../protocol/generated/remote_pb";
import {kAxes, kAxisColors} from "./joint_axes";
import {JointBalls} from "./joint_balls";
import {RobotSurface} from "./robot_surface";
import {RobotTree} from "./robot_tree";

const urdf = readUrdf(new URL("../../../../data/robots/nao", import.meta.url).pathname);
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

/** What the three kinds of colour-blind eyes make of linear red, green and blue. Source: G. M. Machado et al., "A
 * physiologically-based model for simulation of color vision deficiency", IEEE TVCG 15 (6), 2009, severity 1.0. */
const kColorBlindness: Record<string, readonly number[][]> = {
  protanopia: [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  deuteranopia: [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
  tritanopia: [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
};

/** CIELAB (D65) of an sRGB colour as such eyes see it. Source: IEC 61966-2-1, CIE 15:2004. */
function labOf(color: number, eyes: readonly number[][]): [number, number, number] {
  const linear = [color >> 16, (color >> 8) & 255, color & 255].map((byte) =>
      byte <= 10 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4);
  const dot = (row: readonly number[], v: readonly number[]): number =>
      row.reduce((sum, share, i) => sum + share * v[i]!, 0);
  const seen = eyes.map((row) => Math.min(1, Math.max(0, dot(row, linear))));
  const [x, y, z] = [[0.4339, 0.3762, 0.1899], [0.2126, 0.7152, 0.0722], [0.0177, 0.1095, 0.8729]]
      .map((row) => Math.cbrt(dot(row, seen))) as [number, number, number];
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

describe("the axes' colours", () => {
  for (const [name, eyes] of Object.entries(kColorBlindness)) {
    it(`are distinguishable with ${name}`, () => {
      const labs = kAxes.map((axis) => labOf(kAxisColors[axis], eyes));
      for (const [i, a] of labs.entries()) {
        // Differences of some 2.3 are just noticed side by side; arcs are thin and apart.
        for (const b of labs.slice(i + 1)) expect(Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2])).toBeGreaterThan(20);
      }
    });
  }
});

describe("JointBalls", () => {
  it("selects the nearest ball within the tap radius, and none beyond", () => {
    const balls = makeBalls();
    const camera = makeCamera();
    const canvas = {onCanvas: (point: Vector3): [number, number] => {
      const {x, y} = point.project(camera);
      return [200 + 200 * x, 200 - 200 * y];
    }};
    const [x, y] = new Map(balls.places(canvas)).get("left shoulder")!;
    expect(balls.pick(x + 20, y + 10, canvas)).toBe("left shoulder");
    expect(balls.pick(x + 200, y + 200, canvas)).toBe("");
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
