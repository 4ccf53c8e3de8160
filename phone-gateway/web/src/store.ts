/** The state of the app; everything on screen is drawn from it. */
import type {
  Control, Joint, Notice, Notice_Component, Image, RobotDescription, State,
} from "./protocol/generated/remote_pb";

/** Phase of the connection to the gateway. */
export type LinkPhase =
    /** No connection was requested yet, or the last attempt was refused permanently. */
    "idle" |
    /** The transport is being opened, or Connect waits for its answer. */
    "connecting" |
    "connected" |
    /** Lost or failed; the next attempt is scheduled. */
    "waiting";

/** Why there is no connection; each has a sentence and an advice in text/texts.ts. */
export type Problem =
    "unreachable" | "not-a-robot" | "wrong-token" | "wrong-version" | "too-many" | "silent" |
    "closed";

/** A message to the user, shown for some seconds. */
export interface Message {
  id: number;
  kind: "info" | "good" | "bad";
  text: string;
}

export interface Loading {
  /** What is being loaded: files done and in all; 0 in all before the list is known. */
  done: number;
  total: number;
  /** Why loading failed; empty while all is well. */
  error: string;
}

export interface AppState {
  phase: LinkPhase;
  problem: Problem | null;
  /** The gateway's own words about the problem; may be empty. */
  problemDetail: string;
  /** Time of the next attempt, ms on the clock of performance.now(); 0: none planned. */
  nextAttemptMs: number;
  /** Attempts since the last success. */
  attempts: number;
  clientId: number;
  clientName: string;
  robot: RobotDescription | null;
  control: Control | null;
  state: State | null;
  image: Image | null;
  loading: Loading;
  /** Newest last. */
  messages: readonly Message[];
  /** Latest result of a command. */
  lastResult: Notice | null;
  /** Components that do not answer. */
  unavailableComponents: readonly Notice_Component[];
  /** Median round trip of the last pings, ms; negative before the first. */
  latencyMs: number;
  numClients: number;
  /** True in joints mode, false in drive mode. */
  isJointsMode: boolean;
  /** Name of the joint group in hand; empty: none. */
  selectedGroup: string;
}

const kInitialState: AppState = {
  phase: "idle",
  problem: null,
  problemDetail: "",
  nextAttemptMs: 0,
  attempts: 0,
  clientId: 0,
  clientName: "",
  robot: null,
  control: null,
  state: null,
  image: null,
  loading: {done: 0, total: 0, error: ""},
  messages: [],
  lastResult: null,
  unavailableComponents: [],
  latencyMs: -1,
  numClients: 0,
  isJointsMode: false,
  selectedGroup: "",
};

interface Watcher {
  check(state: AppState): void;
}

export class Store {
  private current: AppState = {...kInitialState};
  private readonly watchers = new Set<Watcher>();

  get(): Readonly<AppState> {
    return this.current;
  }

  /** Changes some values and notifies the watchers. */
  set(patch: Partial<AppState>): void {
    Object.assign(this.current, patch);
    for (const watcher of this.watchers) watcher.check(this.current);
  }

  /** Calls `act` now and whenever the selected value is another one.
   * @return a function that ends the watch. */
  watch<T>(select: (state: Readonly<AppState>) => T, act: (value: T) => void): () => void {
    let last = select(this.current);
    const watcher: Watcher = {
      check(state) {
        const value = select(state);
        if (Object.is(value, last)) return;
        last = value;
        act(value);
      },
    };
    this.watchers.add(watcher);
    act(last);
    return () => this.watchers.delete(watcher);
  }
}

/** Angle of one motor joint in a state, rad; NaN if the state does not have it. */
export function jointPosition(joints: readonly Joint[], state: State, name: string): number {
  const index = joints.findIndex((joint) => joint.name === name);
  return state.jointPosition[index] ?? NaN;
}
