/** A transport that a test controls: the test opens and breaks the link, and sends messages. */
import {create, fromBinary, toBinary} from "@bufbuild/protobuf";
import type {MessageInitShape} from "@bufbuild/protobuf";
import * as pb from "../src/protocol/generated/remote_pb";
import type {Transport, TransportListener} from "../src/transport";

export class FakeTransport implements Transport {
  /** How often the app tried to connect. */
  numOpens = 0;
  readonly sent: pb.Request[] = [];
  answers = false;
  backlog = 0;
  another?: () => FakeTransport;
  private listener: TransportListener | null = null;

  open(listener: TransportListener): void {
    this.numOpens++;
    this.listener = listener;
  }

  send(bytes: Uint8Array): void {
    this.sent.push(fromBinary(pb.RequestSchema, bytes));
  }

  close(): void {
    this.listener = null;
  }

  backlogBytes(): number {
    return this.backlog;
  }

  somethingAnswers(): Promise<boolean> {
    return Promise.resolve(this.answers);
  }

  get isOpen(): boolean {
    return this.listener !== null;
  }

  opened(): void {
    this.listener?.opened();
  }

  broken(wasOpen: boolean): void {
    const listener = this.listener;
    this.listener = null;
    listener?.closed(wasOpen);
  }

  receive(message: MessageInitShape<typeof pb.ServerMessageSchema>["message"]): void {
    this.listener?.received(toBinary(pb.ServerMessageSchema, create(pb.ServerMessageSchema, {message})));
  }

  /** Answers the newest request of a kind. */
  answer(useCase: pb.Request["useCase"]["case"], error = pb.ErrorCode.OK, message = "",
         result?: MessageInitShape<typeof pb.ResponseSchema>["result"], reasonCode = ""): void {
    const request = this.sent.filter((one) => one.useCase.case === useCase).at(-1);
    if (!request) throw new Error(`no request ${useCase} was sent`);
    const {requestId} = request;
    this.receive({case: "response", value: {requestId, error, message, result, reasonCode}});
  }

  /** Lets the app in as client 7. @param others  robots beside the one that it watches. */
  welcome(robot = "NAO", others: readonly string[] = []): void {
    this.opened();
    const robots = others.length > 0 ? {robots: [robot, ...others].map((name) => ({name}))} : undefined;
    this.answer("connect", pb.ErrorCode.OK, "", {case: "connected", value: {
      protocolVersion: 1, clientId: 7, clientName: "Ana", control: {driverId: 0}, robot: {name: robot}, robots}});
  }

  /** The gateway tells that the app watches another robot. */
  changeRobot(name: string): void {
    this.receive({case: "notice", value: {
      kind: pb.Notice_Kind.ROBOT_CHANGED, robot: {name, savedMotions: ["bow"]}, control: {driverId: 3, driverName: "Ben"}}});
  }
}
