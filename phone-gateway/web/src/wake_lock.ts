/** Keeps the screen on. A phone that sleeps hides the page, and what the robot does by itself ends. Browsers give the lock to
 * secure pages only, and take it back whenever the page is hidden. */
export class WakeLock {
  private lock: WakeLockSentinel | null = null;
  private isHeld = false;

  hold(): void {
    this.isHeld = true;
    void this.renew();
  }

  release(): void {
    this.isHeld = false;
    void this.lock?.release();
    this.lock = null;
  }

  /** The page is shown again. */
  async renew(): Promise<void> {
    if (!this.isHeld || (this.lock && !this.lock.released)) return;
    // Refused with a low battery: the screen sleeps, as the person has chosen.
    const lock = await navigator.wakeLock?.request("screen").catch(() => null);
    if (!this.isHeld) void lock?.release();
    else this.lock = lock ?? null;
  }
}
