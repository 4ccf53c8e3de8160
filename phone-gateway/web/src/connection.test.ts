import {create} from "@bufbuild/protobuf";
import {afterEach, beforeEach, describe, expect, it, vi} from "vitest";
import {FakeTransport} from "../test_support/fake_transport";
import {Connection, kOpenTimeoutMs, kSilenceMs} from "./connection";
import {ConnectedSchema, ErrorCode, ImageSchema, Mode, Notice_Kind, NoticeSchema, PongSchema, StateSchema} from "./protocol/generated/remote_pb";
import type {State} from "./protocol/generated/remote_pb";
import {isStale, Store} from "./store";

const kIdentity = {token: "secret", clientName: "Ana", clientSoftware: "test"};

describe("Connection", () => {
  let transport: FakeTransport;
  let store: Store;
  let connection: Connection;
  let states: State[];

  beforeEach(() => {
    vi.useFakeTimers();
    transport = new FakeTransport();
    store = new Store();
    states = [];
    connection = new Connection(transport, store, {
      connected: () => {},
      state: (state) => states.push(state),
      image: () => {},
      notice: () => {},
    }, () => Date.now());
    connection.connect(kIdentity);
  });
  afterEach(() => {
    connection.disconnect();
    vi.useRealTimers();
  });

  async function pass(ms: number): Promise<void> {
    await vi.advanceTimersByTimeAsync(ms);
  }

  async function welcome(): Promise<void> {
    transport.welcome();
    await pass(0);
  }

  it("greets with version and token before anything else", () => {
    transport.opened();
    expect(transport.sent).toHaveLength(1);
    const {useCase} = transport.sent[0]!;
    expect(useCase.case).toBe("connect");
    expect(useCase.value).toMatchObject({protocolVersion: 1, token: "secret", clientName: "Ana"});
  });

  it("is connected once the gateway says so", async () => {
    await welcome();
    expect(store.get()).toMatchObject({phase: "connected", clientId: 7, problem: null});
  });

  it("lets the person choose where there are several robots, and not where there is one", async () => {
    await welcome();
    expect(store.get()).toMatchObject({robots: [], isChoosingRobot: false});
    transport.broken(true);
    await pass(600);
    transport.welcome("NAO", ["NAO2"]);
    await pass(0);
    expect(store.get().robots.map(({name}) => name)).toEqual(["NAO", "NAO2"]);
    expect(store.get().isChoosingRobot).toBe(false);
    connection.disconnect();
    connection.connect(kIdentity);
    transport.welcome("NAO", ["NAO2"]);
    await pass(0);
    expect(store.get().isChoosingRobot).toBe(true);
  });

  it("knows nothing of the robot before after a change", async () => {
    transport.welcome("NAO", ["NAO2"]);
    await pass(0);
    store.set({state: create(StateSchema, {mode: Mode.HOLDING}), unavailableComponents: [1]});
    transport.changeRobot("NAO2");
    expect(store.get()).toMatchObject({state: null, unavailableComponents: [], savedMotions: ["bow"]});
    expect(store.get().robot?.name).toBe("NAO2");
    expect(store.get().control?.driverName).toBe("Ben");
  });

  it("comes back to the same robot after a lost link, and to any if that is gone", async () => {
    transport.welcome("NAO", ["NAO2"]);
    await pass(0);
    store.set({isChoosingRobot: false});
    transport.changeRobot("NAO2");
    transport.broken(true);
    await pass(600);
    transport.opened();
    expect(transport.sent.at(-1)!.useCase.value).toMatchObject({robot: "NAO2"});
    transport.answer("connect", ErrorCode.INVALID_ARGUMENT, "The gateway has no robot NAO2.");
    await pass(0);
    expect(transport.sent.at(-1)!.useCase.value).toMatchObject({robot: ""});
    transport.answer("connect", ErrorCode.OK, "", {case: "connected", value: create(
        ConnectedSchema, {clientId: 8, robot: {name: "NAO"}})});
    await pass(0);
    expect(store.get()).toMatchObject({phase: "connected", clientId: 8});
  });

  describe("with a second connection", () => {
    let second: FakeTransport;
    let images: number;
    let shown: number[];

    beforeEach(() => {
      connection.disconnect();
      second = new FakeTransport();
      transport.another = () => second;
      images = 0;
      shown = [];
      connection = new Connection(transport, store, {
        connected: () => {}, state: ({sentAt}) => shown.push(sentAt), image: () => images++, notice: () => {},
      }, () => Date.now());
      connection.connect(kIdentity);
    });

    async function join(error = ErrorCode.OK): Promise<void> {
      await welcome();
      second.opened();
      second.answer("join", error);
    }

    it("joins as the same client, by a key that only they know", async () => {
      await join();
      const connect = transport.sent.find((one) => one.useCase.case === "connect")!.useCase;
      const key = connect.case === "connect" ? connect.value.joinKey : "";
      expect(key).toHaveLength(32);
      expect(second.sent[0]!.useCase.value).toMatchObject({clientId: 7, key});
    });
    it("sends copies of short requests, with the same numbers, once it has joined", async () => {
      await welcome();
      second.opened();
      void connection.request({case: "stop", value: {}});
      expect(second.sent.map((one) => one.useCase.case)).toEqual(["join"]);
      second.answer("join");
      void connection.request({case: "stop", value: {}});
      void connection.request({case: "saveMotion", value: {motion: {yaml: "x".repeat(2000)}}});
      expect(second.sent.at(-1)).toEqual(transport.sent.at(-2));
      expect(second.sent).toHaveLength(2);
    });
    it("takes images from it, and counts their age from the exposure", async () => {
      await join();
      const sentAt = Date.now() / 1000 + 60;
      transport.answer("ping", ErrorCode.OK, "", {case: "pong", value: create(PongSchema, {sentAt})});
      await pass(50);
      second.receive({case: "image", value: create(ImageSchema, {ageMs: 20, sentAt})});
      expect(images).toBe(1);
      expect(store.get().imageAgeMs).toBeCloseTo(70, 0);
      await pass(400);
      expect(store.get().imageAgeMs).toBeGreaterThan(400);
    });
    it("shows no state that comes after a newer one over the other connection", async () => {
      await join();
      transport.receive({case: "state", value: create(StateSchema, {sentAt: 2})});
      second.receive({case: "state", value: create(StateSchema, {sentAt: 1})});
      second.receive({case: "state", value: create(StateSchema, {sentAt: 3})});
      expect(shown).toEqual([2, 3]);
    });
    it("opens it again when it breaks, and goes on without it where it is refused", async () => {
      await join();
      second.broken(true);
      await pass(1000);
      expect(second.numOpens).toBe(2);
      second.opened();
      second.answer("join", ErrorCode.INVALID_ARGUMENT);
      await pass(3500);
      expect(second.numOpens).toBe(2);
      expect(store.get().phase).toBe("connected");
    });
    it("closes it with the first one", async () => {
      await join();
      connection.disconnect();
      expect(second.isOpen).toBe(false);
    });
  });

  it("gives up on a wrong token and says so", async () => {
    transport.opened();
    transport.answer("connect", ErrorCode.WRONG_TOKEN, "No.");
    await pass(60_000);
    expect(store.get()).toMatchObject({phase: "idle", problem: "wrong-token", problemDetail: "No."});
    expect(transport.numOpens).toBe(1);
  });

  it("says so when the gateway makes it wait after wrong tokens", async () => {
    for (const [code, detail] of [["too-many-wrong-tokens", "Wait."], ["token-wrong", ""]] as const) {
      transport.opened();
      transport.answer("connect", ErrorCode.WRONG_TOKEN, "Wait.", undefined, code);
      await pass(0);
      expect(store.get()).toMatchObject({problem: "wrong-token", problemDetail: detail});
      connection.connect(kIdentity);
    }
  });

  it("tries again when all places are taken", async () => {
    transport.opened();
    transport.answer("connect", ErrorCode.TOO_MANY_CLIENTS);
    await pass(0);
    expect(store.get()).toMatchObject({phase: "waiting", problem: "too-many"});
    await pass(600);
    expect(transport.numOpens).toBe(2);
  });

  it("says why the gateway has closed, also before it was connected", async () => {
    transport.opened();
    transport.receive({case: "notice", value: create(NoticeSchema, {
      kind: Notice_Kind.CLOSING, message: "This invitation has expired or was withdrawn.", reasonCode: "invitation-ended"})});
    transport.broken(true);
    await pass(0);
    expect(store.get()).toMatchObject({problem: "not-a-robot", problemDetail: "This invitation has expired or was withdrawn."});
  });

  it("distinguishes an absent host from one that refuses", async () => {
    transport.broken(false);
    await pass(0);
    expect(store.get().problem).toBe("unreachable");
    await pass(600);
    transport.answers = true;
    transport.broken(false);
    await pass(0);
    expect(store.get().problem).toBe("not-a-robot");
  });

  it("gives up an attempt that hangs, and tries again", async () => {
    await pass(kOpenTimeoutMs);
    expect(store.get()).toMatchObject({phase: "waiting", problem: "unreachable"});
    await pass(600);
    expect(transport.numOpens).toBe(2);
  });

  it("waits longer after each failure, at most 5 s", async () => {
    const pauses: number[] = [];
    for (let i = 0; i < 6; i++) {
      transport.broken(false);
      await pass(0);
      const pause = store.get().nextAttemptMs - Date.now();
      pauses.push(pause);
      await pass(pause);
    }
    expect(pauses).toEqual([500, 1000, 2000, 4000, 5000, 5000]);
  });

  it("leaves after 5 s of silence and comes back by itself", async () => {
    await welcome();
    await pass(kSilenceMs - 500);
    expect(store.get().phase).toBe("connected");
    await pass(1000);
    expect(store.get()).toMatchObject({phase: "waiting", problem: "silent"});
    expect(transport.isOpen).toBe(false);
    await pass(600);
    await welcome();
    expect(store.get()).toMatchObject({phase: "connected", problem: null, attempts: 0});
  });

  it("stays while anything arrives", async () => {
    await welcome();
    for (let i = 0; i < 10; i++) {
      await pass(2000);
      transport.receive({case: "state", value: create(StateSchema, {mode: Mode.HOLDING})});
    }
    expect(store.get().phase).toBe("connected");
    expect(states).toHaveLength(10);
  });

  it("knows the age of what it shows, also while nothing comes", async () => {
    await welcome();
    expect(isStale(store.get())).toBe(false);
    await pass(40);
    transport.answer("ping", ErrorCode.OK, "", {case: "pong", value: create(PongSchema, {})});
    await pass(0);
    transport.receive({case: "state", value: create(StateSchema, {mode: Mode.WALKING, ageMs: 5})});
    expect(store.get().stateAgeMs).toBeCloseTo(25, 6);
    await pass(400);
    expect(isStale(store.get())).toBe(false);
    await pass(200);
    expect(store.get().stateAgeMs).toBeGreaterThan(500);
    expect(isStale(store.get())).toBe(true);
    // Long before the connection counts as lost.
    expect(store.get().phase).toBe("connected");
    transport.receive({case: "state", value: create(StateSchema, {mode: Mode.WALKING})});
    expect(isStale(store.get())).toBe(false);
    transport.broken(true);
    expect(isStale(store.get())).toBe(true);
  });

  it("reads what came while the page hung before it calls it old", async () => {
    await welcome();
    const walking = () => transport.receive({case: "state", value: create(StateSchema, {mode: Mode.WALKING})});
    const ages: boolean[] = [];
    store.watch(isStale, (isOld) => ages.push(isOld));
    walking();
    vi.setSystemTime(Date.now() + 2000);
    await pass(100);
    walking();
    await pass(300);
    expect(ages).toEqual([false]);
    vi.setSystemTime(Date.now() + 2000);
    await pass(200);
    expect(ages).toEqual([false, true]);
  });

  it("stays, and finds a lost link, where the page hangs before each check", async () => {
    await welcome();
    // One frame in 0.5 s.
    const hang = async () => {
      vi.setSystemTime(Date.now() + 400);
      await pass(100);
    };
    for (let i = 0; i < 40; i++) {
      transport.receive({case: "state", value: create(StateSchema, {mode: Mode.WALKING})});
      await hang();
    }
    // The gateway hears of it each second.
    expect(transport.sent.filter((one) => one.useCase.case === "ping").length).toBeGreaterThan(15);
    expect(isStale(store.get())).toBe(false);
    for (let i = 0; i < 3; i++) await hang();
    expect(isStale(store.get())).toBe(true);
    for (let i = 0; i < 9; i++) await hang();
    expect(store.get()).toMatchObject({phase: "waiting", problem: "silent"});
  });

  it("forgets the robot when a person connects anew, not when it reconnects by itself", async () => {
    await welcome();
    transport.broken(true);
    expect(store.get().robot?.name).toBe("NAO");
    connection.connect(kIdentity);
    expect(store.get().robot).toBeNull();
  });

  it("pings each second and shows the round trip", async () => {
    await welcome();
    await pass(40);
    transport.answer("ping", ErrorCode.OK, "", {case: "pong", value: create(PongSchema, {numClients: 3})});
    await pass(0);
    expect(store.get()).toMatchObject({latencyMs: 40, numClients: 3});
    await pass(1100);
    expect(transport.sent.filter((one) => one.useCase.case === "ping")).toHaveLength(2);
  });

  it("answers open requests with null when the link breaks", async () => {
    await welcome();
    const answer = connection.request({case: "stop", value: {}});
    transport.broken(true);
    await expect(answer).resolves.toBeNull();
    expect(store.get().problem).toBe("closed");
  });

  it("survives bytes that are not a message", async () => {
    await welcome();
    transport.receive({case: undefined});
    expect(store.get().phase).toBe("connected");
  });

  it("stays disconnected after disconnect()", async () => {
    await welcome();
    connection.disconnect();
    await pass(60_000);
    expect(store.get()).toMatchObject({phase: "idle", problem: null});
    expect(transport.numOpens).toBe(1);
  });
});
