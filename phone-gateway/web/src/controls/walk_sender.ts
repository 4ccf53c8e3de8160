/** Repeats the walk command while a control is held, and ends it once when the last one is released. */
import {Repeater} from "./repeater";
import type {Drive} from "./stick";
import {addDrives} from "./stick";

/** Time after a walk's last command at which the gateway ends the walk, ms. */
export const kWalkTimeoutMs = 500;
/** Period of the commands, ms: four of five may be lost. */
export const kWalkPeriodMs = kWalkTimeoutMs / 5;

/** A changed command is sent at once, but not more often than this; ms. */
const kMinPeriodMs = 30;

/** A gamepad or a sensor that tells nothing new for so long is not held any more; ms. Chosen: a hand trembles, and moves
 * every axis within a fraction of it. */
export const kSilenceMs = 1000;

/** A page that was held up for so long, as in a computer that slept, has not heard of what was released meanwhile; ms.
 * Chosen: the robot has ended the walk after a third of it, and no page that draws is held up as long. */
const kHeldUpMs = 3000;

export type DriveSource = "sticks" | "keys" | "gamepad" | "tilt";

/** Sources of which the browser tells no end, when they go out of range or stop. */
const kMustShowLife: readonly DriveSource[] = ["gamepad", "tilt"];

export class WalkSender {
  private readonly drives = new Map<DriveSource, {drive: Drive; setMs: number}>();
  private readonly repeater = new Repeater(() => this.repeat(), kWalkPeriodMs);
  private lastSentMs = 0;
  /** Time of the repeater's last call, ms; NaN before the first one. */
  private lastRepeatMs = NaN;
  /** Called when the page was held up while something was held. */
  onHeldUp: () => void = () => this.release();
  private isLocked = false;

  /** @param publish  takes the walk command to the robot. `isLocked`: something is held, but the robot must stand. @param now
   * ms. */
  constructor(private readonly publish: (drive: Drive, isLocked: boolean) => void,
              private readonly now: () => number = () => performance.now()) {}

  /** Sets the command of a source; null when it is released. A held source at zero keeps the walk alive. A gamepad and a
   * sensor are set again while they are held, however little changes. */
  set(source: DriveSource, drive: Drive | null): void {
    const wasHeld = this.isHeld;
    if (drive) this.drives.set(source, {drive, setMs: this.now()});
    else if (!this.drives.delete(source)) return;
    if (!this.isHeld) this.end();
    else if (this.isLocked) return;
    else if (!wasHeld) this.repeater.start();
    else if (this.now() - this.lastSentMs >= kMinPeriodMs) this.send();
  }

  /** Releases all sources at once: page hidden or left, link lost, stop pressed, another motion begins. */
  release(): void {
    if (!this.isHeld) return;
    this.drives.clear();
    this.end();
  }

  /** While it is locked the robot stands; what is still held afterwards walks on. */
  lock(isLocked: boolean): void {
    if (isLocked === this.isLocked) return;
    this.isLocked = isLocked;
    if (!this.isHeld) return;
    if (isLocked) this.end();
    else this.repeater.start();
  }

  get isHeld(): boolean {
    return this.drives.size > 0;
  }

  /** Sum of all held sources; zero while locked. */
  get drive(): Drive {
    return addDrives(this.isLocked ? [] : [...this.drives.values()].map(({drive}) => drive));
  }

  private repeat(): void {
    const isHeldUp = this.now() - this.lastRepeatMs > kHeldUpMs;
    this.lastRepeatMs = this.now();
    if (isHeldUp) this.onHeldUp();
    else this.send();
  }

  private end(): void {
    this.repeater.stop();
    this.lastRepeatMs = NaN;
    this.send();
  }

  private send(): void {
    const now = this.now();
    for (const source of kMustShowLife) {
      if (now - (this.drives.get(source)?.setMs ?? now) > kSilenceMs) this.drives.delete(source);
    }
    if (!this.isHeld) {
      this.repeater.stop();
      this.lastRepeatMs = NaN;
    }
    this.lastSentMs = now;
    this.publish(this.drive, this.isHeld && this.isLocked);
  }
}
