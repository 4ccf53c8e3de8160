import {readFileSync} from "node:fs";
import {create} from "@bufbuild/protobuf";
import {beforeEach, describe, expect, it} from "vitest";
import {Commander} from "../commander";
import {Messages} from "../messages";
import {encodeRequest} from "../protocol/codec";
import type {UseCase} from "../protocol/codec";
import * as pb from "../protocol/generated/remote_pb";
import {Store} from "../store";
import {setLanguage} from "../text/texts";
import {HandGuide} from "./hand_guide";
import {addPose, kEmptyDraft} from "./motion_draft";
import {kMaxFileBytes, MotionHost} from "./motion_host";

type Answer = Partial<pb.Response>;
const draft = addPose(kEmptyDraft, {A: 1}, []);
const motion = create(pb.MotionSchema, {name: "wave", keyframes: [{duration: 1}]});
const fault: Answer = {
  error: pb.ErrorCode.INVALID_ARGUMENT, message: "A is too fast.", reasonCode: "unknown",
  result: {case: "motionReport", value: create(pb.MotionReportSchema, {keyframe: 0, repair: "slowed-down", repaired: motion})},
};

describe("the largest motion file", () => {
  it("is the largest that the gateway and the robot's host take", () => {
    const constant = (path: string, name: string) => {
      const text = readFileSync(new URL(`../../../../${path}`, import.meta.url), "utf8");
      return Number(new RegExp(`${name} = (\\d+);`).exec(text)?.[1]);
    };
    const taken = Math.min(constant("phone-gateway/server/core/motion_messages.cpp", "kMaxTextBytes"),
                           constant("daemons/motion-files/motion_text.h", "kMaxMotionTextBytes"));
    const file = create(pb.MotionFileSchema, {yaml: "x".repeat(kMaxFileBytes)});
    const request = encodeRequest(0xffffffff, {case: "saveMotion", value: create(pb.SaveMotionSchema, {motion: file, replace: true})});
    expect(kMaxFileBytes).toBeLessThanOrEqual(taken);
    expect(kMaxFileBytes).toBeGreaterThan(0.99 * taken);
    expect(request.length).toBeLessThanOrEqual(constant("phone-gateway/protocol/framing.h", "kMaxRequestBytes"));
  });
});

describe("MotionHost", () => {
  let store: Store;
  let asked: UseCase[];
  let answer: (useCase: UseCase) => Answer | Promise<Answer>;
  let host: MotionHost;
  let guide: HandGuide;
  const cases = () => asked.map((one) => one.case);

  beforeEach(() => {
    setLanguage("en");
    store = new Store();
    store.set({control: create(pb.ControlSchema, {driverId: 7, isMine: true})});
    asked = [];
    answer = () => ({});
    const commander = new Commander({
      async request(useCase) {
        asked.push(useCase);
        const {error = pb.ErrorCode.OK, message = "", reasonCode = "", result} = await answer(useCase);
        return create(pb.ResponseSchema, {error, message, reasonCode, result});
      },
      isCongested: () => false,
    }, store, new Messages(store));
    guide = new HandGuide(store, commander);
    host = new MotionHost(store, commander, () => guide.stiffen());
  });

  it("plays a draft under a temporary name, once it was found safe", async () => {
    await host.play(draft);
    expect(cases()).toEqual(["saveMotion", "doAction"]);
    const [save, act] = asked;
    expect(save).toMatchObject({value: {replace: true, motion: {motion: {name: "_draft"}}}});
    expect(act).toMatchObject({value: {action: "_draft"}});
    expect(store.get().isCheckingMotion).toBe(false);
  });

  it("plays nothing that is not safe, and keeps the fault and the repaired motion", async () => {
    answer = () => fault;
    await host.play(draft);
    expect(cases()).toEqual(["saveMotion"]);
    expect(store.get().motionFault).toEqual({keyframe: 0, text: "A is too fast.", repairText: "Use the slower motion",
                                             repaired: motion, isUpload: false});
    expect(store.get().messages).toEqual([]);
  });

  it("plays nothing if Stop was pressed while it was checked", async () => {
    answer = async () => {
      expect(store.get().isCheckingMotion).toBe(true);
      host.cancel();
      return {};
    };
    await host.play(draft);
    expect(cases()).toEqual(["saveMotion"]);
    expect(store.get().isCheckingMotion).toBe(false);
  });

  it("plays nothing if Stop was pressed while limp joints became stiff", async () => {
    store.set({relaxedGroups: ["arm"]});
    answer = ({case: name}) => {
      if (name === "changeJoints") host.cancel();
      return {};
    };
    await host.play(draft);
    expect(cases()).toEqual(["saveMotion", "changeJoints"]);
  });

  it("makes relaxed limbs stiff before it plays", async () => {
    await guide.toggle(["arm", "hand"]);
    expect(store.get().relaxedGroups).toEqual(["arm", "hand"]);
    asked.length = 0;
    await host.playSaved("wave");
    expect(cases()).toEqual(["changeJoints", "changeJoints", "doAction"]);
    expect(asked[0]).toMatchObject({value: {group: "arm", stiffness: 1}});
    expect(store.get().relaxedGroups).toEqual([]);
  });

  it("shows a refused stiffness once and leaves the other joints of the limb alone", async () => {
    answer = () => ({error: pb.ErrorCode.INVALID_ARGUMENT, message: "It stands on this leg."});
    await guide.toggle(["knee", "ankle"]);
    expect(cases()).toEqual(["changeJoints"]);
    expect(store.get().relaxedGroups).toEqual([]);
    expect(store.get().messages).toHaveLength(1);
  });

  it("tells that a name is in use without a message: the sheet asks whether to replace", async () => {
    answer = () => ({error: pb.ErrorCode.NAME_IN_USE, message: "taken"});
    expect(await host.save({motion}, false)).toBe("name-in-use");
    expect(store.get().messages).toEqual([]);
  });

  it("shows any other refusal", async () => {
    answer = () => ({error: pb.ErrorCode.INVALID_ARGUMENT, message: "No YAML."});
    expect(await host.save({yaml: "x"}, false)).toBe("refused");
    expect(store.get().messages[0]?.text).toBe("No YAML.");
  });

  it("returns what it deleted, so that it can be saved again", async () => {
    answer = ({case: name}) => name === "getMotion"
        ? {result: {case: "motionFile", value: create(pb.MotionFileSchema, {motion, yaml: "name: wave"})}} : {};
    expect((await host.remove("wave"))?.yaml).toBe("name: wave");
    expect(cases()).toEqual(["getMotion", "deleteMotion"]);
  });

  it("fetches a motion while another client drives", async () => {
    store.set({control: create(pb.ControlSchema, {driverId: 8, driverName: "Ben"})});
    answer = () => ({result: {case: "motionFile", value: create(pb.MotionFileSchema, {yaml: "name: wave"})}});
    expect((await host.get("wave"))?.yaml).toBe("name: wave");
    expect(cases()).toEqual(["getMotion"]);
  });

  it("deletes nothing that it could not fetch before", async () => {
    answer = () => ({error: pb.ErrorCode.INVALID_ARGUMENT, message: "There is none."});
    expect(await host.remove("wave")).toBeNull();
    expect(cases()).toEqual(["getMotion"]);
  });
});
