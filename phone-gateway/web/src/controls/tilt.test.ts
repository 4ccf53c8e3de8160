import {Vector3} from "three";
import {describe, expect, it, vi} from "vitest";
import {driveFromTilt, tiltFromAngles} from "./tilt";
import {pageAngle, TiltSensor} from "./tilt_sensor";

const kDegree = Math.PI / 180;

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
  it.each([["ahead", 1], ["back", -1]])("keeps its sign and is not released from 80 to 110 degrees %s", (_, sign) => {
    // Held flat, then turned about the page's right by the angle: gravity in the page's axes.
    const pitched = (degrees: number) => new Vector3(0, sign * Math.sin(degrees * kDegree), -Math.cos(degrees * kDegree));
    for (let angle = 80; angle <= 110; ++angle) expect(driveFromTilt(pitched(angle), pitched(0)).x).toBe(sign);
    expect(Math.sign(driveFromTilt(pitched(110), pitched(80)).x)).toBe(sign);
  });
  it.each([["right", 1], ["left", -1]])("turns on to the %s beyond the vertical", (_, sign) => {
    const rolled = (degrees: number) => new Vector3(sign * Math.sin(degrees * kDegree), 0, -Math.cos(degrees * kDegree));
    for (let angle = 80; angle <= 110; ++angle) expect(driveFromTilt(rolled(angle), rolled(0)).theta).toBe(-sign);
    // The page's right edge is 20 degrees from pointing down: 30 more go on into the same direction.
    expect(Math.sign(driveFromTilt(rolled(100), rolled(70)).theta)).toBe(-sign);
  });
  it("stops when the phone is turned over", () => {
    for (const beta of [-140, -130, -110, 180]) {
      expect(driveFromTilt(tiltFromAngles(beta, 0, 0), neutral)).toEqual({x: 0, y: 0, theta: 0});
    }
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
  it("tells when the page turns, before the first tilt in other axes", async () => {
    const page = new EventTarget();
    vi.stubGlobal("window", Object.assign(page, {isSecureContext: true, DeviceOrientationEvent: class {}}));
    vi.stubGlobal("DeviceOrientationEvent", class {});
    vi.stubGlobal("screen", {orientation: {angle: 0}});
    const sensor = new TiltSensor();
    const tilt = () => page.dispatchEvent(Object.assign(new Event("deviceorientation"), {beta: 40, gamma: 0}));
    const isOn = sensor.switchOn();
    tilt();
    expect(await isOn).toBe(true);
    const told: string[] = [];
    sensor.onTurn = () => told.push("turned");
    sensor.onChange = () => told.push("tilt");
    tilt();
    vi.stubGlobal("screen", {orientation: {angle: 90}});
    tilt();
    expect(told).toEqual(["tilt", "turned", "tilt"]);
    vi.unstubAllGlobals();
  });
  it("is refused where the browser refuses, and where no tilt comes", async () => {
    vi.useFakeTimers();
    const page = new EventTarget();
    const sensorOf = (permission: object) => {
      vi.stubGlobal("window", Object.assign(page, {isSecureContext: true, DeviceOrientationEvent: permission}));
      vi.stubGlobal("DeviceOrientationEvent", permission);
      return new TiltSensor();
    };
    expect(await sensorOf({requestPermission: () => Promise.resolve("denied")}).switchOn()).toBe(false);
    expect(await sensorOf({requestPermission: () => Promise.reject(new Error("no tap"))}).switchOn()).toBe(false);
    const isOn = sensorOf({}).switchOn();
    // What computers without a sensor send.
    page.dispatchEvent(Object.assign(new Event("deviceorientation"), {beta: null, gamma: null}));
    await vi.advanceTimersByTimeAsync(1000);
    expect(await isOn).toBe(false);
    vi.useRealTimers();
    vi.unstubAllGlobals();
  });
  it("never asks for more than full speed", () => {
    expect(driveFromTilt(tiltFromAngles(-80, 0, 0), neutral).x).toBe(1);
  });
});
