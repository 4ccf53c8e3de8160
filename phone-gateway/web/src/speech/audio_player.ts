/** Plays what the robot says on this phone, with the browser's Web Audio. */
import type {Audio} from "../protocol/generated/remote_pb";
import type {Sound} from "../sound";
import {AudioSchedule, toFloats} from "./audio_schedule";

export class AudioPlayer {
  private schedule = new AudioSchedule();
  private readonly sources = new Set<AudioBufferSourceNode>();

  constructor(private readonly sound: Sound) {}

  play(audio: Audio): void {
    const context = this.sound.running;
    if (!context) return;
    const {isStop, start} = this.schedule.place(audio, context.currentTime);
    if (isStop) this.stop();
    if (!Number.isFinite(start)) return;
    const samples = toFloats(audio.samples);
    const buffer = context.createBuffer(1, samples.length, audio.sampleRate);
    buffer.copyToChannel(samples, 0);
    const source = context.createBufferSource();
    source.buffer = buffer;
    source.connect(context.destination);
    source.onended = () => this.sources.delete(source);
    this.sources.add(source);
    source.start(start);
  }

  stop(): void {
    for (const source of this.sources) source.stop();
    this.sources.clear();
  }
}
