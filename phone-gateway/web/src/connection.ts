/** Connection to the gateway: opens it, sends Connect and pings, reopens it, and reports problems. */
import {retryDelayMs} from "./backoff";
import {ClockRelation} from "./clock_relation";
import {decodeServerMessage, encodeRequest, kProtocolVersion} from "./protocol/codec";
import type {UseCase} from "./protocol/codec";
import {ErrorCode, Notice_Kind} from "./protocol/generated/remote_pb";
import type {
  Audio, Connected, Control, Notice, Image, Response, RobotDescription, State,
} from "./protocol/generated/remote_pb";
import {SecondConnection} from "./second_connection";
import type {Problem, Store} from "./store";
import {reasonInWords, setLabels} from "./text/texts";
import type {Transport} from "./transport";

/** Silence after which the link counts as lost, both here and in the gateway. */
export const kSilenceMs = 5000;
/** A transport that has not opened by then will not. */
export const kOpenTimeoutMs = 5000;
/** The same where a connection takes long. Chosen: a phone finds a device and its services by Bluetooth in some seconds. */
const kNarrowOpenTimeoutMs = 20_000;
/** Keeps the connection open and samples the latency. */
export const kPingPeriodMs = 1000;
const kCheckPeriodMs = 100;
const kNumLatencySamples = 5;
/** A state that waits behind this many bytes would come too late to be of use. */
const kMaxBacklogBytes = 16384;
const kNarrowMaxBacklogBytes = 256;

/** Receives the events of a connection. */
export interface ConnectionListener {
  connected(connected: Connected): void;
  /** Another robot is watched from now on; the store has it already. */
  robotChanged?(): void;
  state(state: State): void;
  image(image: Image): void;
  notice(notice: Notice): void;
  audio?(audio: Audio): void;
}

export interface Identity {
  token: string;
  clientName: string;
  clientSoftware: string;
}

/** What a refused Connect says; every other error: what answers is not a robot. */
const kProblems: {readonly [error in ErrorCode]?: Problem} = {
  [ErrorCode.WRONG_TOKEN]: "wrong-token", [ErrorCode.WRONG_VERSION]: "wrong-version", [ErrorCode.TOO_MANY_CLIENTS]: "too-many"};

/** Problems that another attempt would not solve. */
const kFinalProblems: readonly Problem[] = ["wrong-token", "wrong-version"];

export class Connection {
  private identity: Identity = {token: "", clientName: "", clientSoftware: ""};
  /** The robot to watch again after a lost link; empty: the gateway chooses. */
  private robotName = "";
  private nextRequestId = 1;
  private readonly pending = new Map<number, (response: Response | null) => void>();
  private readonly latencySamples: number[] = [];
  private lastReceivedMs = 0;
  /** When the newest state was taken, by the clock of `now`, ms; null: there is none. */
  private stateMs: number | null = null;
  /** The same of the newest image. */
  private imageMs: number | null = null;
  private readonly clocks = new ClockRelation();
  /** When the newest state was sent, s of the gateway's clock. */
  private newestSentAt = 0;
  private readonly second: SecondConnection | null;
  private lastPingMs = 0;
  private lastCheckMs = 0;
  private wasLate = false;
  private retryTimer: ReturnType<typeof setTimeout> | undefined;
  private openTimer: ReturnType<typeof setTimeout> | undefined;
  private checkTimer: ReturnType<typeof setInterval> | undefined;
  /** Counts attempts, so that what belongs to an older one is recognised. */
  private attempt = 0;
  private closingReason = "";

  /** @param now  ms on a clock that never jumps. */
  constructor(private readonly transport: Transport, private readonly store: Store,
              private readonly listener: ConnectionListener,
              private readonly now: () => number = () => performance.now()) {
    const another = transport.another?.();
    this.second = another ? new SecondConnection(another, (bytes) => this.handle(bytes)) : null;
  }

  /** Connects now and stays connected until disconnect(). */
  connect(identity: Identity): void {
    this.identity = identity;
    this.robotName = "";
    this.store.set({attempts: 0, robot: null, state: null});
    this.open();
  }

  /** Ends the link and every attempt. */
  disconnect(): void {
    this.stopTimers();
    this.close();
    this.dropPending();
    this.store.set({phase: "idle", problem: null, problemDetail: "", nextAttemptMs: 0});
  }

  /** Skips what is left of the pause, for example when the phone is back on the network. */
  retryNow(): void {
    if (this.store.get().phase === "waiting") this.open();
  }

