/** One function for each request; the only place that builds request messages. */
import {create} from "@bufbuild/protobuf";
import * as pb from "./generated/remote_pb";
import type {UseCase} from "./codec";
import {kProtocolVersion} from "./codec";

/** Requested images: camera by its name in the robot description; `width` is 640, 320 or 160 pixels. */
export interface ImageRequest {
  camera: string;
  width: number;
}

/** @param robot  name of the robot to watch; empty: the gateway chooses. @param joinKey  of a second connection. */
export function connect(token: string, clientName: string, clientSoftware: string, robot = "", joinKey = ""): UseCase {
  const value = create(pb.ConnectSchema,
                       {protocolVersion: kProtocolVersion, token, clientName, clientSoftware, robot, joinKey});
  return {case: "connect", value};
}

export function join(clientId: number, key: string): UseCase {
  return {case: "join", value: create(pb.JoinSchema, {clientId, key})};
}

/** What is streamed beside states and images: what the robot says, does by itself, and sees. */
export interface MoreStreams {
  audio?: boolean;
  playState?: boolean;
  vision?: boolean;
}

/** @param stateRate states a second, @param imageRate images a second. */
export function subscribe(stateRate: number, imageRate: number, request: ImageRequest,
                          more: MoreStreams = {}): UseCase {
  const image = create(pb.ImageRequestSchema, request);
  return {case: "subscribe", value: create(pb.SubscribeSchema, {stateRate, imageRate, image, ...more})};
}

/** Commanded velocity: m/s forward, m/s to the left, rad/s to the left. @param isHeld  with all zero: the robot steps in place. */
export function walkTurn(vx: number, vy: number, wz: number, isHeld = false): UseCase {
  return {case: "walkTurn", value: create(pb.WalkTurnSchema, {vx, vy, wz, isHeld})};
}

/** Goal relative to the robot: m forward, m to the left, rad to the left. */
export function moveTo(x: number, y: number, theta: number): UseCase {
  return {case: "moveTo", value: create(pb.MoveToSchema, {x, y, theta})};
}

export function goToPosture(posture: string): UseCase {
  return {case: "goToPosture", value: create(pb.GoToPostureSchema, {posture})};
}

/** Changes about a group's axes, rad (hands: opening, in `pitch`). */
export interface JointChange {
  group: string;
  yaw: number;
  pitch: number;
  roll: number;
  /** True: the group of the other side makes the mirrored change. */
  bothSides?: boolean;
}

export function changeJoints(change: JointChange): UseCase {
  return {case: "changeJoints", value: create(pb.ChangeJointsSchema, change)};
}

/** Stiffness of a group's joints, 0 (limp) to 1, without turning them. */
export function setStiffness(group: string, stiffness: number): UseCase {
  return {case: "changeJoints", value: create(pb.ChangeJointsSchema, {group, stiffness})};
}

/** Three coordinates, m. */
export type Point = readonly [x: number, y: number, z: number];

/** Pulls a point fixed to a link of a simulated robot to a target in the torso's frame. */
export function drag(link: string, [pointX, pointY, pointZ]: Point, [targetX, targetY, targetZ]: Point): UseCase {
  return {case: "drag", value: create(pb.DragSchema, {link, pointX, pointY, pointZ, targetX, targetY, targetZ})};
}

export function getMotion(name: string): UseCase {
  return {case: "getMotion", value: create(pb.GetMotionSchema, {name})};
}

/** A motion as keyframes, or as the text of a file. */
export type MotionSource = {motion: pb.Motion} | {yaml: string};

/** @param replace  true: also if a motion of this name is saved. */
export function saveMotion(source: MotionSource, replace: boolean): UseCase {
  return {case: "saveMotion", value: create(pb.SaveMotionSchema, {motion: source, replace})};
}

export function deleteMotion(name: string): UseCase {
  return {case: "deleteMotion", value: create(pb.DeleteMotionSchema, {name})};
}

export function doAction(action: string): UseCase {
  return {case: "doAction", value: create(pb.DoActionSchema, {action})};
}

/** @param target  where the ball shall go, m, in the odometry frame; none: the opponent's goal. */
export function play(behavior: pb.Play_Behavior, target?: {x: number; y: number}): UseCase {
  return {case: "play", value: create(pb.PlaySchema, {behavior, targetX: target?.x, targetY: target?.y})};
}

/** @param language  BCP 47 tag; empty: the speaker's default. */
export function sayText(text: string, language: string): UseCase {
  return {case: "say", value: create(pb.SaySchema, {text, language})};
}

export const stopSpeaking = (): UseCase =>
    ({case: "say", value: create(pb.SaySchema, {operation: pb.Say_Operation.STOP})});

/** One colour, 0xRRGGBB, for several lights, until it is replaced. */
export function setLights(names: readonly string[], rgb: number): UseCase {
  return {case: "setLights", value: create(pb.SetLightsSchema,
                                           {lightNames: [...names], lightRgb: names.map(() => rgb)})};
}

export const stop = (): UseCase => ({case: "stop", value: create(pb.StopSchema)});
/** @param robot  name of the robot; empty: the one that is watched. */
/** @param wait  True: if it is refused this client is the next one. */
export const takeControl = (robot = "", wait = false): UseCase =>
    ({case: "takeControl", value: create(pb.TakeControlSchema, {robot, wait})});
export const watchRobot = (robot: string): UseCase =>
    ({case: "watchRobot", value: create(pb.WatchRobotSchema, {robot})});
/** @param successorId  the client that waits; 0: none. */
export const releaseControl = (successorId = 0): UseCase =>
    ({case: "releaseControl", value: create(pb.ReleaseControlSchema, {successorId})});

/** @param clientUtime this page's clock, microseconds; comes back in the Pong. */
export function ping(clientUtime: number): UseCase {
  return {case: "ping", value: create(pb.PingSchema, {clientUtime: BigInt(clientUtime)})};
}
