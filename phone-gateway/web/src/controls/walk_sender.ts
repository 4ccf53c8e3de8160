/** Repeats the walk command while a control is held, and ends it once when the last one is released. */
import type {Drive} from "./stick";
import {addDrives} from "./stick";

/** Twice as often as the gateway needs it, so that one lost frame is not a stumble; ms. */
export const kWalkPeriodMs = 100;

/** A changed command is sent at once, but not more often than this; ms. */
const kMinPeriodMs = 30;

export type DriveSource = "sticks" | "keys" | "gamepad" | "tilt";

export class WalkSender {
  private readonly drives = new Map<DriveSource, Drive>();
  private timer: ReturnType<typeof setInterval> | undefined;
  private lastSentMs = 0;

  /** @param publish  takes the walk command to the robot. @param now  ms. */
  constructor(private readonly publish: (drive: Drive) => void,
              private readonly now: () => number = () => performance.now()) {}

  /** Sets the command of a source; null when it is released. A held source at zero keeps the walk alive. */
  set(source: DriveSource, drive: Drive | null): void {
    const wasDriving = this.drives.size > 0;
    if (drive) this.drives.set(source, drive);
    else this.drives.delete(source);
    if (this.drives.size > 0 && !wasDriving) this.begin();
    else if (this.drives.size > 0 && this.now() - this.lastSentMs >= kMinPeriodMs) this.send();
    if (this.drives.size === 0 && wasDriving) this.end();
  }

  /** Releases all sources at once: page hidden, link lost, stop pressed. */
  release(): void {
    if (this.drives.size === 0) return;
    this.drives.clear();
    this.end();
  }

  /** Sum of all held sources. */
  get drive(): Drive {
    return addDrives([...this.drives.values()]);
  }

  private begin(): void {
    this.send();
    this.timer = setInterval(() => this.send(), kWalkPeriodMs);
  }

  private end(): void {
    clearInterval(this.timer);
    this.send();
  }

  private send(): void {
    this.lastSentMs = this.now();
    this.publish(this.drive);
  }
}