  /** Asks the gateway for something. @return its answer, or null if the link broke before. */
  request(useCase: UseCase): Promise<Response | null> {
    const phase = this.store.get().phase;
    if (phase !== "connected" && useCase.case !== "connect") return Promise.resolve(null);
    return new Promise((resolve) => {
      const id = this.nextRequestId++;
      this.pending.set(id, resolve);
      const bytes = encodeRequest(id, useCase);
      this.transport.send(bytes);
      this.second?.copy(bytes);
    });
  }

  /** True while what is sent now would wait behind much else; repeated commands are left out then. */
  isCongested(): boolean {
    return this.transport.backlogBytes() > (this.transport.isNarrow ? kNarrowMaxBacklogBytes : kMaxBacklogBytes);
  }

  private open(): void {
    this.stopTimers();
    this.dropPending();
    this.closingReason = "";
    const attempt = ++this.attempt;
    this.store.set({phase: "connecting", nextAttemptMs: 0});
    this.openTimer = setTimeout(() => void this.failed(this.unreachable()),
                                this.transport.isNarrow ? kNarrowOpenTimeoutMs : kOpenTimeoutMs);
    this.transport.open({
      opened: () => void this.greet(attempt),
      received: (bytes) => this.received(bytes),
      closed: (wasOpen) => void this.closed(wasOpen, attempt),
    }, this.identity.token);
  }

  private async greet(attempt: number): Promise<void> {
    this.lastReceivedMs = this.now();
    const {token, clientName, clientSoftware} = this.identity;
    const robot = this.robotName;
    const response = await this.request({case: "connect", value: {
      protocolVersion: kProtocolVersion, token, clientName, clientSoftware, robot, joinKey: this.second?.key}});
    if (!response || attempt !== this.attempt) return;
    if (response.error === ErrorCode.OK && response.result.case === "connected") {
      this.welcome(response.result.value);
    } else if (response.error === ErrorCode.INVALID_ARGUMENT && robot) {
      // The gateway was started again without that robot.
      this.robotName = "";
      void this.greet(attempt);
    } else {
      // A wrong token says the problem's own sentence; that it must wait, only the gateway knows.
      this.failed(kProblems[response.error] ?? "not-a-robot", response.reasonCode === "token-wrong" ? "" : reasonInWords(response));
    }
  }

  private welcome(connected: Connected): void {
    this.stopTimers();
    this.latencySamples.length = 0;
    this.clocks.reset();
    this.newestSentAt = 0;
    const robots = connected.robots?.robots ?? [];
    // After a lost link the person goes on with the same robot.
    const isChoosingRobot = robots.length > 1 && (this.robotName === "" || this.store.get().isChoosingRobot);
    this.adopt(connected.robot, connected.control);
    this.store.set({
      phase: "connected", problem: null, problemDetail: "", attempts: 0,
      clientId: connected.clientId, clientName: connected.clientName, robots,
      match: connected.match ?? null, exhibition: connected.exhibition ?? null, isChoosingRobot, latencyMs: -1,
    });
    this.ping();
    if (!this.transport.isSingle) this.second?.open(connected.clientId);
    this.lastCheckMs = this.now();
    this.checkTimer = setInterval(() => this.check(), kCheckPeriodMs);
    this.listener.connected(connected);
  }

  /** What the store knows of a robot is that of this one from now on. */
  private adopt(robot: RobotDescription | undefined, control: Control | undefined): void {
    this.robotName = robot?.name ?? "";
    this.stateMs = null;
    this.imageMs = null;
    setLabels(robot?.labels ?? []);
    this.store.set({
      robot: robot ?? null, control: control ?? null,
      state: null, stateAgeMs: -1, image: null, imageAgeMs: -1, playState: null, vision: null, unavailableComponents: [],
      savedMotions: robot?.savedMotions ?? [], isCheckingMotion: false,
    });
  }

  private check(): void {
    const now = this.now();
    const isLate = now - this.lastCheckMs > 3 * kCheckPeriodMs;
    // A page that hung has not read yet what came meanwhile; one that always hangs has read it before its next check.
    const hasRead = !isLate || this.wasLate;
    this.wasLate = isLate;
    this.lastCheckMs = now;
    if (hasRead) this.measureAge();
    if (hasRead && now - this.lastReceivedMs > kSilenceMs) {
      this.failed("silent");
    } else if (now - this.lastPingMs >= kPingPeriodMs) {
      this.ping();
    }
  }

  private measureAge(): void {
    if (this.stateMs !== null) this.store.set({stateAgeMs: this.now() - this.stateMs});
    if (this.imageMs !== null) this.store.set({imageAgeMs: this.now() - this.imageMs});
  }

