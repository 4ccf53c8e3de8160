/** A short tour for first-time users: points at the real controls, which work meanwhile. */
import {el} from "../dom";
import {say} from "../text/texts";
import type {TextKey} from "../text/texts";

/** Air around the control that is pointed at, px. */
const kAir = 6;
/** Between the control and the words, and between them and the screen's edge, px. */
const kGap = 14;
/** Time to see what the control does before the next step, ms. */
const kSeenMs = 1500;

interface Step {
  text: TextKey;
  /** The control pointed at; the first one of these that is seen. */
  selector: string;
  /** Mode in which it is seen; undefined: both. */
  isInJointsMode?: boolean;
}

const kSteps: readonly Step[] = [
  {text: "tour.link", selector: ".link", isInJointsMode: false},
  {text: "tour.walk", selector: ".joystick-walk", isInJointsMode: false},
  {text: "tour.postures", selector: ".strips", isInJointsMode: false},
  {text: "tour.joints", selector: ".lock", isInJointsMode: false},
  {text: "tour.teach", selector: ".teach-bar", isInJointsMode: true},
  {text: "tour.stop", selector: ".stop"},
];

export interface TourActions {
  isJointsMode(): boolean;
  setJointsMode(isOn: boolean): void;
  /** It was seen to its end, or skipped. */
  ended(): void;
}

export class Tour {
  readonly element: HTMLElement;
  private readonly ring = el("div", {class: "tour-ring"});
  private readonly words = el("p", {id: "tour-words"});
  private readonly count = el("small", {class: "quiet"});
  private readonly bubble: HTMLElement;
  private readonly next: HTMLButtonElement;
  private readonly skip: HTMLButtonElement;
  private step = -1;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly onUse = (event: Event): void => this.used(event);
  /** Controls come into sight and move while the robot speaks. */
  private readonly observer = new ResizeObserver(() => this.place());

  /** @param root  holds the controls. */
  constructor(private readonly root: HTMLElement, private readonly act: TourActions) {
    this.next = el("button", {class: "button small primary", onclick: () => this.go(this.step + 1)});
    this.skip = el("button", {class: "button small", onclick: () => this.end()}, say("tour.skip"));
    this.bubble = el("div", {class: "tour-bubble", role: "dialog", "aria-label": say("tour.title"),
                             "aria-describedby": "tour-words", tabindex: -1},
                     this.words, el("div", {class: "tour-buttons"}, this.count, this.skip, this.next));
    this.element = el("div", {class: "tour", hidden: true}, this.ring, this.bubble);
  }

  get isRunning(): boolean {
    return this.step >= 0;
  }

  start(): void {
    this.leave();
    this.root.addEventListener("pointerdown", this.onUse, true);
    this.go(0);
  }

  /** The controls are out of sight: it is not seen, and begins again another time. */
  leave(): void {
    clearTimeout(this.timer);
    this.root.removeEventListener("pointerdown", this.onUse, true);
    this.observer.disconnect();
    this.element.hidden = true;
    this.step = -1;
  }

  private end(): void {
    this.leave();
    this.act.ended();
  }

  private go(index: number): void {
    clearTimeout(this.timer);
    const step = kSteps[index];
    if (!step) {
      this.act.setJointsMode(false);
      return this.end();
    }
    this.step = index;
    const {isInJointsMode: mode} = step;
    if (mode !== undefined && this.act.isJointsMode() !== mode) this.act.setJointsMode(mode);
    this.element.hidden = false;
    this.words.textContent = say(step.text);
    this.count.textContent = say("tour.step", {number: index + 1, total: kSteps.length});
    const isLast = index === kSteps.length - 1;
    this.next.textContent = say(isLast ? "tour.done" : "tour.next");
    this.skip.hidden = isLast;
    this.observer.disconnect();
    for (const part of this.root.querySelectorAll(`${step.selector}, .bottom`)) this.observer.observe(part);
    this.place();
    this.bubble.focus({preventScroll: true});
  }

  /** The control that is pointed at was used: the tour goes on by itself. */
  private used(event: Event): void {
    const step = kSteps[this.step];
    if (!step || !(event.target instanceof Element) || !event.target.closest(step.selector)) return;
    const {step: index} = this;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.go(index + 1), kSeenMs);
  }

  /** Puts the ring around the control, and the words where there is more room: above or below it. */
  private place(): void {
    const target = this.root.querySelector(kSteps[this.step]?.selector ?? "");
    if (!target) return;
    const box = target.getBoundingClientRect();
    const screen = this.root.getBoundingClientRect();
    const left = Math.max(box.left - kAir, screen.left + 2);
    const right = Math.min(box.right + kAir, screen.right - 2);
    const {style} = this.ring;
    style.left = `${left}px`;
    style.top = `${box.top - kAir}px`;
    style.width = `${right - left}px`;
    style.height = `${box.height + 2 * kAir}px`;
    this.ring.classList.toggle("is-round", Math.abs(box.width - box.height) < 2);
    const isBelow = box.top - screen.top < screen.bottom - box.bottom;
    this.bubble.style.top = isBelow ? `${box.bottom + kAir + kGap}px` : "auto";
    this.bubble.style.bottom = isBelow ? "auto" : `${screen.bottom - box.top + kAir + kGap}px`;
    const width = this.bubble.offsetWidth;
    const middle = (box.left + box.right - width) / 2;
    this.bubble.style.left = `${Math.min(Math.max(middle, screen.left + kGap), screen.right - width - kGap)}px`;
  }
}
