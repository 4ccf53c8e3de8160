/** Every source of a walk, and every way out of it: each ends in zero velocity, and nothing begins again by itself. */
import {create} from "@bufbuild/protobuf";
import {afterEach, beforeEach, describe, expect, it, vi} from "vitest";
import {Commander} from "../commander";
import {listenToLeaving} from "../leaving";
import {Messages} from "../messages";
import type {UseCase} from "../protocol/codec";
import {ControlSchema, ResponseSchema} from "../protocol/generated/remote_pb";
import {Store} from "../store";
import {say} from "../text/texts";
import {HeldControls} from "./held_controls";
import {JointDriver} from "./joint_driver";
import type {Drive} from "./stick";
import {driveFromTilt, tiltFromAngles} from "./tilt";
import {kSilenceMs, WalkSender} from "./walk_sender";
import type {DriveSource} from "./walk_sender";

const zero = {x: 0, y: 0, theta: 0};
const kFrameMs = 16;

/** A gamepad in a test's hands. */
const makePad = (index: number, axes: number[], mapping = "standard") => ({
  index, id: `pad ${index}`, mapping, axes, connected: true, timestamp: 1,
  buttons: Array.from({length: 17}, () => ({pressed: false})),
});

/** A key, as a page hears of it. */
const key = (type: string, code: string) => Object.assign(new Event(type, {cancelable: true}), {code, key: code});

