/** A motion while it is being taught: poses with times. Pure; each change returns another draft. */
import {create} from "@bufbuild/protobuf";
import {clamp} from "../clamp";
import {KeyframeSchema, MotionSchema} from "../protocol/generated/remote_pb";
import type {Joint, Motion} from "../protocol/generated/remote_pb";

/** Limits of remote.proto: keyframes of a motion, repetitions, and times, s. */
export const kMaxKeyframes = 200;
const kMaxRepetitions = 100;
export const kMinDuration = 0.1;
const kMaxDuration = 60;
/** Range of the speed factor [chosen]: slower is too slow to watch, faster is rarely safe. */
const kMinSpeed = 0.25;
const kMaxSpeed = 2;
/** A new keyframe is reached at this fraction of the joints' maximum speed [chosen: looks calm, and is
 * far from what the motors can do], in this time at least, s. */
const kTaughtSpeed = 0.2;
const kLeastTaughtDuration = 0.5;
const kLeastFirstDuration = 1;
/** A joint that differs from the pose at the beginning by more than this was moved on purpose, rad: some
 * times the sag of a loaded joint. */
const kMoved = 0.06;

/** Angles, rad (hands: opening), by joint name. */
export type Pose = Readonly<Record<string, number>>;

export interface DraftKeyframe {
  /** From the keyframe before, s. */
  duration: number;
  /** Rest after it, s. */
  pause: number;
  pose: Pose;
}

export interface MotionDraft {
  /** As the person wrote it; empty before. */
  name: string;
  keyframes: readonly DraftKeyframe[];
  /** Posture that a saved motion starts from; empty: the robot's host chooses. */
  start: string;
  /** Factor of the whole motion's speed. */
  speed: number;
  repetitions: number;
  /** Pose when the draft was begun. */
  base: Pose;
  /** Joints that were turned or relaxed: the motion has them even where they return to `base`. */
  touched: readonly string[];
}

export const kEmptyDraft: MotionDraft = {
  name: "", keyframes: [], start: "", speed: 1, repetitions: 1, base: {}, touched: [],
};

/** Notes joints that the person moves. @param pose  of the robot, before the first of them has moved. */
export function touch(draft: MotionDraft, joints: readonly string[], pose: Pose): MotionDraft {
  const begun = Object.keys(draft.base).length > 0 ? draft : {...draft, base: pose};
  const added = joints.filter((name) => name !== "" && !draft.touched.includes(name));
  return added.length === 0 && begun === draft ? draft : {...begun, touched: [...draft.touched, ...added]};
}

/** Appends a pose, with a time that suits the distance. The same draft if it is full.
 * @param joints  of the robot, for their speeds. */
export function addPose(draft: MotionDraft, pose: Pose, joints: readonly Joint[]): MotionDraft {
  if (draft.keyframes.length >= kMaxKeyframes) return draft;
  const base = Object.keys(draft.base).length > 0 ? draft.base : pose;
  const last = draft.keyframes.at(-1)?.pose;
  const least = last ? kLeastTaughtDuration : kLeastFirstDuration;
  const keyframe = {duration: Math.max(least, timeBetween(last ?? base, pose, joints)), pause: 0, pose};
  return {...draft, base, keyframes: [...draft.keyframes, keyframe]};
}

export function removeKeyframe(draft: MotionDraft, index: number): MotionDraft {
  return {...draft, keyframes: draft.keyframes.filter((_, i) => i !== index)};
}

/** Moves a keyframe towards the end, or the beginning if `by` is negative; not beyond them. */
export function moveKeyframe(draft: MotionDraft, index: number, by: number): MotionDraft {
  const keyframes = [...draft.keyframes];
  const [moved] = keyframes.splice(index, 1);
  if (!moved) return draft;
  keyframes.splice(clamp(index + by, 0, keyframes.length), 0, moved);
  return {...draft, keyframes};
}

/** Changes values of one keyframe; times are kept within their limits. */
export function changeKeyframe(draft: MotionDraft, index: number, change: Partial<DraftKeyframe>): MotionDraft {
  return {...draft, keyframes: draft.keyframes.map((keyframe, i) => {
    if (i !== index) return keyframe;
    const {duration, pause, pose} = {...keyframe, ...change};
    return {duration: clamp(duration, kMinDuration, kMaxDuration), pause: clamp(pause, 0, kMaxDuration), pose};
  })};
}

export function setSpeed(draft: MotionDraft, speed: number): MotionDraft {
  const clipped = clamp(speed, kMinSpeed, kMaxSpeed);
  return clipped === draft.speed ? draft : {...draft, speed: clipped};
}

export function setRepetitions(draft: MotionDraft, repetitions: number): MotionDraft {
  const clipped = clamp(Math.round(repetitions), 1, kMaxRepetitions);
  return clipped === draft.repetitions ? draft : {...draft, repetitions: clipped};
}

/** The motion as seen in a mirror: what the left arm did, the right one does. Joints whose mirror image the
 * robot does not describe stay as they are. */
