/** One short function for each thing the app asks for, so that nobody else builds messages. */
import {create} from "@bufbuild/protobuf";
import * as pb from "./generated/remote_pb";
import type {UseCase} from "./codec";
import {kProtocolVersion} from "./codec";

/** Which pictures the app wishes for; `width` is 640, 320 or 160 pixels. */
export interface PictureWish {
  camera: pb.Camera;
  width: number;
}

export function connect(token: string, clientName: string, clientSoftware: string): UseCase {
  const value = create(pb.ConnectSchema,
                       {protocolVersion: kProtocolVersion, token, clientName, clientSoftware});
  return {case: "connect", value};
}

/** @param stateRate states a second, @param pictureRate pictures a second. */
export function subscribe(stateRate: number, pictureRate: number, wish: PictureWish): UseCase {
  const picture = create(pb.PictureWishSchema, {camera: wish.camera, width: wish.width});
  return {case: "subscribe", value: create(pb.SubscribeSchema, {stateRate, pictureRate, picture})};
}

/** Shares of the gait's greatest speeds, -1 to 1: ahead, to the left, turning to the left. */
export function walkTurn(x: number, y: number, theta: number): UseCase {
  return {case: "walkTurn", value: create(pb.WalkTurnSchema, {x, y, theta})};
}

/** Relative to where the robot stands: m ahead, m to the left, rad to the left. */
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
  /** True: the other side does the same as in a mirror. */
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
