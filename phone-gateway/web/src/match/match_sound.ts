/** The referee's whistle and a goal's fanfare, made by the browser's Web Audio. */
import {Match_Event} from "../protocol/generated/remote_pb";

/** Frequency, Hz, start and duration, s, of each tone. */
type Tone = readonly [frequency: number, start: number, duration: number];

const kWhistle: readonly Tone[] = [[2300, 0, 0.45]];
const kFinalWhistle: readonly Tone[] = [[2300, 0, 0.25], [2300, 0.35, 0.25], [2300, 0.7, 0.7]];
// C, E, G, C.
const kFanfare: readonly Tone[] = [[523, 0, 0.14], [659, 0.15, 0.14], [784, 0.3, 0.14], [1047, 0.45, 0.5]];
const kVolume = 0.12;
const kFade = 0.03;

const kTones: {readonly [event in Match_Event]?: readonly Tone[]} = {
  [Match_Event.GOAL]: kFanfare, [Match_Event.KICK_OFF]: kWhistle, [Match_Event.BALL_OUT]: kWhistle,
  [Match_Event.HALF_END]: kFinalWhistle, [Match_Event.MATCH_END]: kFinalWhistle};

export function tonesOf(event: Match_Event): readonly Tone[] {
  return kTones[event] ?? [];
}

/** @param context  null while there is no sound. */
export function playTones(context: AudioContext | null, tones: readonly Tone[]): void {
  if (!context) return;
  for (const [frequency, start, duration] of tones) {
    const gain = context.createGain();
    const tone = new OscillatorNode(context, {type: "triangle", frequency});
    const begin = context.currentTime + start;
    gain.gain.setValueAtTime(0, begin);
    gain.gain.linearRampToValueAtTime(kVolume, begin + kFade);
    gain.gain.setValueAtTime(kVolume, begin + duration - kFade);
    gain.gain.linearRampToValueAtTime(0, begin + duration);
    tone.connect(gain).connect(context.destination);
    tone.start(begin);
    tone.stop(begin + duration);
  }
}
