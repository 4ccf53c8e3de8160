/** A gateway without a robot behind it: speaks the protocol, serves the app and the robot's files, and
 * moves the joints of an imaginary robot straight to where they are sent. For tests of the app and
 * for work on it where nothing else is built; what the real gateway does is its own tests' business. */
import {create, fromBinary, toBinary} from "@bufbuild/protobuf";
import type {MessageInitShape} from "@bufbuild/protobuf";
import {createServer} from "node:http";
import type {IncomingMessage, Server, ServerResponse} from "node:http";
import {readFile} from "node:fs/promises";
import {extname, join, normalize} from "node:path";
import type {AddressInfo} from "node:net";
import {WebSocketServer} from "ws";
import type {WebSocket} from "ws";
import * as pb from "../src/protocol/generated/remote_pb";
import {FakeMotions} from "./fake_motions";

const kStatePeriodMs = 33;
const kImagePeriodMs = 100;
const kPlayPeriodMs = 200;
/** The imaginary ball, m, in the odometry frame. */
const kBall = {x: 0.5, y: -0.2};
/** Speed of the imaginary joints, rad/s. */
const kJointSpeed = 1.5;
/** Time that checking a motion takes, ms. */
const kCheckMs = 300;
const kTypes: Record<string, string> = {
  ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml",
  ".png": "image/png", ".webmanifest": "application/manifest+json", ".glb": "model/gltf-binary",
  ".urdf": "application/xml", ".yaml": "text/yaml",
};

const kLights = [
  {name: "left-eye", link: "Head", discs: [{center: [0.0528, 0.0285, 0.0479], normal: [0.915, 0.3975, -0.0696],
                                           radius: 0.0126, innerRadius: 0.0087}]},
  {name: "right-eye", link: "Head", discs: [{center: [0.0528, -0.0285, 0.0479], normal: [0.915, -0.3975, -0.0696],
                                            radius: 0.0126, innerRadius: 0.0087}]},
  {name: "chest", link: "torso", discs: [{center: [0.0631, 0, 0.0531], normal: [0.9977, 0, -0.0685],
                                         radius: 0.0063}]},
];

/** Three robots beside it, which cannot be chosen: one is driven, one is away. */
const kMatch = {
  robots: {robots: [{name: "NAO", model: "nao", team: 0, number: 2, isAvailable: true},
                    {name: "NAO2", model: "nao", team: 0, number: 3, isAvailable: true, driverId: 99, driverName: "Ana"},
                    {name: "NAO3", model: "nao", team: 1, number: 2, isAvailable: true},
                    {name: "NAO4", model: "nao", team: 1, number: 3}]},
  match: {phase: pb.Match_Phase.PLAYING, half: 1, timeLeft: 272, score0: 1, score1: 2},
};

/** Where the imaginary robot can go: joint angles, rad, torso height, m, and pitch, rad. */
export interface FakePosture {
  angles: Record<string, number>;
  height: number;
  pitch: number;
}

export interface FakeGatewayOptions {
  /** Folder that holds web/, robots/ and scenes/, as share/nao-remote does. */
  dataDir: string;
  token: string;
  joints: {name: string; lower: number; upper: number; maxVelocity?: number; mirrorJoint?: string;
           mirrorSign?: number}[];
  jointGroups: {name: string; yawJoint?: string; pitchJoint?: string; rollJoint?: string;
                isOpening?: boolean}[];
  postures: Record<string, FakePosture>;
  actionRoles: {name: string; kind: string; side: string}[];
  labels: {kind: string; name: string; language: string; text: string}[];
  /** JPEG of the head image for a time in s; without it no images are sent. */
  image?: (time: number) => Uint8Array;
  /** True: it sees a ball, and plays as far as it is told to. */
  plays?: boolean;
  /** True: it is one of several robots, in a match. */
  hasMatch?: boolean;
}

/** What it sends, with the fields that are not zero. */
type Message = MessageInitShape<typeof pb.ServerMessageSchema>["message"];
type Result = MessageInitShape<typeof pb.ResponseSchema>["result"];

