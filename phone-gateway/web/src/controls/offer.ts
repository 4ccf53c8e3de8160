/** Something that is offered above a place for some seconds, where the finger does not cover it. */

const kShownMs = 6000;
/** Between it and the side of what it lies in, px. */
const kAir = 12;

export class Offer {
  private timer: ReturnType<typeof setTimeout> | undefined;

  /** @param ended  called when it is taken back. */
  constructor(private readonly element: HTMLElement, private readonly ended: () => void = () => {}) {}

  /** @param x,y  px from the top left of what it lies in. @param width  of that, px. */
  show(x: number, y: number, width: number): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.clear(), kShownMs);
    this.element.hidden = false;
    const margin = this.element.offsetWidth / 2 + kAir;
    const left = Math.min(Math.max(x, margin), width - margin);
    this.element.style.transform = `translate(${left}px, ${y}px) translate(-50%, calc(-100% - 30px))`;
  }

  clear(): void {
    clearTimeout(this.timer);
    this.element.hidden = true;
    this.ended();
  }
}
