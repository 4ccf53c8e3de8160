import {describe, expect, it} from "vitest";
import {addDrives, driveFromSticks, kDeadZone, stickValue} from "./stick";

const none = {right: 0, up: 0};

describe("stickValue", () => {
  it("gives nothing in the dead zone", () => {
    expect(stickValue(0, 0, 50)).toEqual(none);
    expect(stickValue(50 * kDeadZone * 0.99, 0, 50)).toEqual(none);
  });

  it("reaches full speed at the rim and no more beyond", () => {
    expect(stickValue(0, -50, 50).up).toBeCloseTo(1, 9);
    expect(stickValue(300, 0, 50).right).toBeCloseTo(1, 9);
  });

  it("is finer near the middle", () => {
    expect(stickValue(25, 0, 50).right).toBeLessThan(0.4);
  });

  it("never leaves the unit circle", () => {
    const {right, up} = stickValue(80, 80, 50);
    expect(Math.hypot(right, up)).toBeCloseTo(1, 9);
  });
});

describe("driveFromSticks", () => {
  it("walks forward when the joystick moves up", () => {
    expect(driveFromSticks({right: 0, up: 1}, none)).toEqual({x: 1, y: 0, theta: 0});
  });
  it("walks to the right, which is negative y, when the joystick moves right", () => {
    expect(driveFromSticks({right: 1, up: 0}, none)).toEqual({x: 0, y: -1, theta: 0});
  });
  it("turns right, which is negative, when the other joystick moves right", () => {
    expect(driveFromSticks(none, {right: 0.5, up: 0})).toEqual({x: 0, y: 0, theta: -0.5});
  });
});

describe("addDrives", () => {
  it("adds sources and cuts at full speed", () => {
    expect(addDrives([{x: 0.8, y: 0, theta: -1}, {x: 0.8, y: 0.1, theta: 0.25}]))
        .toEqual({x: 1, y: 0.1, theta: -0.75});
    expect(addDrives([])).toEqual({x: 0, y: 0, theta: 0});
  });
});
