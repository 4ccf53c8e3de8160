import {readFileSync} from "node:fs";
import {beforeAll, describe, expect, it} from "vitest";
import {fromHex, Handshake, parseInvitation} from "./secure_channel";

/** The vectors that the gateway's tests read too. */
const vectors = JSON.parse(readFileSync("../../test/phone-gateway/secure_channel/vectors.json", "utf8"));
const invitation = parseInvitation(`${"0".repeat(32)}.${vectors.invitation}.${vectors.secret}`)!;

async function begin(): Promise<Handshake> {
  const curve = {name: "ECDH", namedCurve: "P-256"};
  const privateKey = await crypto.subtle.importKey("pkcs8", fromHex(vectors.phone_key), curve, false, ["deriveBits"]);
  const publicKey = await crypto.subtle.importKey("raw", fromHex(vectors.hello).slice(9), curve, true, []);
  return Handshake.begin(invitation, {privateKey, publicKey});
}

describe("the secure channel", () => {
  let handshake: Handshake;
  beforeAll(async () => void (handshake = await begin()));

  it("makes and opens the frames of the gateway's own tests", async () => {
    expect(handshake.hello).toEqual(fromHex(vectors.hello));
    const channel = await handshake.finish(fromHex(vectors.answer));
    for (const {from, text, frame} of vectors.frames) {
      if (from === "phone") expect(await channel.seal(fromHex(text))).toEqual(fromHex(frame));
      else expect(await channel.open(fromHex(frame))).toEqual(fromHex(text));
    }
  });

  it("refuses changed, replayed and later frames", async () => {
    const channel = await handshake.finish(fromHex(vectors.answer));
    const frame = fromHex(vectors.frames[1].frame);
    const changed = frame.slice();
    changed[20]! ^= 1;
    await expect(channel.open(changed)).rejects.toThrow();
    await channel.open(frame);
    await expect(channel.open(frame)).rejects.toThrow("replayed");
    const later = frame.slice();
    later[7] = 9;
    await expect(channel.open(later)).rejects.toThrow("out of order");
    await expect(channel.open(frame.slice(0, 31))).rejects.toThrow("too short");
  });

  it("refuses who lacks the secret", async () => {
    const other = await Handshake.begin({...invitation, secret: new Uint8Array(16)});
    await expect(other.finish(fromHex(vectors.answer))).rejects.toThrow();
    const answer = fromHex(vectors.answer);
    answer[answer.length - 1]! ^= 1;
    await expect(handshake.finish(answer)).rejects.toThrow();
    await expect(handshake.finish(new Uint8Array([0, 1]))).rejects.toThrow("no answer");
  });

  it("tells an invitation from a token", () => {
    expect(parseInvitation("k7mq-3xpa")).toBeNull();
    expect(parseInvitation(`${"0".repeat(32)}.${"0".repeat(16)}.${"g".repeat(32)}`)).toBeNull();
    expect(invitation.secret).toEqual(fromHex(vectors.secret));
  });
});
