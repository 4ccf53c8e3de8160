/** Plays what the robot says on this phone, with the browser's Web Audio. */
import type {Audio} from "../protocol/generated/remote_pb";
import {AudioSchedule, toFloats} from "./audio_schedule";

export class AudioPlayer {
  private context: AudioContext | null = null;
  private schedule = new AudioSchedule();
  private readonly sources = new Set<AudioBufferSourceNode>();

  /** Browsers allow sound only after a touch: to be called while one is handled. */
  enable(): void {
    if (typeof AudioContext === "undefined") return;
    this.context ??= new AudioContext();
    void this.context.resume();
  }

  disable(): void {
    this.stop();
    void this.context?.close();
    this.context = null;
  }

  play(audio: Audio): void {
    const {context} = this;
    if (context?.state !== "running") return;
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

  private stop(): void {
    for (const source of this.sources) source.stop();
    this.sources.clear();
  }
}
