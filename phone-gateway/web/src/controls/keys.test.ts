import {describe, expect, it} from "vitest";
import {driveFromKeys, pressedButtons, stickFromKeys, sticksFromPad} from "./keys";

const keys = (...codes: string[]) => new Set(codes);

describe("driveFromKeys", () => {
  it("walks with WASD and turns with the arrows", () => {
    expect(driveFromKeys(keys("KeyW", "ArrowLeft"), false)).toEqual({x: 1, y: 0, theta: 1});
    expect(driveFromKeys(keys("KeyA"), false)).toEqual({x: 0, y: 1, theta: 0});
  });
  it("cancels opposite keys and stays held", () => {
    expect(driveFromKeys(keys("KeyW", "KeyS"), false)).toEqual({x: 0, y: 0, theta: 0});
  });
  it("goes slowly with Shift", () => {
    expect(driveFromKeys(keys("KeyW"), true)!.x).toBeCloseTo(0.4, 9);
  });
  it("is silent for other keys", () => {
    expect(driveFromKeys(keys("KeyX"), false)).toBeNull();
    expect(stickFromKeys(keys(), false)).toBeNull();
  });
  it("moves a joint to where the arrow points", () => {
    expect(stickFromKeys(keys("ArrowRight"), false)).toEqual({up: 0, right: 1});
    expect(stickFromKeys(keys("KeyA", "KeyW"), false)).toEqual({up: 1, right: -1});
  });
});

describe("a gamepad", () => {
  it("walks ahead when the left stick is pushed away", () => {
    expect(sticksFromPad([0, -1, 0, 0]).walk.up).toBeCloseTo(1, 9);
  });
  it("does nothing while its sticks only tremble", () => {
    expect(sticksFromPad([0.05, -0.08, 0.1])).toEqual({walk: {right: 0, up: 0}, turn: {right: 0, up: 0}});
  });
  it("reports a button once", () => {
    const before: boolean[] = [];
    const down = [false, true];
    expect(pressedButtons(down, before)).toEqual(["stop"]);
    expect(pressedButtons(down, before)).toEqual([]);
    expect(pressedButtons([false, false], before)).toEqual([]);
    expect(pressedButtons(down, before)).toEqual(["stop"]);
  });
});
