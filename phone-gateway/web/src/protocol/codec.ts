/** Bytes to messages and back; the only file that knows how protobuf is called. */
import {create, fromBinary, toBinary} from "@bufbuild/protobuf";
import type {MessageInitShape} from "@bufbuild/protobuf";
import {RequestSchema, ServerMessageSchema} from "./generated/remote_pb";
import type {ServerMessage} from "./generated/remote_pb";

/** Version of the protocol that this app speaks. */
export const kProtocolVersion = 1;

/** What a Request may ask for, with the fields that are not zero: `{case: "walkTurn", value: {vx: 0.1}}`; units as in
 * remote.proto. */
export type UseCase = Exclude<NonNullable<MessageInitShape<typeof RequestSchema>["useCase"]>, {case?: undefined}>;
/** The fields of one. */
export type UseCaseValue<Case extends UseCase["case"]> = Exclude<Extract<UseCase, {case: Case}>["value"], {$typeName: string}>;

/** Bytes of one Request, for one binary WebSocket frame. */
export function encodeRequest(requestId: number, useCase: UseCase): Uint8Array {
  // The clock of the day goes on while the phone sleeps, unlike that of the page.
  return toBinary(RequestSchema, create(RequestSchema, {requestId, sentAt: Date.now() / 1000, useCase}));
}

/** The message in one binary WebSocket frame, or null if the bytes are none. */
export function decodeServerMessage(bytes: Uint8Array): ServerMessage | null {
  try {
    return fromBinary(ServerMessageSchema, bytes);
  } catch {
    return null;
  }
}
