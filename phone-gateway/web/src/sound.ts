/** The page's Web Audio. Browsers allow sound only after a touch, and phones silence it at a call or when they are locked. */
export class Sound {
  private context: AudioContext | null = null;

  constructor() {
    for (const type of ["pointerdown", "pointerup", "keydown"]) document.addEventListener(type, () => this.resume());
    document.addEventListener("visibilitychange", () => {
      if (this.context && document.visibilityState === "visible") this.resume();
    });
  }

  /** Null while there is no sound. */
  get running(): AudioContext | null {
    return this.context?.state === "running" ? this.context : null;
  }

  private resume(): void {
    if (typeof AudioContext === "undefined" || this.running) return;
    this.context ??= new AudioContext();
    // Refused until the next touch.
    this.context.resume().catch(() => {});
  }
}