export function mirror(draft: MotionDraft, joints: readonly Joint[]): MotionDraft {
  return {
    ...draft,
    keyframes: draft.keyframes.map((keyframe) => ({...keyframe, pose: mirrorPose(keyframe.pose, joints)})),
    base: mirrorPose(draft.base, joints),
    touched: draft.touched.map((name) => joints.find((joint) => joint.name === name)?.mirrorJoint || name),
  };
}

/** The joints that the motion has: those touched, and those that differ from the pose at the beginning. The
 * others are left to the robot, so that a wave works in every posture. */
export function jointsOf(draft: MotionDraft): string[] {
  const names = new Set(draft.touched);
  for (const {pose} of draft.keyframes) {
    for (const [name, angle] of Object.entries(pose)) {
      const start = draft.base[name];
      if (start === undefined || Math.abs(angle - start) > kMoved) names.add(name);
    }
  }
  const present = new Set(draft.keyframes.flatMap(({pose}) => Object.keys(pose)));
  const moved = [...names].filter((name) => present.has(name)).sort();
  // A motion without any joint would be refused: a draft of the first pose alone holds all of it.
  return moved.length > 0 ? moved : [...present].sort();
}

/** @param name  a name that the robot's host accepts. */
export function toMotion(draft: MotionDraft, name: string): Motion {
  const names = jointsOf(draft);
  return create(MotionSchema, {
    name, start: draft.start, repetitions: draft.repetitions,
    keyframes: draft.keyframes.map(({duration, pause, pose}) => {
      const jointNames = names.filter((joint) => pose[joint] !== undefined);
      return create(KeyframeSchema, {
        duration: clamp(duration / draft.speed, kMinDuration, kMaxDuration),
        pause: clamp(pause / draft.speed, 0, kMaxDuration),
        jointNames, jointPosition: jointNames.map((joint) => pose[joint]!),
      });
    }),
  });
}

/** A draft with the keyframes of a motion, to change a saved one. */
export function fromMotion(motion: Motion): MotionDraft {
  const keyframes = motion.keyframes.slice(0, kMaxKeyframes).map(({duration, pause, jointNames, jointPosition}) => ({
    duration, pause,
    pose: Object.fromEntries(jointNames.map((name, i) => [name, jointPosition[i] ?? 0])),
  }));
  const touched = [...new Set(keyframes.flatMap(({pose}) => Object.keys(pose)))].sort();
  return {...kEmptyDraft, name: motion.name, start: motion.start, keyframes, touched,
          repetitions: Math.max(1, motion.repetitions)};
}

/** A draft with the keyframes of its repaired motion. */
export function repair(draft: MotionDraft, repaired: Motion): MotionDraft {
  return {...fromMotion(repaired), name: draft.name};
}

/** A draft of one keyframe only, to show it on the robot: a second at least to get there. */
export function onlyKeyframe(draft: MotionDraft, index: number): MotionDraft {
  const keyframes = draft.keyframes.slice(index, index + 1).map((keyframe) => (
    {...keyframe, duration: Math.max(keyframe.duration / draft.speed, kLeastFirstDuration), pause: 0}));
  return {...draft, keyframes, touched: jointsOf(draft), speed: 1, repetitions: 1};
}

/** Time of one repetition, s. */
export function timeOf({keyframes, speed}: MotionDraft): number {
  return keyframes.reduce((sum, {duration, pause}) => sum + duration + pause, 0) / speed;
}

/** Keyframe that a motion is at. @param progress  fraction of all repetitions, 0 to 1; -1 for other values. */
export function keyframeAt({keyframes, repetitions}: MotionDraft, progress: number): number {
  if (!(progress >= 0 && progress <= 1) || keyframes.length === 0) return -1;
  const times = keyframes.map(({duration, pause}) => duration + pause);
  const total = times.reduce((sum, time) => sum + time, 0);
  let left = progress === 1 ? total : (progress * repetitions % 1) * total;
  for (const [i, time] of times.entries()) {
    left -= time;
    if (left < 0) return i;
  }
  return keyframes.length - 1;
}

/** Time between two poses at an unhurried speed, s, a multiple of 0.1. */
function timeBetween(from: Pose, to: Pose, joints: readonly Joint[]): number {
  const times = joints.map(({name, maxVelocity}) => {
    const change = Math.abs((to[name] ?? 0) - (from[name] ?? to[name] ?? 0));
    return maxVelocity > 0 ? change / (kTaughtSpeed * maxVelocity) : 0;
  });
  return Math.min(Math.ceil(Math.max(0, ...times) * 10) / 10, kMaxDuration);
}

function mirrorPose(pose: Pose, joints: readonly Joint[]): Pose {
  const mirrored: Record<string, number> = {...pose};
  for (const {name, mirrorJoint, mirrorSign} of joints) {
    const angle = pose[name];
    const other = joints.find((joint) => joint.name === mirrorJoint);
    if (angle === undefined || !other) continue;
    // + 0: never -0, which a reload would turn into 0.
    mirrored[mirrorJoint] = clamp(mirrorSign * angle, other.lower, other.upper) + 0;
    // A partial pose: what only one side had, only the other side has.
    if (pose[mirrorJoint] === undefined) delete mirrored[name];
  }
  return mirrored;
}