describe("ways out of a walk", () => {
  let sent: Drive[];
  let walk: WalkSender;
  let held: HeldControls;
  let pads: (ReturnType<typeof makePad> | null)[];
  let page: EventTarget & {visibilityState: string};
  let told: string[];
  let store: Store;
  let commander: Commander;
  let asked: UseCase["case"][];

  beforeEach(() => {
    vi.useFakeTimers();
    pads = [];
    told = [];
    sent = [];
    page = Object.assign(new EventTarget(), {visibilityState: "visible"});
    vi.stubGlobal("document", page);
    vi.stubGlobal("window", new EventTarget());
    vi.stubGlobal("navigator", {getGamepads: () => pads});
    vi.stubGlobal("Element", class {});
    asked = [];
    store = new Store();
    store.set({phase: "connected", control: create(ControlSchema, {isMine: true})});
    const messages = new Messages(store);
    commander = new Commander({
      request: (useCase) => {
        asked.push(useCase.case);
        return Promise.resolve(create(ResponseSchema, {}));
      },
      isCongested: () => false,
    }, store, messages);
    walk = new WalkSender((drive) => sent.push(drive), Date.now);
    held = new HeldControls(store, walk, new JointDriver(() => {}), {
      pressed: () => {},
      unknown: (name) => told.push(name),
      silent: () => told.push("silent"),
    }, Date.now);
    held.listen(() => true);
    held.yieldTo(commander, messages);
    held.lockWhileStale(() => told.push("stale"));
    held.releaseScreen = () => walk.set("sticks", null);
    const release = () => void held.release();
    listenToLeaving({blurred: release, hidden: release, shown: () => {}});
  });
  afterEach(() => {
    vi.useRealTimers();
    vi.unstubAllGlobals();
  });

  /** @param source  what is done each frame while a person holds it. */
  const frames = (ms: number, source: () => void) => {
    for (let t = 0; t < ms; t += kFrameMs) {
      source();
      held.poll();
      vi.advanceTimersByTime(kFrameMs);
    }
  };

  const neutral = tiltFromAngles(40, 0, 0);
  const sources: Record<DriveSource, {begin: () => void; hold: () => void; release: () => void}> = {
    // As a touch and a mouse: the page hears of each change and of the end, but nothing in between.
    sticks: {begin: () => walk.set("sticks", {x: 1, y: 0, theta: 0}), hold: () => {}, release: () => walk.set("sticks", null)},
    keys: {begin: () => page.dispatchEvent(key("keydown", "KeyW")), hold: () => {},
           release: () => page.dispatchEvent(key("keyup", "KeyW"))},
    gamepad: {begin: () => pads[0] = makePad(0, [0, -1, 0]), hold: () => pads[0] && pads[0].timestamp++,
              release: () => pads[0]!.axes = [0, 0, 0]},
    tilt: {begin: () => {}, hold: () => walk.set("tilt", driveFromTilt(tiltFromAngles(10, 0, 0), neutral)),
           release: () => walk.set("tilt", null)},
  };
  const leave: Record<string, () => void> = {
    "another window has the focus": () => window.dispatchEvent(new Event("blur")),
    "the page is hidden": () => {
      page.visibilityState = "hidden";
      page.dispatchEvent(new Event("visibilitychange"));
    },
    "the page is left": () => window.dispatchEvent(new Event("pagehide")),
    "stop is pressed": () => held.release(),
    "the link is lost, and is back": () => {
      store.set({phase: "waiting"});
      store.set({phase: "connected"});
    },
    "a posture is tapped": () => void commander.command({case: "goToPosture", value: {posture: "Stand"}}),
    "a kick is tapped": () => void commander.command({case: "doAction", value: {action: "kick-left"}}),
  };

  describe.each(Object.entries(sources))("from %s", (name, {begin, hold, release}) => {
    beforeEach(() => {
      begin();
      frames(300, hold);
      expect(sent.at(-1)!.x).toBeGreaterThan(0);
    });

    it("goes on while it is held", () => {
      frames(3 * kSilenceMs, hold);
      expect(sent.at(-1)!.x).toBeGreaterThan(0);
    });

    it("ends when it is released", () => {
      release();
      frames(100, () => {});
      expect(sent.at(-1)).toEqual(zero);
    });

    it.each(Object.entries(leave))("ends when %s, and begins anew only with a new touch", (_, way) => {
      way();
      expect(sent.at(-1)).toEqual(zero);
      const count = sent.length;
      // A tilt counts only while the pad is touched, which is released.
      frames(3 * kSilenceMs, name === "tilt" ? () => {} : hold);
      expect(sent.slice(count).filter(({x}) => x !== 0)).toEqual([]);
    });

    it("stands while nothing new comes from the robot, says why, and goes on with what is still held", () => {
      store.set({stateAgeMs: 501});
      expect(sent.at(-1)).toEqual(zero);
      expect(told).toEqual(["stale"]);
      const count = sent.length;
      frames(kSilenceMs, hold);
      expect(sent.length).toBe(count);
      store.set({stateAgeMs: 20});
      frames(100, hold);
      expect(sent.at(-1)!.x).toBeGreaterThan(0);
    });

    it("never walks later when it is released while nothing new comes", () => {
      store.set({stateAgeMs: 501});
      release();
      frames(100, () => {});
      store.set({stateAgeMs: 20});
      frames(3 * kSilenceMs, () => {});
      expect(sent.at(-1)).toEqual(zero);
    });

    it("ends when the page was held up, and begins anew only with a new touch", () => {
      // As in a computer that slept: no timer and no frame.
      vi.setSystemTime(Date.now() + 30_000);
      vi.advanceTimersByTime(kFrameMs * 10);
      expect(sent.at(-1)).toEqual(zero);
      const count = sent.length;
      frames(3 * kSilenceMs, name === "tilt" ? () => {} : hold);
      expect(sent.slice(count).filter(({x}) => x !== 0)).toEqual([]);
    });

    it("gives way to a button, which is sent after the end of the walk, and says so", () => {
      const numSent = sent.length;
      void commander.command({case: "doAction", value: {action: "kick-left"}});
      expect(sent.length).toBeGreaterThan(numSent);
      expect(sent.at(-1)).toEqual(zero);
      expect(store.get().messages.map(({text}) => text)).toEqual([say("drive.released")]);
      return vi.waitFor(() => expect(asked).toEqual(["doAction"]));
    });
  });

  it("says nothing of a stick when a button is tapped alone", () => {
    void commander.command({case: "goToPosture", value: {posture: "Stand"}});
    expect(store.get().messages).toEqual([]);
  });

  it.each(["gamepad", "tilt"] as const)("ends when a %s shows no life, and nothing is repeated then", (name) => {
    sources[name].begin();
    frames(300, sources[name].hold);
    frames(kSilenceMs + 200, () => {});
    expect(sent.at(-1)).toEqual(zero);
    const count = sent.length;
    frames(3 * kSilenceMs, () => {});
    expect(sent.length).toBe(count);
    expect(told.includes("silent")).toBe(name === "gamepad");
  });

  it("ends when frames come no more, in which gamepads are read", () => {
    sources.gamepad.begin();
    frames(300, sources.gamepad.hold);
    vi.advanceTimersByTime(2 * kSilenceMs);
    expect(sent.at(-1)).toEqual(zero);
  });

  it.each([["unplugged", () => pads[0] = null], ["no longer connected", () => pads[0]!.connected = false]])(
      "ends when a gamepad is %s", (_, way) => {
    sources.gamepad.begin();
    frames(300, sources.gamepad.hold);
    way();
    frames(2 * kFrameMs, () => {});
    expect(sent.at(-1)).toEqual(zero);
  });

  it("goes on from a gamepad without timestamps while its stick moves", () => {
    pads = [Object.assign(makePad(0, [0, -1, 0]), {timestamp: 0})];
    let x = 0;
    frames(3 * kSilenceMs, () => pads[0]!.axes = [x = 0.01 - x, -1, 0]);
    expect(sent.at(-1)!.x).toBeGreaterThan(0.9);
    frames(kSilenceMs + 200, () => {});
    expect(sent.at(-1)).toEqual(zero);
  });

  it("comes from the second gamepad while the first lies still", () => {
    pads = [makePad(0, [0, 0, 0]), makePad(1, [0, -1, 0])];
    frames(300, () => pads[1]!.timestamp++);
    expect(sent.at(-1)!.x).toBe(1);
  });

  it("does not begin with the drift of an old stick", () => {
    pads = [makePad(0, [0.13, -0.13, 0.13])];
    frames(300, () => pads[0]!.timestamp++);
    expect(sent).toEqual([]);
  });

  it("does not come from a gamepad of an unknown layout, which is told once", () => {
    pads = [makePad(0, [0, -1, 0], "")];
    frames(300, () => pads[0]!.timestamp++);
    expect(sent).toEqual([]);
    expect(told).toEqual(["pad 0"]);
  });
});
