import {create} from "@bufbuild/protobuf";
import {describe, expect, it} from "vitest";
import {JointSchema} from "../protocol/generated/remote_pb";
import type {MotionDraft, Pose} from "./motion_draft";
import {
  addPose, changeKeyframe, fromMotion, jointsOf, kEmptyDraft, keyframeAt, kMaxKeyframes, mirror, moveKeyframe,
  removeKeyframe, repair, setRepetitions, setSpeed, timeOf, toMotion, touch,
} from "./motion_draft";

const joint = (name: string, mirrorJoint: string, mirrorSign: number) =>
    create(JointSchema, {name, lower: -2, upper: 1.5, maxVelocity: 5, mirrorJoint, mirrorSign});
/** A robot with a waist that is its own mirror image, two arms, and a tail that has none. */
const joints = [joint("Waist", "Waist", -1), joint("ArmA", "ArmB", -1), joint("ArmB", "ArmA", -1), joint("Tail", "", 0)];
const rest: Pose = {Waist: 0, ArmA: 0, ArmB: 0, Tail: 0.2};
const lifted: Pose = {...rest, ArmA: 1};
const taught = (...poses: Pose[]): MotionDraft =>
    poses.reduce((draft, pose) => addPose(draft, pose, joints), touch(kEmptyDraft, ["ArmA"], rest));
const angles = (draft: MotionDraft) => draft.keyframes.map(({pose}) => pose["ArmA"]);

describe("a motion draft", () => {
  it("gives a new pose a time that suits its distance from the one before", () => {
    const draft = taught(lifted, {...rest, ArmA: -1}, {...rest, ArmA: -0.99});
    expect(draft.keyframes.map(({duration}) => duration)).toEqual([1, 2, 0.5]);
    expect(draft.keyframes.map(({pause}) => pause)).toEqual([0, 0, 0]);
  });

  it("takes no more keyframes than a motion may have", () => {
    const full = taught(...Array.from({length: kMaxKeyframes}, () => rest));
    expect(addPose(full, lifted, joints)).toBe(full);
  });

  it("has only joints that the person touched, or that left the pose at the beginning", () => {
    expect(jointsOf(taught(lifted, rest))).toEqual(["ArmA"]);
    expect(jointsOf(taught(rest))).toEqual(["ArmA"]);
    expect(jointsOf(taught({...lifted, Waist: 0.3, Tail: 0.25}))).toEqual(["ArmA", "Waist"]);
  });

  it("has the whole pose if nothing was moved: a motion without joints would be refused", () => {
    expect(jointsOf(addPose(kEmptyDraft, rest, joints))).toEqual(["ArmA", "ArmB", "Tail", "Waist"]);
  });

  it("reorders and removes keyframes, and never beyond the ends", () => {
    const draft = taught({ArmA: 0.1}, {ArmA: 0.2}, {ArmA: 0.3});
    expect(angles(moveKeyframe(draft, 2, -1))).toEqual([0.1, 0.3, 0.2]);
    expect(angles(moveKeyframe(draft, 0, -1))).toEqual([0.1, 0.2, 0.3]);
    expect(angles(moveKeyframe(draft, 0, 9))).toEqual([0.2, 0.3, 0.1]);
    expect(angles(removeKeyframe(draft, 1))).toEqual([0.1, 0.3]);
    expect(moveKeyframe(draft, 7, 1)).toBe(draft);
  });

  it("mirrors poses with the robot's own signs, within the other joint's limits", () => {
    const draft = mirror(taught({Waist: 0.3, ArmA: 1.4, ArmB: 0, Tail: 0.2}, {...rest, ArmA: -1.8}), joints);
    expect(draft.keyframes[0]!.pose).toEqual({Waist: -0.3, ArmA: 0, ArmB: -1.4, Tail: 0.2});
    expect(draft.keyframes[1]!.pose["ArmB"]).toBe(1.5);
    expect(draft.touched).toEqual(["ArmB"]);
  });

  it("mirrors a pose of one side into a pose of the other side", () => {
    const draft = mirror({...kEmptyDraft, keyframes: [{duration: 1, pause: 0, pose: {ArmA: 0.5}}]}, joints);
    expect(draft.keyframes[0]!.pose).toEqual({ArmB: -0.5});
  });

  it("is itself again when mirrored twice", () => {
    const draft = taught({Waist: 0.3, ArmA: 1.2, ArmB: -0.4, Tail: 0.2});
    expect(mirror(mirror(draft, joints), joints)).toEqual(draft);
  });

  it("keeps times, speed and repetitions within the limits of the protocol", () => {
    const draft = changeKeyframe(taught(lifted), 0, {duration: 0, pause: 99});
    expect(draft.keyframes[0]).toMatchObject({duration: 0.1, pause: 60});
    expect(setSpeed(draft, 9).speed).toBe(2);
    expect(setRepetitions(draft, 0).repetitions).toBe(1);
    expect(setRepetitions(draft, 1000).repetitions).toBe(100);
  });

  it("plays every time at its speed factor", () => {
    const draft = setSpeed(changeKeyframe(taught(lifted), 0, {pause: 0.4}), 0.5);
    expect(timeOf(draft)).toBeCloseTo(2.8);
    expect(toMotion(draft, "wave-2").keyframes[0]).toMatchObject({duration: 2, pause: 0.8});
    expect(toMotion(setSpeed(changeKeyframe(draft, 0, {duration: 0.1}), 2), "x").keyframes[0]!.duration).toBe(0.1);
  });

  it("becomes a motion and comes back from one", () => {
    const motion = toMotion(setRepetitions(taught(lifted, rest), 3), "wave-2");
    expect(motion).toMatchObject({name: "wave-2", repetitions: 3});
    expect(motion.keyframes.map(({jointNames}) => jointNames)).toEqual([["ArmA"], ["ArmA"]]);
    const draft = fromMotion(motion);
    expect(draft).toMatchObject({name: "wave-2", repetitions: 3, touched: ["ArmA"], speed: 1});
    expect(angles(draft)).toEqual([1, 0]);
    expect(toMotion(draft, "wave-2")).toEqual(motion);
  });

  it("keeps its name when the repaired motion replaces it", () => {
    const draft = {...setSpeed(taught(lifted), 2), name: "Wave"};
    const repaired = repair(draft, toMotion(setSpeed(draft, 0.5), "_draft"));
    expect(repaired).toMatchObject({name: "Wave", speed: 1});
    expect(repaired.keyframes[0]!.duration).toBe(2);
  });

  it("tells which keyframe a progress is at, repetitions counted", () => {
    const draft = setRepetitions(taught(lifted, {...rest, ArmA: -1}), 2);
    expect([0, 0.1, 0.2, 0.49, 0.51, 0.99, 1].map((progress) => keyframeAt(draft, progress)))
        .toEqual([0, 0, 1, 1, 0, 1, 1]);
    expect(keyframeAt(draft, -1)).toBe(-1);
    expect(keyframeAt(kEmptyDraft, 0.5)).toBe(-1);
  });
});
