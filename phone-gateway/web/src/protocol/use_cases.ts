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

export function connect(token: string, clientName: string, clientSoftware: string): UseCase {
  const value = create(pb.ConnectSchema,
                       {protocolVersion: kProtocolVersion, token, clientName, clientSoftware});
  return {case: "connect", value};
}

/** @param stateRate states a second, @param imageRate images a second. */
export function subscribe(stateRate: number, imageRate: number, request: ImageRequest): UseCase {
  const image = create(pb.ImageRequestSchema, request);
  return {case: "subscribe", value: create(pb.SubscribeSchema, {stateRate, imageRate, image})};
}

/** Commanded velocity: m/s forward, m/s to the left, rad/s to the left. */
export function walkTurn(vx: number, vy: number, wz: number): UseCase {
  return {case: "walkTurn", value: create(pb.WalkTurnSchema, {vx, vy, wz})};
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

export function doAction(action: string): UseCase {
  return {case: "doAction", value: create(pb.DoActionSchema, {action})};
}

export const stop = (): UseCase => ({case: "stop", value: create(pb.StopSchema)});
export const takeControl = (): UseCase =>
    ({case: "takeControl", value: create(pb.TakeControlSchema)});
export const releaseControl = (): UseCase =>
    ({case: "releaseControl", value: create(pb.ReleaseControlSchema)});

/** @param clientUtime this page's clock, microseconds; comes back in the Pong. */
export function ping(clientUtime: number): UseCase {
  return {case: "ping", value: create(pb.PingSchema, {clientUtime: BigInt(clientUtime)})};
}
