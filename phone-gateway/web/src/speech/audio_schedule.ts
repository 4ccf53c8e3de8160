/** When each piece of what the robot says is played: one after the other, the first at once. */
import type {Audio} from "../protocol/generated/remote_pb";

/** A piece that comes later than its time begins this much after now, s: Wi-Fi's jitter is heard less. */
const kDelay = 0.08;
/** More than this is never ahead, s: the speaker is 0.5 s ahead at most. */
const kMaxAhead = 2;

export class AudioSchedule {
  private speech = 0;
  private end = 0;

  /** What is to be done with a piece. @param now  s on the player's clock.
   * @return isStop: what was scheduled before is not to be played; start: when to play it, s, NaN: nothing is to be played. */
  place(audio: Pick<Audio, "speech" | "sampleRate" | "samples" | "isLast">, now: number) {
    const isNew = audio.speech !== this.speech;
    this.speech = audio.speech;
    const numSamples = Math.floor(audio.samples.length / 2);
    if (numSamples === 0 || !isPlayable(audio.sampleRate)) {
      this.end = 0;
      return {isStop: true, start: NaN};
    }
    const start = isNew || this.end < now || this.end > now + kMaxAhead ? now + kDelay : this.end;
    this.end = start + numSamples / audio.sampleRate;
    return {isStop: isNew, start};
  }
}

/** Rates that every browser plays (Web Audio API, createBuffer). */
function isPlayable(sampleRate: number): boolean {
  return sampleRate >= 8000 && sampleRate <= 96000;
}

/** Samples as numbers from -1 to 1. @param bytes  signed 16-bit, low byte first. */
export function toFloats(bytes: Uint8Array): Float32Array<ArrayBuffer> {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const floats = new Float32Array(Math.floor(bytes.byteLength / 2));
  for (let i = 0; i < floats.length; i++) floats[i] = view.getInt16(2 * i, true) / 32768;
  return floats;
}
