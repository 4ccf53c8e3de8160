import {create} from "@bufbuild/protobuf";
import {describe, expect, it} from "vitest";
import {Notice_Component, RobotList_RobotSchema} from "../protocol/generated/remote_pb";
import * as pb from "../protocol/generated/remote_pb";
import {Store} from "../store";
import type {AppState, Problem} from "../store";
import {causeOf} from "./cause";

const cause = (patch: Partial<AppState>) => {
  const store = new Store();
  store.set({phase: "connected", robot: create(pb.RobotDescriptionSchema), ...patch});
  return causeOf(store.get());
};

describe("a cause", () => {
  it.each([["wrong-version", "reload", "Reload"], ["wrong-token", "form", "Type the code"], ["not-a-robot", "form", "Type the code"],
           ["too-many", "retry", "Try now"], ["unreachable", "retry", "Try now"], ["silent", "retry", "Try now"],
           ["closed", "retry", "Try now"]] as const)("of the problem %s has the button %s", (problem: Problem, remedy, button) => {
    const found = cause({phase: "waiting", problem});
    expect(found).toMatchObject({remedy, button});
    expect(found?.text.endsWith(".")).toBe(true);
  });
  it("is there only while something is wrong", () => {
    expect(cause({})).toBeNull();
    expect(cause({phase: "connecting"})).toBeNull();
    expect(cause({phase: "waiting", problem: "unreachable", robot: null})).toBeNull();
    expect(cause({unavailableComponents: [Notice_Component.CAMERA]})).toBeNull();
  });
  it("offers another robot where there is one", () => {
    const unavailableComponents = [Notice_Component.MOTION];
    expect(cause({unavailableComponents})).toMatchObject({remedy: null, button: ""});
    const robots = ["A", "B"].map((name) => create(RobotList_RobotSchema, {name}));
    expect(cause({unavailableComponents, robots})).toMatchObject({remedy: "robots"});
  });
  it("is also that another client waits, for the driver alone", () => {
    const control = (isMine: boolean) => create(pb.ControlSchema, {isMine, driverId: 7, nextId: 8, nextName: "Ben"});
    expect(cause({control: control(true)})).toMatchObject({remedy: "hand-over", button: "Hand over to Ben"});
    expect(cause({control: control(false)})).toBeNull();
  });
});
