import {create} from "@bufbuild/protobuf";
import {afterEach, beforeEach, describe, expect, it, vi} from "vitest";
import {Commander} from "./commander";
import {Messages} from "./messages";
import type {UseCase} from "./protocol/codec";
import {ControlSchema, ErrorCode, Notice_Component, Notice_Kind, Notice_Status, NoticeSchema, ResponseSchema, RobotDescriptionSchema} from "./protocol/generated/remote_pb";
import type {Response} from "./protocol/generated/remote_pb";
import {Store} from "./store";
import {setLanguage} from "./text/texts";

const mine = create(ControlSchema, {driverId: 7, driverName: "Ana", isMine: true});
const bens = create(ControlSchema, {driverId: 8, driverName: "Ben", isMine: false});
const free = create(ControlSchema, {});

describe("Commander", () => {
  let store: Store;
  let asked: UseCase["case"][];
  let answer: (useCase: UseCase) => Partial<Response>;
  let isCongested: boolean;
  let commander: Commander;
  let refusals: number;

  beforeEach(() => {
    vi.useFakeTimers();
    setLanguage("en");
    store = new Store();
    store.set({control: free});
    asked = [];
    refusals = 0;
    isCongested = false;
    answer = ({case: name}) => name === "takeControl" ? {result: {case: "control", value: mine}} : {};
    commander = new Commander({
      request: (useCase) => {
        asked.push(useCase.case);
        const {error = ErrorCode.OK, message = "", result} = answer(useCase);
        return Promise.resolve(create(ResponseSchema, {error, message, result}));
      },
      isCongested: () => isCongested,
    }, store, new Messages(store));
    commander.onRefusal = () => refusals++;
  });
  afterEach(() => {
    vi.useRealTimers();
  });

  const texts = () => store.get().messages.map(({text}) => text);

  it("takes control with the first command if it is free, and once for two simultaneous commands", async () => {
    await Promise.all([commander.command({case: "walkTurn", value: {vx: 1}}),
                       commander.command({case: "goToPosture", value: {posture: "Stand"}})]);
    expect(asked).toEqual(["takeControl", "walkTurn", "goToPosture"]);
    expect(store.get().control?.isMine).toBe(true);
  });

  it("lets a motion win over what is held, whichever button begins it", async () => {
    const released: string[] = [];
    commander.onMotion = () => released.push("held controls");
    for (const motion of [{case: "goToPosture", value: {posture: "Stand"}}, {case: "doAction", value: {action: "kick-left"}}, {case: "moveTo", value: {x: 1}}] as const) {
      await commander.command(motion);
    }
    expect(released).toHaveLength(3);
    commander.stream({case: "walkTurn", value: {vx: 1}});
    commander.stream({case: "changeJoints", value: {group: "head", yaw: 0.1, pitch: 0, roll: 0}});
    expect(released).toHaveLength(3);
  });

  it("sends no command while the operator lets it watch only, and says so", async () => {
    store.set({control: create(ControlSchema, {isMuted: true})});
    expect(await commander.command({case: "goToPosture", value: {posture: "Stand"}})).toBe(false);
    expect(asked).toEqual([]);
    expect(texts()).toEqual(["You may only watch"]);
  });

  it("keeps its own control when another robot is refused", async () => {
    store.set({control: mine, robot: create(RobotDescriptionSchema, {name: "NAO1"})});
    answer = () => ({error: ErrorCode.CONTROL_TAKEN, result: {case: "control", value: bens}});
    expect(await commander.takeControl("NAO2")).toBe(false);
    expect(store.get().control?.isMine).toBe(true);
    expect(texts()).toEqual(["Ben drives"]);
  });

  it("sends no command while another client drives, and names it", async () => {
    store.set({control: bens});
    expect(await commander.command({case: "goToPosture", value: {posture: "Stand"}})).toBe(false);
    expect(asked).toEqual([]);
    expect(texts()).toEqual(["Ben drives"]);
  });

  it("stops the robot also without control", async () => {
    store.set({control: bens});
    expect(await commander.stop()).toBe(true);
    expect(asked).toEqual(["stop"]);
  });

  it("shows a refusal in the gateway's words, once however often it comes", async () => {
    store.set({control: mine});
    answer = () => ({error: ErrorCode.TOO_MANY_REQUESTS, message: "Too fast."});
    for (let i = 0; i < 20; i++) {
      await commander.command({case: "walkTurn", value: {vx: 1}});
      vi.advanceTimersByTime(100);
    }
    expect(texts()).toEqual(["Too fast."]);
    expect(refusals).toBe(1);
    vi.advanceTimersByTime(6000);
    expect(texts()).toEqual([]);
  });

  it("requests control again after the gateway has withdrawn it", async () => {
    store.set({control: mine});
    answer = () => ({error: ErrorCode.NO_CONTROL, message: "You do not drive."});
    await commander.command({case: "goToPosture", value: {posture: "Stand"}});
    answer = ({case: name}) => name === "takeControl" ? {result: {case: "control", value: mine}} : {};
    expect(await commander.command({case: "goToPosture", value: {posture: "Stand"}})).toBe(true);
    expect(asked).toEqual(["goToPosture", "takeControl", "goToPosture"]);
  });

  it("leaves out what is repeated anyway while the link is behind", () => {
    store.set({control: mine});
    isCongested = true;
    commander.stream({case: "walkTurn", value: {vx: 1}});
    expect(asked).toEqual([]);
  });

  it("never leaves out the end of a walk", async () => {
    store.set({control: mine});
    isCongested = true;
    commander.stream({case: "walkTurn", value: {}});
    await vi.advanceTimersByTimeAsync(0);
    expect(asked).toEqual(["walkTurn"]);
  });

  it("shows failed and refused commands, not completed ones", () => {
    const outcome = (value: Notice_Status, message: string) => commander.notice(create(
        NoticeSchema, {kind: Notice_Kind.COMMAND_RESULT, status: value, message}));
    outcome(Notice_Status.ACCEPTED, "a");
    outcome(Notice_Status.DONE, "b");
    outcome(Notice_Status.INTERRUPTED, "c");
    outcome(Notice_Status.REFUSED, "It would tip over.");
    outcome(Notice_Status.FAILED, "It fell.");
    expect(texts()).toEqual(["It would tip over.", "It fell."]);
  });

  it("names the client that took control", () => {
    store.set({control: mine});
    commander.notice(create(NoticeSchema, {kind: Notice_Kind.CONTROL_CHANGED, control: bens}));
    expect(texts()).toEqual(["Ben drives now."]);
    expect(store.get().control?.driverName).toBe("Ben");
  });

  it("lists the unavailable components", () => {
    const change = (component: Notice_Component, isAvailable: boolean) => commander.notice(create(
        NoticeSchema, {kind: Notice_Kind.COMPONENT_CHANGED, component, isAvailable}));
    change(Notice_Component.CAMERA, false);
    change(Notice_Component.MOTION, false);
    change(Notice_Component.CAMERA, true);
    expect(store.get().unavailableComponents).toEqual([Notice_Component.MOTION]);
  });

  it("translates the gateway's error codes", async () => {
    store.set({control: mine});
    await setLanguage("de");
    commander.notice(create(NoticeSchema, {kind: Notice_Kind.COMPONENT_CHANGED,
                                          component: Notice_Component.MOTION, message: "away"}));
    for (const error of [ErrorCode.STOPPED, ErrorCode.CONTROL_TAKEN, ErrorCode.ROBOT_UNAVAILABLE]) {
      answer = () => ({error, message: "in English", result: {case: "control", value: bens}});
      await commander.command({case: "walkTurn", value: {vx: 1}});
      store.set({control: mine});
    }
    setLanguage("en");
    expect(texts()).toEqual(["Das Bewegungsprogramm antwortet nicht.", "Gestoppt: erst loslassen, dann weitergehen.",
                             "Ben steuert"]);
  });
});
