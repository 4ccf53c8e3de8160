/** Keeps a slow phone fluent: when frames take too long it draws fewer pixels, then no shadow, then it is exhausted. It never
 * goes back up by itself, so that the image does not pump. Pure. */

/** A frame longer than this is slow, s: below 40 frames a second. */
const kSlowFrame = 0.025;
/** Share of slow frames in a window at which quality goes one step down. */
const kTooManySlow = 0.5;
/** A window is at least this long, s, and has at least so many frames. */
const kWindow = 1;
const kWindowFrames = 6;
/** The first frames compile shaders and upload meshes; they say nothing about the phone. */
const kWarmUpFrames = 6;
const kStepDown = 0.75;

export class PixelBudget {
  private numFrames = -kWarmUpFrames;
  private numSlow = 0;
  private time = 0;
  /** There is nothing left to draw less of. */
  isExhausted = false;

  /** @param pixelRatio  device pixels per CSS pixel at full quality. @param minPixelRatio  at the least. */
  constructor(public pixelRatio: number, public hasShadow: boolean, private readonly minPixelRatio: number) {}

  /** Counts a frame. @param dt s. @return true if the quality has changed. */
  frame(dt: number): boolean {
    this.numFrames++;
    if (this.numFrames <= 0) return false;
    this.time += dt;
    if (dt > kSlowFrame) this.numSlow++;
    if (this.numFrames < kWindowFrames || this.time < kWindow) return false;
    const isSlow = this.numSlow > kTooManySlow * this.numFrames;
    this.numFrames = 0;
    this.numSlow = 0;
    this.time = 0;
    return isSlow && this.stepDown();
  }

  private stepDown(): boolean {
    if (this.pixelRatio > this.minPixelRatio) {
      this.pixelRatio = Math.max(this.minPixelRatio, this.pixelRatio * kStepDown);
      return true;
    }
    const changed = !this.isExhausted;
    this.isExhausted = !this.hasShadow;
    this.hasShadow = false;
    return changed;
  }
}
