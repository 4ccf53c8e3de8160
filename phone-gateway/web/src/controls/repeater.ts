/** Repeats a command while a control is held: the one place in the app that does. */
export class Repeater {
  private timer: ReturnType<typeof setInterval> | undefined;

  /** @param send  sends the command as it is now. @param periodMs  between two transmissions, ms. */
  constructor(private readonly send: () => void, private readonly periodMs: number) {}

  /** Sends at once, and again until stop(); nothing if it repeats already. */
  start(): void {
    if (this.timer !== undefined) return;
    this.timer = setInterval(this.send, this.periodMs);
    this.send();
  }

  stop(): void {
    clearInterval(this.timer);
    this.timer = undefined;
  }
}
