import {create} from "@bufbuild/protobuf";
import {describe, expect, it} from "vitest";
import * as pb from "../protocol/generated/remote_pb";
import {Store} from "../store";
import type {AppState} from "../store";
import {momentOf} from "./deck";

const moment = (patch: Partial<AppState>) => {
  const store = new Store();
  store.set(patch);
  return momentOf(store.get());
};
const state = (mode: pb.Mode, posture = "") => create(pb.StateSchema, {mode, posture});
const postures = new Map([["Flat", {family: "lying-back", angles: {}}], ["Up", {family: "standing", angles: {}}]]);
const vision = create(pb.VisionSchema, {ball: {x: 1, y: 0, age: 0.1}});

describe("the moment", () => {
  it("is lying after a fall, and in a posture whose family lies, whatever its name", () => {
    expect(moment({state: state(pb.Mode.FALLEN)})).toBe("lying");
    expect(moment({state: state(pb.Mode.HOLDING, "Flat"), postures})).toBe("lying");
    expect(moment({state: state(pb.Mode.HOLDING, "Up"), postures})).toBe("standing");
  });
  it("is the ball's where one is seen by a robot that plays", () => {
    const playState = create(pb.PlayStateSchema, {});
    expect(moment({vision, playState})).toBe("ball");
    expect(moment({vision})).toBe("standing");
    expect(moment({playState})).toBe("standing");
  });
  it("stays the ball's while the robot acts by itself, with the ball out of sight", () => {
    expect(moment({playState: create(pb.PlayStateSchema, {behavior: pb.Play_Behavior.SCORE})})).toBe("ball");
  });
  it("is relaxed without stiffness, before anything else", () => {
    expect(moment({state: state(pb.Mode.RELAXED, "Flat"), postures})).toBe("relaxed");
  });
});
