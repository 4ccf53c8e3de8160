/** A joystick on the screen. Each follows its own pointer, so that two fingers do not disturb each other. */
import {drawing, el} from "../dom";
import {stickValue} from "./stick";
import type {StickValue} from "./stick";

/** What the rim shows in a box of 100: the range of the touch. */
const kFourWays = "M45 14l5-5 5 5M45 86l5 5 5-5M14 45l-5 5 5 5M86 45l5 5-5 5";
const kTwoWays = "M14 62a40 40 0 0 1 8-32M22 38v-9h-9M86 62a40 40 0 0 0-8-32M78 38v-9h9";

export class Joystick {
  readonly element: HTMLElement;
  /** Position, or null while it is not touched. */
  value: StickValue | null = null;
  private readonly knob: HTMLElement;
  private readonly label: HTMLElement;
  private pointer: number | null = null;
  private centerX = 0;
  private centerY = 0;
  private radius = 1;

  /** @param isHorizontal  true if only left and right count. @param changed  called at each change.
   * @param keys  that do the same: up, left, down, right. */
  constructor(label: string, name: string, private readonly isHorizontal: boolean,
              private readonly changed: () => void, keys: readonly string[] = []) {
    this.knob = el("div", {class: "joystick-knob"});
    this.label = el("span", {class: "joystick-label"}, label);
    this.element = el("div", {
      class: `joystick joystick-${name}`, role: "application", tabindex: 0, "aria-label": label,
      onpointerdown: (event: PointerEvent) => this.down(event),
      onpointermove: (event: PointerEvent) => this.move(event),
      onpointerup: (event: PointerEvent) => this.up(event),
      onpointercancel: (event: PointerEvent) => this.up(event),
      onlostpointercapture: (event: PointerEvent) => this.up(event),
      oncontextmenu: (event: Event) => event.preventDefault(),
      onkeydown: (event: KeyboardEvent) => this.key(event, true),
      onkeyup: (event: KeyboardEvent) => this.key(event, false),
    }, drawing(isHorizontal ? kTwoWays : kFourWays, 100, "joystick-rim"), this.knob, this.label,
       ...keys.map((key) => el("kbd", {class: "key", "aria-hidden": "true", hidden: key === ""}, key)));
    // Secure pages hear of a move as it comes, others with the next frame.
    this.element.addEventListener("pointerrawupdate", (event) => this.move(event as PointerEvent));
  }

  relabel(label: string): void {
    this.label.textContent = label;
    this.element.setAttribute("aria-label", label);
  }

  /** Releases it, whichever pointer holds it. */
  release(): void {
    this.pointer = null;
    this.element.classList.remove("held");
    this.knob.style.transform = "";
    if (this.value === null) return;
    this.value = null;
    this.changed();
  }

  private down(event: PointerEvent): void {
    if (this.pointer !== null) return;
    event.preventDefault();
    this.pointer = event.pointerId;
    try {
      this.element.setPointerCapture(event.pointerId);
    } catch {
      // The finger has left already; pointerup has come or comes.
    }
    const box = this.element.getBoundingClientRect();
    this.centerX = box.left + box.width / 2;
    this.centerY = box.top + box.height / 2;
    this.radius = box.width * 0.36;
    this.element.classList.add("held");
    this.move(event);
  }

  private move(event: PointerEvent): void {
    if (event.pointerId !== this.pointer) return;
    this.put(event.clientX - this.centerX,
             this.isHorizontal ? 0 : event.clientY - this.centerY);
  }

  private up(event: PointerEvent): void {
    if (event.pointerId === this.pointer) this.release();
  }

  /** Arrow keys, for people who cannot drag. */
  private key(event: KeyboardEvent, isDown: boolean): void {
    const direction = kArrows[event.key];
    if (!direction || (this.isHorizontal && direction[0] === 0)) return;
    event.preventDefault();
    event.stopPropagation();
    if (!isDown) return this.release();
    this.radius = this.element.clientWidth * 0.36;
    this.put(direction[0] * this.radius, direction[1] * this.radius);
  }

  private put(dx: number, dy: number): void {
    const scale = Math.min(1, this.radius / Math.max(Math.hypot(dx, dy), 1e-6));
    this.knob.style.transform = `translate(${dx * scale}px, ${dy * scale}px)`;
    this.value = stickValue(dx, dy, this.radius);
    this.changed();
  }
}

const kArrows: Record<string, readonly [number, number]> = {
  ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1],
};
