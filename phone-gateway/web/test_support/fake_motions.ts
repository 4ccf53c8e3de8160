/** Motions of the fake gateway: checks them for speed only, keeps them in memory, and says where they are at a
 * time. Files are JSON, which is YAML as well. */
import {create, fromJsonString, toJsonString} from "@bufbuild/protobuf";
import type {MessageInitShape} from "@bufbuild/protobuf";
import * as pb from "../src/protocol/generated/remote_pb";

/** Fastest that an imaginary joint turns, rad/s. */
const kMaxVelocity = 4;

export class FakeMotions {
  private readonly saved = new Map<string, pb.Motion>();

  /** Names of the motions that are listed. */
  get names(): string[] {
    return [...this.saved.keys()].filter((name) => !name.startsWith("_")).sort();
  }

  get(name: string): pb.MotionFile | null {
    const motion = this.saved.get(name);
    return motion ? create(pb.MotionFileSchema, {motion, yaml: toJsonString(pb.MotionSchema, motion)}) : null;
  }

  delete(name: string): boolean {
    return this.saved.delete(name);
  }

  /** Saves a motion if it is safe. @return the answer. */
  save({motion: file, replace}: pb.SaveMotion): MessageInitShape<typeof pb.ResponseSchema> {
    const answer = (report: MessageInitShape<typeof pb.MotionReportSchema>) =>
        ({case: "motionReport" as const, value: {keyframe: -1, ...report}});
    const refuse = (error: pb.ErrorCode, reasonCode: string, message: string, reasonArguments: string[] = [], report = {}) =>
        ({error, message, reasonCode, reasonArguments, result: answer(report)});
    const motion = motionOf(file);
    if (!motion) return refuse(pb.ErrorCode.INVALID_ARGUMENT, "motion-malformed", "The file is not a motion.");
    const {name} = motion;
    if (this.saved.has(name) && !replace && !name.startsWith("_")) {
      return refuse(pb.ErrorCode.NAME_IN_USE, "motion-name-in-use", `A motion ${name} is saved.`);
    }
    const slow = motion.keyframes.map((_, i) => leastDuration(motion, i));
    const keyframe = slow.findIndex((time, i) => time > motion.keyframes[i]!.duration + 1e-6);
    if (keyframe >= 0) {
      const repaired = create(pb.MotionSchema, {...motion, keyframes: motion.keyframes.map((one, i) => (
        {...one, duration: Math.max(one.duration, Math.ceil(slow[i]! * 10) / 10)}))});
      const seconds = repaired.keyframes[keyframe]!.duration.toFixed(1);
      return refuse(pb.ErrorCode.INVALID_ARGUMENT, "motion-too-fast", `A joint needs at least ${seconds} s to this keyframe.`,
                    ["A joint", seconds], {keyframe, repaired, repair: "slowed-down"});
    }
    this.saved.set(name, motion);
    return {result: answer({isSafe: true})};
  }

  /** Time of all repetitions, s; 0 for an unknown motion. */
  timeOf(name: string): number {
    const motion = this.saved.get(name);
    const once = motion?.keyframes.reduce((sum, {duration, pause}) => sum + duration + pause, 0) ?? 0;
    return once * Math.max(1, motion?.repetitions ?? 0);
  }

  /** The keyframe that a motion goes to at a time since its beginning, s; null after its end. */
  keyframeAt(name: string, time: number): pb.Keyframe | null {
    const keyframes = this.saved.get(name)?.keyframes ?? [];
    if (time >= this.timeOf(name)) return null;
    let left = time;
    for (let i = 0; keyframes.length > 0; i = (i + 1) % keyframes.length) {
      left -= keyframes[i]!.duration + keyframes[i]!.pause;
      if (left < 0) return keyframes[i]!;
    }
    return null;
  }
}

function motionOf(file: pb.MotionFile | undefined): pb.Motion | null {
  try {
    return file?.motion ?? fromJsonString(pb.MotionSchema, file?.yaml ?? "");
  } catch {
    return null;
  }
}

/** Time that a keyframe needs at least, s: its farthest joint at full speed. */
function leastDuration({keyframes}: pb.Motion, index: number): number {
  const before = keyframes[index - 1];
  const {jointNames, jointPosition} = keyframes[index]!;
  const times = jointNames.map((name, i) => {
    const start = before?.jointPosition[before.jointNames.indexOf(name)];
    return start === undefined ? 0 : Math.abs(jointPosition[i]! - start) / kMaxVelocity;
  });
  return Math.max(0, ...times);
}