interface Phone {
  id: number;
  name: string;
  isConnected: boolean;
  socket: WebSocket;
  states: boolean;
  images: boolean;
}

export class FakeGateway {
  /** Every use case received, oldest first. */
  readonly received: pb.Request[] = [];
  mode = pb.Mode.HOLDING;
  posture = "";
  /** Refusal for the next command, if any. */
  refuseNext: {error: pb.ErrorCode; message: string} | null = null;
  private readonly motions = new FakeMotions();
  /** Action being executed, and since when, s. */
  private playing = {name: "", since: 0};
  private behavior = pb.Play_Behavior.NONE;
  private readonly http: Server;
  private readonly sockets: WebSocketServer;
  private readonly phones = new Set<Phone>();
  private readonly angle: number[];
  private readonly target: number[];
  private height: number;
  private pitch = 0;
  private heading = 0;
  private x = 0;
  private y = 0;
  private drive = {vx: 0, vy: 0, wz: 0};
  private lastDriveMs = 0;
  private driverId = 0;
  /** The phone that waits for control; 0: none. */
  private nextId = 0;
  private lastId = 0;
  private time = 0;
  private readonly lightRgb = kLights.map(() => 0);
  private readonly timers: ReturnType<typeof setInterval>[] = [];

  constructor(private readonly options: FakeGatewayOptions) {
    this.posture = Object.keys(options.postures)[0] ?? "";
    const first = options.postures[this.posture];
    this.target = options.joints.map(({name}) => first?.angles[name] ?? 0);
    this.angle = [...this.target];
    this.height = first?.height ?? 0.333;
    this.http = createServer((request, response) => void this.serve(request, response));
    this.sockets = new WebSocketServer({server: this.http, path: "/ws"});
    this.sockets.on("connection", (socket) => this.welcome(socket));
  }

  /** @param port  0 for any. @return the page's URL with the token. */
  async start(port = 0): Promise<string> {
    await new Promise<void>((resolve) => this.http.listen(port, "127.0.0.1", resolve));
    this.timers.push(setInterval(() => this.tick(), kStatePeriodMs),
                     setInterval(() => this.sendImage(), kImagePeriodMs));
    if (this.options.plays) this.timers.push(setInterval(() => this.sendPlay(), kPlayPeriodMs));
    return `http://127.0.0.1:${this.port}/#token=${this.options.token}`;
  }

  get port(): number {
    return (this.http.address() as AddressInfo).port;
  }

  async stop(): Promise<void> {
    this.timers.forEach(clearInterval);
    for (const phone of this.phones) phone.socket.terminate();
    this.sockets.close();
    await new Promise((resolve) => this.http.close(resolve));
  }

  /** Says something unasked to every phone. */
  notice(notice: MessageInitShape<typeof pb.NoticeSchema>): void {
    for (const phone of this.phones) send(phone, {case: "notice", value: notice});
  }

