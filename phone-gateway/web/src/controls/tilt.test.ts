import {describe, expect, it, vi} from "vitest";
import {driveFromTilt, tiltFromAngles} from "./tilt";
import {pageAngle} from "./tilt_sensor";

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
  it("means the same beyond the vertical", () => {
    const upright = tiltFromAngles(80, 0, 0);
    expect(driveFromTilt(tiltFromAngles(110, 0, 0), upright).x).toBeLessThan(-0.5);
    expect(driveFromTilt(tiltFromAngles(60, 0, 0), upright).x).toBeGreaterThan(0.5);
    const lying = tiltFromAngles(-170, 0, 0);
    expect(driveFromTilt(tiltFromAngles(170, 0, 0), lying).x).toBeGreaterThan(0.5);
  });
  it("neither walks ahead nor back when a side edge points down", () => {
    for (const beta of [0, 10, 170, 180]) expect(driveFromTilt(tiltFromAngles(beta, 89, 0), neutral).x).toBe(0);
  });
  it("knows how the page is turned on a phone without screen.orientation", () => {
    vi.stubGlobal("screen", {});
    vi.stubGlobal("window", {orientation: -90});
    expect(pageAngle()).toBe(-90);
    vi.stubGlobal("screen", {orientation: {angle: 270}});
    expect(pageAngle()).toBe(270);
    vi.unstubAllGlobals();
  });
  it("never asks for more than full speed", () => {
    expect(driveFromTilt(tiltFromAngles(-80, 0, 0), neutral).x).toBe(1);
  });
});
