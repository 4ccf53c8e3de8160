/** Keeps a slow phone fluent: when frames take too long it draws fewer pixels, then the least. After a time without slow frames
 * it tries one step back up; each trial that fails doubles that time, so that the image does not pump. Pure. */

/** A frame longer than this is slow, s: below 40 frames a second. */
const kSlowFrame = 0.025;
/** Share of slow frames in a window at which quality goes one step down, and up to which it may go up. */
const kTooManySlow = 0.5;
const kFewSlow = 0.1;
/** A window is at least this long, s, and has at least so many frames. */
const kWindow = 1;
const kWindowFrames = 6;
/** The first frames compile shaders and upload meshes; they say nothing about the phone. */
const kWarmUpFrames = 6;
const kStepDown = 0.75;
/** Time without slow frames until a step up is tried, and until the trial counts as a success, s; and how often it doubles at
 * the most. Chosen: back soon after a busy moment, one change in five minutes on a phone that is slow for good. */
const kTrialTime = 10;
const kMostDoublings = 5;

export class PixelBudget {
  private numFrames = -kWarmUpFrames;
  private numSlow = 0;
  private time = 0;
  private fastTime = 0;
  private numFailed = 0;
  private isTrial = false;
  /** Steps down from full quality. */
  private level = 0;
  private readonly numRatioSteps: number;

  /** @param fullRatio  device pixels per CSS pixel at full quality. @param minRatio  at the least. */
  constructor(private readonly fullRatio: number, private readonly minRatio: number) {
    this.numRatioSteps = Math.max(0, Math.ceil(Math.log(minRatio / fullRatio) / Math.log(kStepDown)));
  }

  get pixelRatio(): number {
    return Math.max(this.minRatio, this.fullRatio * kStepDown ** this.level);
  }

  /** True: with the fewest pixels frames are slow; whatever else can be left out is left out. */
  get isLeast(): boolean {
    return this.level > this.numRatioSteps;
  }

  /** Counts a frame. @param dt s. @return true if the quality has changed. */
  frame(dt: number): boolean {
    this.numFrames++;
    if (this.numFrames <= 0) return false;
    this.time += dt;
    if (dt > kSlowFrame) this.numSlow++;
    if (this.numFrames < kWindowFrames || this.time < kWindow) return false;
    const {level} = this;
    const slow = this.numSlow / this.numFrames;
    if (slow > kTooManySlow) this.stepDown();
    else if (slow <= kFewSlow) this.countFast(this.time);
    else this.fastTime = 0;
    this.numFrames = this.numSlow = this.time = 0;
    return this.level !== level;
  }

  private stepDown(): void {
    if (this.isTrial) this.numFailed = Math.min(this.numFailed + 1, kMostDoublings);
    this.isTrial = false;
    this.fastTime = 0;
    if (!this.isLeast) this.level++;
  }

  private countFast(time: number): void {
    this.fastTime += time;
    if (this.isTrial && this.fastTime >= kTrialTime) {
      this.isTrial = false;
      this.numFailed = 0;
    }
    if (this.level === 0 || this.fastTime < kTrialTime * 2 ** this.numFailed) return;
    this.fastTime = 0;
    this.isTrial = true;
    this.level--;
  }
}