  private async serve(request: IncomingMessage, response: ServerResponse): Promise<void> {
    const asked = normalize(new URL(request.url ?? "/", "http://x").pathname);
    const path = asked === "/scene.yaml" ? "/scenes/soccer.yaml" : asked;
    const file = /^\/(robots|scenes)\//.test(path) ? path : join("/web", path === "/" ? "index.html" : path);
    try {
      const bytes = await readFile(join(this.options.dataDir, file));
      response.writeHead(200, {"Content-Type": kTypes[extname(file)] ?? "application/octet-stream"});
      response.end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  }

  private welcome(socket: WebSocket): void {
    const phone: Phone = {id: ++this.lastId, name: "", isConnected: false, socket, states: false,
                          images: false};
    this.phones.add(phone);
    socket.on("message", (data: Buffer) => this.receive(phone, fromBinary(pb.RequestSchema, data)));
    socket.on("close", () => {
      this.phones.delete(phone);
      if (this.driverId === phone.id) this.setDriver(0);
    });
  }

  private receive(phone: Phone, request: pb.Request): void {
    this.received.push(request);
    const {requestId} = request;
    const answer = (error: pb.ErrorCode, message = "", result?: Result): void =>
        send(phone, {case: "response", value: {requestId, error, message, result}});
    const {useCase} = request;
    if (useCase.case === "connect") return this.connect(phone, useCase.value, answer);
    if (!phone.isConnected) return answer(pb.ErrorCode.NOT_CONNECTED, "Connect first.");
    switch (useCase.case) {
      case "subscribe":
        phone.states = useCase.value.stateRate > 0;
        phone.images = useCase.value.imageRate > 0;
        return answer(pb.ErrorCode.OK);
      case "ping":
        return answer(pb.ErrorCode.OK, "", {case: "pong", value: {clientUtime: useCase.value.clientUtime, numClients: this.phones.size}});
      case "takeControl":
        if (this.driverId !== 0 && this.driverId !== phone.id) {
          if (useCase.value.wait && this.nextId === 0) {
            this.nextId = phone.id;
            this.tellControl();
          }
          return answer(pb.ErrorCode.CONTROL_TAKEN, `${this.nameOf(this.driverId)} drives.`,
                        {case: "control", value: this.control(phone)});
        }
        this.setDriver(phone.id);
        return answer(pb.ErrorCode.OK, "", {case: "control", value: this.control(phone)});
      case "releaseControl":
        if (this.nextId === phone.id) this.nextId = 0;
        if (this.driverId === phone.id) this.setDriver(useCase.value.successorId === this.nextId ? this.nextId : 0);
        return answer(pb.ErrorCode.OK, "", {case: "control", value: this.control(phone)});
      case "stop":
        this.playing.name = "";
        this.behavior = pb.Play_Behavior.NONE;
        this.target.splice(0, this.target.length, ...this.angle);
        this.drive = {vx: 0, vy: 0, wz: 0};
        return answer(pb.ErrorCode.OK);
      case "getMotion": {
        const file = this.motions.get(useCase.value.name);
        return file ? answer(pb.ErrorCode.OK, "", {case: "motionFile", value: file})
            : answer(pb.ErrorCode.INVALID_ARGUMENT, "There is no such motion.");
      }
      default:
        return this.move(phone, request, answer);
    }
  }

  /** Answers later than other requests, as the real gateway does: checking takes some time. */
  private saveMotion(phone: Phone, requestId: number, request: pb.SaveMotion): void {
    setTimeout(() => {
      send(phone, {case: "response", value: {requestId, ...this.motions.save(request)}});
      this.tellMotions();
    }, kCheckMs);
  }

  private tellMotions(): void {
    this.notice({kind: pb.Notice_Kind.MOTIONS_CHANGED, motions: {names: this.motions.names}});
  }

  private move(phone: Phone, {useCase, requestId}: pb.Request,
               answer: (error: pb.ErrorCode, message?: string) => void): void {
    if (this.driverId !== phone.id) return answer(pb.ErrorCode.NO_CONTROL, "You do not drive.");
    if (this.refuseNext) {
      const {error, message} = this.refuseNext;
      this.refuseNext = null;
      return answer(error, message);
    }
    switch (useCase.case) {
      case "walkTurn": {
        const {vx, vy, wz} = useCase.value;
        this.drive = {vx, vy, wz};
        this.lastDriveMs = Date.now();
        break;
      }
      case "goToPosture": {
        const posture = this.options.postures[useCase.value.posture];
        if (!posture) return answer(pb.ErrorCode.INVALID_ARGUMENT, "There is no such posture.");
        this.options.joints.forEach(({name}, i) => this.target[i] = posture.angles[name] ?? 0);
        this.height = posture.height;
        this.pitch = posture.pitch;
        this.posture = useCase.value.posture;
        break;
      }
      case "changeJoints": {
        const group = this.options.jointGroups.find(({name}) => name === useCase.value.group);
        if (!group) return answer(pb.ErrorCode.INVALID_ARGUMENT, "There is no such joint group.");
        this.turn(group.yawJoint, useCase.value.yaw);
        this.turn(group.pitchJoint, useCase.value.pitch);
        this.turn(group.rollJoint, useCase.value.roll);
        this.posture = "";
        break;
      }
      case "setLights":
        useCase.value.lightNames.forEach((name, i) =>
            this.lightRgb[kLights.findIndex((light) => light.name === name)] = useCase.value.lightRgb[i] ?? 0);
        break;
      case "saveMotion": return this.saveMotion(phone, requestId, useCase.value);
      case "deleteMotion":
        if (!this.motions.delete(useCase.value.name)) return answer(pb.ErrorCode.INVALID_ARGUMENT, "There is no such motion.");
        this.tellMotions();
        break;
      case "play":
        this.behavior = useCase.value.behavior;
        break;
      case "doAction":
        this.playing = {name: useCase.value.action, since: this.time};
        break;
      default: break;
    }
    answer(pb.ErrorCode.OK);
    if (useCase.case === "goToPosture" || useCase.case === "doAction" || useCase.case === "say") {
      send(phone, {case: "notice", value: {kind: pb.Notice_Kind.COMMAND_RESULT, requestId, status: pb.Notice_Status.ACCEPTED}});
    }
  }

  /** The ball to the right ahead, a robot beside it, a line, and a pose in the own half. */
  private sendPlay(): void {
    const utime = BigInt(Math.round(this.time * 1e6));
    const isPlaying = this.behavior !== pb.Play_Behavior.NONE;
    const phase = isPlaying ? pb.PlayState_Phase.APPROACH : pb.PlayState_Phase.IDLE;
    const kind = pb.Vision_Detection_Kind;
    const vision = {
      utime, camera: "top",
      detections: [{kind: kind.BALL, box: [0.6, 0.6, 0.7, 0.74], position: [0.5, -0.2]},
                   {kind: kind.ROBOT, box: [0.1, 0.2, 0.3, 0.8], position: [0.7, 0.4], covariance: [0.01, 0, 0.002]},
                   {kind: kind.LINE, box: [0, 0.4, 1, 0.5], line: [0, 0.5, 1, 0.4], position: [0.6, 0.5, 0.8, -0.5]}],
      ball: {...kBall, age: 0.1, covariance: [0.004, 0, 0.001]},
      fieldPose: {x: this.x - 2, y: this.y, theta: this.heading, covariance: [0.02, 0.005, 0.01, 0.001]},
    };
    for (const phone of this.phones) {
      if (!phone.isConnected) continue;
      send(phone, {case: "playState", value: {utime, behavior: this.behavior, phase}});
      send(phone, {case: "vision", value: vision});
    }
  }

  private turn(joint: string | undefined, change: number): void {
    const index = this.options.joints.findIndex(({name}) => name === joint);
    const limits = this.options.joints[index];
    if (!limits) return;
    this.target[index] = Math.min(Math.max(this.target[index]! + change, limits.lower), limits.upper);
  }

  private connect(phone: Phone, {protocolVersion, token, clientName}: pb.Connect,
                  answer: (error: pb.ErrorCode, message?: string, result?: Result) => void): void {
    if (protocolVersion !== 1) return answer(pb.ErrorCode.WRONG_VERSION, "This gateway speaks 1.");
    if (token !== this.options.token) return answer(pb.ErrorCode.WRONG_TOKEN, "");
    phone.name = clientName || `Phone ${phone.id}`;
    phone.isConnected = true;
    const {joints, jointGroups, postures, actionRoles, labels} = this.options;
    const [readyPosture, standPosture, restPosture] = ["StandInit", "Stand", "Crouch"];
    answer(pb.ErrorCode.OK, "", {case: "connected", value: {
      protocolVersion: 1, serverVersion: "fake", clientId: phone.id, clientName: phone.name,
      control: this.control(phone),
      ...(this.options.hasMatch ? kMatch : {}),
      robot: {name: "NAO", urdfPath: "/robots/nao/nao.urdf", joints, jointGroups, actionRoles,
              labels, actions: actionRoles.map(({name}) => name), savedMotions: this.motions.names,
              isSimulated: true, readyPosture, standPosture,
              restPosture, cameraGroup: jointGroups[0]?.name ?? "",
              postures: Object.keys(postures), maxVx: 0.2, minVx: -0.2, maxVy: 0.15, maxWz: 1,
              model: "nao", cameras: ["top", "bottom"], languages: ["en", "de", "es", "fr", "it", "pt"],
              lights: kLights},
    }});
  }

  private control(phone: Phone): pb.Control {
    return create(pb.ControlSchema, {driverId: this.driverId, driverName: this.nameOf(this.driverId),
                                     isMine: this.driverId === phone.id, nextId: this.nextId,
                                     nextName: this.nameOf(this.nextId)});
  }

  private nameOf(id: number): string {
    return [...this.phones].find((phone) => phone.id === id)?.name ?? "";
  }

  private setDriver(id: number): void {
    this.driverId = id;
    this.nextId = 0;
    this.tellControl();
  }

  private tellControl(): void {
    for (const phone of this.phones) {
      if (!phone.isConnected) continue;
      send(phone, {case: "notice", value: {kind: pb.Notice_Kind.CONTROL_CHANGED, control: this.control(phone)}});
    }
  }

  private tick(): void {
    const dt = kStatePeriodMs / 1000;
    this.time += dt;
    const activity = this.play();
    this.target.forEach((target, i) => {
      const step = kJointSpeed * dt;
      this.angle[i]! += Math.min(Math.max(target - this.angle[i]!, -step), step);
    });
    if (Date.now() - this.lastDriveMs > 500) this.drive = {vx: 0, vy: 0, wz: 0};
    this.heading += this.drive.wz * dt;
    const [c, s] = [Math.cos(this.heading), Math.sin(this.heading)];
    this.x += (this.drive.vx * c - this.drive.vy * s) * dt;
    this.y += (this.drive.vx * s + this.drive.vy * c) * dt;
    const isWalking = this.drive.vx !== 0 || this.drive.vy !== 0 || this.drive.wz !== 0;
    const state = {
      utime: BigInt(Math.round(this.time * 1e6)), ageMs: 4, jointPosition: this.angle,
      torsoOrientation: orientationOf(this.heading, this.pitch),
      torsoPosition: [this.x, this.y, this.height],
      mode: isWalking ? pb.Mode.WALKING : this.mode, posture: isWalking ? "" : this.posture,
      ...activity, stiffness: 1, lightRgb: this.lightRgb,
    };
    for (const phone of this.phones) if (phone.states) send(phone, {case: "state", value: state});
  }

  /** Sends the joints to the keyframe that the action is at. @return what a state says of it. */
  private play(): {progress: number; mode?: pb.Mode; activity?: {kind: pb.CommandKind; name: string}} {
    const {name, since} = this.playing;
    const time = this.time - since;
    const keyframe = this.motions.keyframeAt(name, time);
    if (!keyframe) return {progress: -1};
    for (const [i, joint] of keyframe.jointNames.entries()) {
      const index = this.options.joints.findIndex((one) => one.name === joint);
      if (index >= 0) this.target[index] = keyframe.jointPosition[i]!;
    }
    return {progress: time / this.motions.timeOf(name), mode: pb.Mode.ACTING,
            activity: {kind: pb.CommandKind.ACTION, name}};
  }

  private sendImage(): void {
    const jpeg = this.options.image?.(this.time);
    if (!jpeg) return;
    const image = {utime: BigInt(Math.round(this.time * 1e6)), ageMs: 20, camera: "top", width: 320, height: 240, jpeg};
    for (const phone of this.phones) if (phone.images) send(phone, {case: "image", value: image});
  }
}

/** Heading about z after pitch about y, rad, as a quaternion (w, x, y, z). */
function orientationOf(heading: number, pitch: number): number[] {
  const [c, s] = [Math.cos(heading / 2), Math.sin(heading / 2)];
  const [cp, sp] = [Math.cos(pitch / 2), Math.sin(pitch / 2)];
  return [c * cp, -s * sp, c * sp, s * cp];
}

function send(phone: Phone, message: Message): void {
  phone.socket.send(toBinary(pb.ServerMessageSchema, create(pb.ServerMessageSchema, {message})));
}
