/** End-to-end encryption between this phone and the gateway over nao-relay. The format, with its sources, is described in
 * phone-gateway/secure_channel/secure_channel.h. */
import {joinBytes} from "../join_bytes";

const kVersion = 1;
const kKeyLabel = new TextEncoder().encode("nao-remote relay 1");
const kPublicKeyBytes = 65;
const kHeaderBytes = 16;
const kTagBytes = 16;
const kCurve = {name: "ECDH", namedCurve: "P-256"};

type Bytes = Uint8Array<ArrayBuffer>;

/** What a link of `nao invite` has: robot and invitation, and the secret that only gateway and phone know. */
export interface Invitation {
  robot: string;
  id: Bytes;
  secret: Bytes;
}

/** @return null if the text is no invitation ("ROBOT.ID.SECRET", hexadecimal digits). */
export function parseInvitation(text: string): Invitation | null {
  const match = /^([0-9a-f]{32})\.([0-9a-f]{16})\.([0-9a-f]{32})$/.exec(text.trim());
  return match && {robot: match[1]!, id: fromHex(match[2]!), secret: fromHex(match[3]!)};
}

export function fromHex(hex: string): Bytes {
  return new Uint8Array((hex.match(/../g) ?? []).map((byte) => parseInt(byte, 16)));
}

/** The frames of one connection. Both functions are to be called in the order of the frames. */
export class SecureChannel {
  private numSealed = 0;
  private numOpened = 0;

  constructor(private readonly sealing: CryptoKey, private readonly opening: CryptoKey) {}

  seal(text: Uint8Array): Promise<Bytes> {
    const header = new Uint8Array(kHeaderBytes);
    const view = new DataView(header.buffer);
    view.setBigUint64(0, BigInt(this.numSealed++));
    view.setBigUint64(8, BigInt(this.numOpened));
    return crypto.subtle.encrypt(parameters(header), this.sealing, text as Bytes)
        .then((sealed) => joinBytes([header, new Uint8Array(sealed)]));
  }

  /** @throws Error  The frame was changed, replayed, or one before it is missing. */
  async open(frame: Bytes): Promise<Bytes> {
    if (frame.length < kHeaderBytes + kTagBytes) throw new Error("too short");
    const header = frame.slice(0, kHeaderBytes);
    const number = new DataView(header.buffer).getBigUint64(0);
    if (number !== BigInt(this.numOpened)) throw new Error(number < this.numOpened ? "replayed" : "out of order");
    const text = await crypto.subtle.decrypt(parameters(header), this.opening, frame.slice(kHeaderBytes));
    this.numOpened++;
    return new Uint8Array(text);
  }
}

function parameters(header: Bytes): AesGcmParams {
  return {name: "AES-GCM", iv: joinBytes([new Uint8Array(4), header.slice(0, 8)]), additionalData: header};
}

/** The phone's part of the handshake. */
export class Handshake {
  private constructor(private readonly key: CryptoKey, private readonly secret: Bytes, readonly hello: Bytes) {}

  /** @param keys  Made for this connection; others only in tests. */
  static async begin(invitation: Invitation, keys?: CryptoKeyPair): Promise<Handshake> {
    keys ??= await crypto.subtle.generateKey(kCurve, false, ["deriveBits"]);
    const publicKey = new Uint8Array(await crypto.subtle.exportKey("raw", keys.publicKey));
    return new Handshake(keys.privateKey, invitation.secret, joinBytes([new Uint8Array([kVersion]), invitation.id, publicKey]));
  }

  /** @throws Error  The answer is not of a gateway that knows the invitation's secret. */
  async finish(answer: Bytes): Promise<SecureChannel> {
    if (answer[0] !== kVersion) throw new Error("no answer");
    const publicKey = answer.slice(1, 1 + kPublicKeyBytes);
    const other = await crypto.subtle.importKey("raw", publicKey, kCurve, false, []);
    const shared = await crypto.subtle.deriveBits({name: "ECDH", public: other}, this.key, 256);
    const material = await crypto.subtle.importKey("raw", shared, "HKDF", false, ["deriveBits"]);
    const keys = await crypto.subtle.deriveBits(
        {name: "HKDF", hash: "SHA-256", salt: this.secret, info: joinBytes([kKeyLabel, this.hello, publicKey])}, material, 512);
    const half = (at: number, use: KeyUsage) => crypto.subtle.importKey("raw", keys.slice(at, at + 32), "AES-GCM", false, [use]);
    const channel = new SecureChannel(await half(0, "encrypt"), await half(32, "decrypt"));
    await channel.open(answer.slice(1 + kPublicKeyBytes));
    return channel;
  }
}
