/** The poses of the draft as rows: times at sight, the rest opens with a tap on a row's name. Rows stay in place
 * while values change, so that the keyboard's and the screen reader's focus stays, too. */
import {button, iconButton} from "../controls/press";
import {Stepper} from "../controls/stepper";
import {el} from "../dom";
import type {Store} from "../store";
import type {DraftEditor} from "../teach/draft_editor";
import {changeKeyframe, kMinDuration, moveKeyframe, onlyKeyframe, removeKeyframe} from "../teach/motion_draft";
import type {DraftKeyframe} from "../teach/motion_draft";
import type {Teach} from "../teach/teach";
import {say} from "../text/texts";
import {kDeleteIcon, kDownIcon, kPlayIcon, kUpIcon, kAddIcon} from "./icons";

/** Times below this are changed by the small step, s. */
const kCoarse = 2;
const kSmallStep = 0.1;
const kLargeStep = 0.5;

/** The next shorter or longer time, s. @param direction -1 or 1. */
export function steppedTime(time: number, direction: number): number {
  const step = time + direction * kSmallStep / 2 < kCoarse ? kSmallStep : kLargeStep;
  return Math.max(0, Math.round((time + direction * step) * 10) / 10);
}

interface Row {
  element: HTMLElement;
  up: HTMLButtonElement;
  down: HTMLButtonElement;
  update(keyframe: DraftKeyframe, isOpen: boolean, isBad: boolean): void;
}

export class KeyframeList {
  readonly element = el("ol", {class: "keyframes"});
  private readonly rows: Row[] = [];
  private opened = -1;

  constructor(private readonly store: Store, private readonly editor: DraftEditor, private readonly teach: Teach) {
    store.watch((state) => state.draft, () => this.show());
    store.watch((state) => state.motionFault, () => this.show());
  }

  private show(): void {
    const {draft: {keyframes}, motionFault} = this.store.get();
    while (this.rows.length < keyframes.length) this.rows.push(this.makeRow(this.rows.length));
    this.rows.length = keyframes.length;
    if (this.element.childElementCount !== keyframes.length) {
      this.element.replaceChildren(...this.rows.map((row) => row.element));
    }
    if (this.opened >= keyframes.length) this.opened = -1;
    const bad = motionFault && !motionFault.isUpload ? motionFault.keyframe : -1;
    for (const [i, row] of this.rows.entries()) row.update(keyframes[i]!, i === this.opened, i === bad);
  }

  private open(index: number): void {
    this.opened = this.opened === index ? -1 : index;
    this.show();
  }

  /** The row's number goes with the pose, and the finger stays on its button. */
  private move(index: number, by: number): void {
    const to = index + by;
    const row = this.rows[to];
    if (!row) return;
    this.opened = to;
    this.editor.change(moveKeyframe(this.editor.draft, index, by));
    (by < 0 ? row.up : row.down).focus();
  }

  private setTime(index: number, name: "duration" | "pause", direction: number): void {
    const keyframe = this.editor.draft.keyframes[index];
    if (!keyframe) return;
    const least = name === "duration" ? kMinDuration : 0;
    const time = Math.max(least, steppedTime(keyframe[name], direction));
    this.editor.change(changeKeyframe(this.editor.draft, index, {[name]: time}));
  }

  private makeRow(index: number): Row {
    const number = index + 1;
    const title = button({class: "pose-title", "aria-expanded": "false"}, () => this.open(index), say("teach.pose", {number}));
    const duration = new Stepper(say("motion.duration", {number}), true, (direction) => this.setTime(index, "duration", direction));
    const pause = new Stepper(say("motion.pause"), true, (direction) => this.setTime(index, "pause", direction));
    const up = iconButton("button small", kUpIcon, say("motion.earlier"), () => this.move(index, -1));
    const down = iconButton("button small", kDownIcon, say("motion.later"), () => this.move(index, 1));
    const more = el("div", {class: "pose-more"},
      el("div", {class: "row"}, el("span", {}, say("motion.pause")), pause.element),
      el("div", {class: "pose-buttons"}, up, down,
         iconButton("button small", kPlayIcon, say("motion.show"), () => this.teach.play(onlyKeyframe(this.editor.draft, index))),
         iconButton("button small", kAddIcon, say("motion.capture"), () => this.teach.capture(index)),
         iconButton("button small", kDeleteIcon, say("motion.remove"), () =>
             this.editor.change(removeKeyframe(this.editor.draft, index)))));
    const element = el("li", {}, el("div", {class: "pose-row"}, title, duration.element), more);
    return {element, up, down, update: (keyframe, isOpen, isBad) => {
      title.setAttribute("aria-expanded", String(isOpen));
      element.classList.toggle("bad", isBad);
      more.hidden = !isOpen;
      duration.show(secondsInWords(keyframe.duration));
      pause.show(secondsInWords(keyframe.pause));
    }};
  }
}

export function secondsInWords(seconds: number): string {
  return say("motion.seconds", {value: seconds.toFixed(1)});
}