  /** When a state or image was taken, by the clock of `now`, ms. */
  private takenMs({ageMs, sentAt}: {ageMs: number; sentAt: number}): number {
    const now = this.now();
    return now - ageMs - (this.clocks.transitMs(sentAt, now) ?? Math.max(0, this.store.get().latencyMs) / 2);
  }

  private ping(): void {
    const sentMs = this.now();
    this.lastPingMs = sentMs;
    void this.request({case: "ping", value: {clientUtime: BigInt(Math.round(sentMs * 1000))}}).then((response) => {
      if (response?.result.case !== "pong") return;
      this.clocks.add(sentMs, this.now(), response.result.value.sentAt);
      this.latencySamples.push(this.now() - sentMs);
      if (this.latencySamples.length > kNumLatencySamples) this.latencySamples.shift();
      const sorted = [...this.latencySamples].sort((a, b) => a - b);
      this.store.set({latencyMs: sorted[sorted.length >> 1] ?? -1,
                      numClients: response.result.value.numClients});
    });
  }

  private received(bytes: Uint8Array): void {
    this.lastReceivedMs = this.now();
    this.handle(bytes);
  }

  /** A message over either connection. */
  private handle(bytes: Uint8Array): void {
    const message = decodeServerMessage(bytes)?.message;
    switch (message?.case) {
      case "response": {
        const resolve = this.pending.get(message.value.requestId);
        this.pending.delete(message.value.requestId);
        resolve?.(message.value);
        break;
      }
      case "state":
        // One of the two connections may be late.
        if (message.value.sentAt > 0 && message.value.sentAt < this.newestSentAt) break;
        this.newestSentAt = message.value.sentAt;
        this.stateMs = this.takenMs(message.value);
        this.measureAge();
        this.listener.state(message.value);
        break;
      case "image":
        this.imageMs = this.takenMs(message.value);
        this.measureAge();
        this.listener.image(message.value);
        break;
      case "notice": this.noticed(message.value); break;
      case "audio": this.listener.audio?.(message.value); break;
      case "playState": this.store.set({playState: message.value}); break;
      case "vision": this.store.set({vision: message.value}); break;
    }
  }

  private noticed(notice: Notice): void {
    switch (notice.kind) {
      case Notice_Kind.ROBOT_CHANGED:
        this.adopt(notice.robot, notice.control);
        this.listener.robotChanged?.();
        break;
      case Notice_Kind.ROBOTS_CHANGED:
        this.store.set({robots: notice.robots?.robots ?? []});
        break;
      case Notice_Kind.MATCH_CHANGED:
        this.store.set({match: notice.match ?? null});
        break;
      case Notice_Kind.EXHIBITION_CHANGED:
        this.store.set({exhibition: notice.exhibition ?? null});
        break;
      default:
        // The gateway's own words, for the moment when it closes.
        if (notice.kind === Notice_Kind.CLOSING) this.closingReason = reasonInWords(notice);
        this.listener.notice(notice);
    }
  }

  private async closed(wasOpen: boolean, attempt: number): Promise<void> {
    // After Connect the link broke; before, the host is not a gateway.
    if (wasOpen) return this.failed(this.store.get().phase === "connected" ? "closed" : "not-a-robot", this.closingReason);
    const answers = await this.transport.somethingAnswers();
    if (attempt === this.attempt) this.failed(answers ? "not-a-robot" : this.unreachable());
  }

  private unreachable(): Problem {
    return this.transport.isNarrow ? "no-bluetooth" : "unreachable";
  }

  private failed(problem: Problem, detail = ""): void {
    this.stopTimers();
    this.attempt++;
    this.close();
    this.dropPending();
    const attempts = this.store.get().attempts + 1;
    if (kFinalProblems.includes(problem)) {
      this.store.set({phase: "idle", problem, problemDetail: detail, nextAttemptMs: 0, attempts});
      return;
    }
    const delay = retryDelayMs(attempts);
    this.retryTimer = setTimeout(() => this.open(), delay);
    this.store.set({phase: "waiting", problem, problemDetail: detail, attempts,
                    nextAttemptMs: this.now() + delay});
  }

  private close(): void {
    this.second?.close();
    this.transport.close();
  }

  private stopTimers(): void {
    clearTimeout(this.retryTimer);
    clearTimeout(this.openTimer);
    clearInterval(this.checkTimer);
  }

  private dropPending(): void {
    const waiting = [...this.pending.values()];
    this.pending.clear();
    for (const resolve of waiting) resolve(null);
  }
}
