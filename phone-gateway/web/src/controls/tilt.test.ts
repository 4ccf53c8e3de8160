import {describe, expect, it} from "vitest";
import {driveFromTilt, tiltFromAngles} from "./tilt";

describe("tilt", () => {
  // Held at 40 degrees, as one holds a phone to look at it.
  const neutral = tiltFromAngles(40, 0, 0);

  it("does nothing while the phone is held still, however it is held", () => {
    for (const [beta, gamma, angle] of [[40, 0, 0], [70, 10, 0], [5, -40, 90], [0, 45, 270]] as const) {
      const held = tiltFromAngles(beta, gamma, angle);
      expect(driveFromTilt(held, held)).toEqual({x: 0, y: 0, theta: 0});
    }
  });
  it("walks ahead when the upper edge goes down, and back when it comes up", () => {
    expect(driveFromTilt(tiltFromAngles(20, 0, 0), neutral).x).toBeGreaterThan(0.5);
    expect(driveFromTilt(tiltFromAngles(60, 0, 0), neutral).x).toBeLessThan(-0.5);
  });
  it("turns right, which is negative, when the right edge goes down", () => {
    expect(driveFromTilt(tiltFromAngles(40, 25, 0), neutral).theta).toBeLessThan(-0.3);
  });
  it("means the same in landscape", () => {
    // Turned to the left by 90 degrees: the phone's right edge is the page's upper edge.
    const held = tiltFromAngles(0, -40, 90);
    expect(driveFromTilt(tiltFromAngles(0, -20, 90), held).x).toBeGreaterThan(0.5);
    expect(driveFromTilt(tiltFromAngles(20, -40, 90), held).theta).toBeLessThan(-0.2);
  });
  it("never asks for more than full speed", () => {
    expect(driveFromTilt(tiltFromAngles(-80, 0, 0), neutral).x).toBe(1);
  });
});
