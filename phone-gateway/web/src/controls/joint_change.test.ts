import {create} from "@bufbuild/protobuf";
import {afterEach, beforeEach, describe, expect, it, vi} from "vitest";
import {readJointGroups} from "../../test_support/nao_files";
import {JointGroupSchema} from "../protocol/generated/remote_pb";
import {changeFromStick, kJointRate} from "./joint_change";
import type {JointChange} from "./joint_change";
import {JointDriver, kJointPeriodMs} from "./joint_driver";

const groups = readJointGroups(new URL("../../../../data/robots/nao", import.meta.url).pathname)
    .map((group) => create(JointGroupSchema, group));
const group = (name: string) => groups.find((one) => one.name === name)!;

describe("changeFromStick", () => {
  it("lifts when the joystick moves up", () => {
    expect(changeFromStick(group("head"), {right: 0, up: 1}, false, 0.1).pitch)
        .toBeCloseTo(-0.1 * kJointRate, 9);
  });
  it("turns to where the joystick points, seen from behind and from the front", () => {
    expect(changeFromStick(group("head"), {right: 1, up: 0}, false, 0.1).yaw).toBeLessThan(0);
    expect(changeFromStick(group("head"), {right: 1, up: 0}, true, 0.1).yaw).toBeGreaterThan(0);
  });
  it("opens a hand upwards", () => {
    expect(changeFromStick(group("left hand"), {right: 0, up: 1}, false, 0.1).pitch).toBeGreaterThan(0);
  });
  it("leaves alone what the group does not have", () => {
    for (const one of groups) {
      const {yaw, pitch, roll} = changeFromStick(one, {right: 0.7, up: 0.7}, false, 0.1);
      expect(yaw !== 0, one.name).toBe(one.yawJoint !== "");
      expect(pitch !== 0, one.name).toBe(one.pitchJoint !== "");
      expect(roll).toBe(0);
    }
  });
});

describe("JointDriver", () => {
  let sent: JointChange[];
  let driver: JointDriver;
  beforeEach(() => {
    vi.useFakeTimers();
    sent = [];
    driver = new JointDriver((change) => sent.push(change));
    driver.group = group("left shoulder");
  });
  afterEach(() => {
    vi.useRealTimers();
  });

  it("turns at the same speed however long the joystick is held", () => {
    driver.setStick({right: 0, up: 1});
    vi.advanceTimersByTime(10 * kJointPeriodMs - 1);
    driver.setStick(null);
    vi.advanceTimersByTime(1000);
    const turned = sent.reduce((sum, {pitch}) => sum + pitch!, 0);
    expect(turned).toBeCloseTo(-kJointRate * 10 * kJointPeriodMs / 1000, 6);
  });

  it("moves both sides when asked to", () => {
    driver.turn("roll", 0.2);
    driver.isMirrored = true;
    driver.turn("roll", 0.2);
    expect(sent.map(({bothSides}) => bothSides)).toEqual([false, true]);
    expect(sent[1]).toMatchObject({group: "left shoulder", roll: 0.2});
  });

  it("sends nothing where nothing is chosen", () => {
    driver.group = null;
    driver.setStick({right: 1, up: 1});
    driver.turn("roll", 1);
    expect(sent).toEqual([]);
    driver.setStick(null);
  });
});
