/** The draft in the store: remembers what it was before each change, and survives a reload. */
import {keep, recall} from "../storage";
import type {Store} from "../store";
import type {DraftKeyframe, MotionDraft, Pose} from "./motion_draft";
import {kEmptyDraft, kMaxKeyframes, setRepetitions, setSpeed} from "./motion_draft";

const kKey = "nao-remote-draft";
const kMaxUndo = 50;

export class DraftEditor {
  private readonly history: MotionDraft[] = [];

  constructor(private readonly store: Store, private readonly storage: Storage | null) {
    store.set({draft: readDraft(storage)});
  }

  get draft(): MotionDraft {
    return this.store.get().draft;
  }

  /** Puts another draft in its place, so that undo() brings the present one back. */
  change(draft: MotionDraft): void {
    if (draft === this.draft) return;
    this.history.push(this.draft);
    if (this.history.length > kMaxUndo) this.history.shift();
    this.put(draft);
  }

  /** As change(), for what is not a step of its own: a letter of the name, a joint that was touched. */
  note(draft: MotionDraft): void {
    if (draft !== this.draft) this.put(draft);
  }

  undo(): void {
    const before = this.history.pop();
    // The name is typed beside the steps: it stays.
    if (before) this.put({...before, name: this.draft.name || before.name});
  }

  /** Begins anew; undo() brings the old draft back. */
  clear(): void {
    this.change(kEmptyDraft);
  }

  private put(draft: MotionDraft): void {
    // A fault was found in what the draft was before.
    this.store.set({draft, canUndoDraft: this.history.length > 0, motionFault: null});
    keep(this.storage, kKey, draft);
  }
}

/** The draft of before the reload; an empty one if none was kept, or by another version. */
export function readDraft(storage: Storage | null): MotionDraft {
  const found = recall<MotionDraft>(storage, kKey);
  if (!Array.isArray(found?.keyframes)) return kEmptyDraft;
  const keyframes = found.keyframes.slice(0, kMaxKeyframes) as Partial<DraftKeyframe>[];
  if (!keyframes.every((keyframe) => isTime(keyframe?.duration) && isTime(keyframe.pause) && isPose(keyframe.pose))) return kEmptyDraft;
  const draft = {
    ...kEmptyDraft, keyframes: keyframes as DraftKeyframe[],
    name: typeof found.name === "string" ? found.name : "",
    start: typeof found.start === "string" ? found.start : "",
    base: isPose(found.base) ? found.base : {},
    touched: Array.isArray(found.touched) ? found.touched.filter((name) => typeof name === "string") : [],
  };
  return setRepetitions(setSpeed(draft, numberOr(found.speed, 1)), numberOr(found.repetitions, 1));
}

function isTime(value: unknown): value is number {
  return Number.isFinite(value) && (value as number) >= 0;
}

function isPose(value: unknown): value is Pose {
  return typeof value === "object" && value !== null && Object.values(value).every(Number.isFinite);
}

function numberOr(value: unknown, otherwise: number): number {
  return Number.isFinite(value) ? value as number : otherwise;
}
