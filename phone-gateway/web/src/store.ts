/** The state of the app; everything on screen is drawn from it. */
import type {
  Control, Exhibition, Joint, Match, Motion, Notice, Notice_Component, Image, PlayState, RobotDescription, RobotList_Robot, State, Vision,
} from "./protocol/generated/remote_pb";
import type {Postures} from "./robot/posture_file";
import {kDefaultSettings} from "./settings";
import type {SpeechSettings} from "./speech/speech_settings";
import {kEmptyDraft} from "./teach/motion_draft";
import type {Pose} from "./teach/motion_draft";

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
    "unreachable" | "no-bluetooth" | "not-a-robot" | "wrong-token" | "wrong-version" | "too-many" | "silent" |
    "closed";

/** A message to the user, shown for some seconds. */
export interface Message {
  id: number;
  kind: "info" | "good" | "bad";
  text: string;
}

/** Why a motion was not played or saved. */
export interface MotionFault {
  /** Keyframe at which it shows, from 0; -1: none in particular. */
  keyframe: number;
  text: string;
  /** What `repaired` does about it, as a button says it. */
  repairText: string;
  /** The motion without the fault; null if none was found. */
  repaired: Motion | null;
  /** True: the fault is in a file that was chosen, not in the draft. */
  isUpload: boolean;
}

/** What is known before anything has come. */
const kInitialState = {
  phase: "idle" as LinkPhase,
  problem: null as Problem | null,
  /** The gateway's own words about the problem; may be empty. */
  problemDetail: "",
  /** Time of the next attempt, ms on the clock of performance.now(); 0: none planned. */
  nextAttemptMs: 0,
  /** Attempts since the last success. */
  attempts: 0,
  clientId: 0,
  clientName: "",
  /** The robot that is watched, and who drives it. */
  robot: null as RobotDescription | null,
  control: null as Control | null,
  /** Every robot of the gateway; empty where there is only one. */
  robots: [] as readonly RobotList_Robot[],
  /** The match that is played; null: none. */
  match: null as Match | null,
  /** The exhibition whose visitors drive in turn; null: none. */
  exhibition: null as Exhibition | null,
  /** True while the person chooses one of them. */
  isChoosingRobot: false,
  state: null as State | null,
  /** Age of that state as the phone sees it, also while nothing comes, ms; negative: there is none. */
  stateAgeMs: -1,
  image: null as Image | null,
  /** The same of that image. */
  imageAgeMs: -1,
  /** What is being loaded: files done and in all; 0 in all before the list is known. Why it failed; empty while all is well. */
  loading: {done: 0, total: 0, error: ""},
  /** Newest last. */
  messages: [] as readonly Message[],
  /** Latest result of a command. */
  lastResult: null as Notice | null,
  /** Components that do not answer. */
  unavailableComponents: [] as readonly Notice_Component[],
  /** Median round trip of the last pings, ms; negative before the first. */
  latencyMs: -1,
  numClients: 0,
  /** What is known of the robot's postures, and a drawing of each. */
  postures: new Map() as Postures,
  drawings: new Map() as ReadonlyMap<string, HTMLCanvasElement>,
  /** What the phone remembers. */
  settings: kDefaultSettings,
  speech: {phrases: null, language: "", isPlaying: false} as SpeechSettings,
  /** True: tilting the phone walks the robot. */
  isTilting: false,
  /** The form for address and code is asked for, over the view of before. */
  isFormOpen: false,
  /** True in joints mode, false in drive mode. */
  isJointsMode: false,
  /** Name of the joint group in hand; empty: none. */
  selectedGroup: "",
  /** Names of the motions saved on the robot's host. */
  savedMotions: [] as readonly string[],
  /** The motion being taught. */
  draft: kEmptyDraft,
  canUndoDraft: false,
  /** True while the robot's host checks a motion. */
  isCheckingMotion: false,
  motionFault: null as MotionFault | null,
  /** Joint groups without stiffness, to be moved by hand. */
  relaxedGroups: [] as readonly string[],
  /** What the robot does by itself; null: its host does not run nao-play. */
  playState: null as PlayState | null,
  /** What the robot sees in its newest analysed image; null: none was analysed. */
  vision: null as Vision | null,
};

export type AppState = typeof kInitialState;

export class Store {
  private current: AppState = {...kInitialState};
  private readonly watchers = new Set<(state: AppState) => void>();

  get(): Readonly<AppState> {
    return this.current;
  }

  /** Changes some values and notifies the watchers. */
  set(patch: Partial<AppState>): void {
    Object.assign(this.current, patch);
    for (const check of this.watchers) check(this.current);
  }

  /** Calls `act` now and whenever the selected value is another one.
   * @return a function that ends the watch. */
  watch<T>(select: (state: Readonly<AppState>) => T, act: (value: T) => void): () => void {
    let last = select(this.current);
    const check = (state: AppState): void => {
      const value = select(state);
      if (Object.is(value, last)) return;
      last = value;
      act(value);
    };
    this.watchers.add(check);
    act(last);
    return () => this.watchers.delete(check);
  }
}

/** A state of that age does not show what the robot does: nothing is driven by it; ms. That of the gateway's end of a walk. */
const kStaleMs = 500;

/** True if what is seen of the robot is old, or the link is lost. */
export function isStale({phase, stateAgeMs}: Readonly<AppState>): boolean {
  return phase !== "connected" || stateAgeMs > kStaleMs;
}

/** Angle of one motor joint in a state, rad; NaN if the state does not have it. */
export function jointPosition(joints: readonly Joint[], state: State, name: string): number {
  const index = joints.findIndex((joint) => joint.name === name);
  return state.jointPosition[index] ?? NaN;
}

/** The pose in a state, by joint name. */
export function poseOf(joints: readonly Joint[], state: State): Pose {
  return Object.fromEntries(joints.map(({name}, i) => [name, state.jointPosition[i] ?? 0]));
}
