import {create} from "@bufbuild/protobuf";
import {describe, expect, it} from "vitest";
import {StateSchema, Vision_Detection_Kind, VisionSchema} from "../protocol/generated/remote_pb";
import {ballOf, ellipseOf, isBallAt, isBallInImage, toOdometry} from "./seen";

const vision = create(VisionSchema, {
  detections: [{kind: Vision_Detection_Kind.BALL, box: [0.4, 0.5, 0.5, 0.6]},
               {kind: Vision_Detection_Kind.ROBOT, box: [0, 0, 0.2, 0.9]}],
  ball: {x: 1, y: -0.5, age: 0.2},
});

describe("ellipseOf", () => {
  it("has two standard deviations along the axes of the covariance", () => {
    const along = ellipseOf([0.04, 0, 0.01])!;
    expect(along.a).toBeCloseTo(0.4);
    expect(along.b).toBeCloseTo(0.2);
    expect(along.angle).toBeCloseTo(0);
    expect(ellipseOf([0.025, 0.015, 0.025])!.angle).toBeCloseTo(Math.PI / 4);
    expect(ellipseOf([0.025, 0.015, 0.025])!.a).toBeCloseTo(0.4);
  });
  it("is unknown without a covariance", () => expect(ellipseOf([])).toBeNull());
});

it("turns what is ahead of the torso into the odometry frame", () => {
  const half = Math.SQRT1_2;
  const state = create(StateSchema, {torsoOrientation: [half, 0, 0, half], torsoPosition: [1, 2, 0.3]});
  const place = toOdometry({x: 1, y: 0.5}, state);
  expect(place.x).toBeCloseTo(0.5);
  expect(place.y).toBeCloseTo(3);
});

it("finds the ball under a finger in the image and on the ground", () => {
  expect(isBallInImage(vision, 0.45, 0.55)).toBe(true);
  expect(isBallInImage(vision, 0.53, 0.62)).toBe(true);
  expect(isBallInImage(vision, 0.1, 0.5)).toBe(false);
  expect(isBallInImage(null, 0.45, 0.55)).toBe(false);
  expect(isBallAt(vision, {x: 1.1, y: -0.4})).toBe(true);
  expect(isBallAt(vision, {x: 1.5, y: -0.4})).toBe(false);
});

it("forgets a ball that was not seen for long", () => {
  expect(ballOf(vision)?.x).toBe(1);
  expect(ballOf(create(VisionSchema, {ball: {x: 1, y: 0, age: 9}}))).toBeNull();
  expect(ballOf(null)).toBeNull();
});
