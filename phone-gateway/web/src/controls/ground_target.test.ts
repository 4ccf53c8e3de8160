import {describe, expect, it} from "vitest";
import {walkTo} from "./ground_target";

describe("walkTo", () => {
  it("gives the spot as the robot sees it", () => {
    // The robot stands at (1, 2) and looks along y; the spot is 1 m ahead of it and 0.5 m to its left.
    const pose = walkTo({x: 0.5, y: 3}, {x: 1, y: 2}, Math.PI / 2)!;
    expect(pose.x).toBeCloseTo(1, 9);
    expect(pose.y).toBeCloseTo(0.5, 9);
    expect(pose.theta).toBeCloseTo(Math.atan2(0.5, 1), 9);
  });
  it("keeps the heading on a short way", () => {
    expect(walkTo({x: -0.2, y: 0.1}, {x: 0, y: 0}, 0)!.theta).toBe(0);
  });
  it("refuses what MoveTo would refuse", () => {
    expect(walkTo({x: 11, y: 0}, {x: 0, y: 0}, 0)).toBeNull();
  });
});
