/** Joints mode's bar for teaching: adds poses, plays them, opens the sheet of motions, and shows why a
 * motion is not safe. */
import {button, iconButton} from "../controls/press";
import {el, icon} from "../dom";
import {CommandKind} from "../protocol/generated/remote_pb";
import type {State} from "../protocol/generated/remote_pb";
import type {MotionFault, Store} from "../store";
import {keyframeAt} from "../teach/motion_draft";
import {kTemporaryName} from "../teach/motion_name";
import type {Teach} from "../teach/teach";
import {say} from "../text/texts";
import {kAddIcon, kListIcon, kPlayIcon, kSaveIcon} from "./icons";
import {Note} from "./note";

export class TeachBar {
  readonly element: HTMLElement;
  private readonly fault = new Note();
  private readonly dots = el("ol", {class: "pose-dots", tabindex: 0, "aria-label": say("teach.poses")});
  private readonly status = el("p", {class: "unseen", role: "status"});
  private readonly playText = el("span", {}, say("teach.play"));
  private readonly play = iconButton("button small teach-play", kPlayIcon, this.playText, () => this.teach.play());
  private readonly open = button({class: "button small teach-open"}, () => this.teach.sheet.open());
  private current = -1;

  constructor(private readonly store: Store, private readonly teach: Teach) {
    this.element = el("section", {class: "teach-bar", "aria-label": say("teach.bar")}, this.fault.element, this.status, this.dots,
      el("div", {class: "teach-buttons"},
         iconButton("button small teach-add", kAddIcon, say("teach.add"), () => teach.addPose()), this.play, this.open));
    store.watch((state) => state.draft.keyframes.length, (number) => this.showNumber(number));
    store.watch((state) => state.isCheckingMotion, (isChecking) => this.showChecking(isChecking));
    store.watch((state) => state.motionFault, (fault) => this.showFault(fault));
    store.watch((state) => state.state, (state) => this.showProgress(state));
  }

  private showNumber(number: number): void {
    // Seen by the dots; said to those who do not see them.
    if (number > this.dots.childElementCount) this.status.textContent = say("teach.added", {number});
    this.dots.replaceChildren(...Array.from({length: number}, (_, i) => el("li", {}, String(i + 1))));
    this.dots.hidden = number === 0;
    this.dots.scrollLeft = this.dots.scrollWidth;
    this.current = -1;
    this.play.hidden = number === 0;
    this.open.replaceChildren(icon(number > 0 ? kSaveIcon : kListIcon),
                              el("span", {}, say(number > 0 ? "teach.save" : "teach.motions")));
  }

  private showChecking(isChecking: boolean): void {
    this.playText.textContent = say(isChecking ? "teach.checking" : "teach.play");
    this.play.setAttribute("aria-busy", String(isChecking));
    this.play.disabled = isChecking;
  }

  private showFault(fault: MotionFault | null): void {
    // One of a file is shown in the sheet, where the file was chosen.
    const shown = fault?.isUpload ? null : fault;
    for (const [i, dot] of [...this.dots.children].entries()) dot.classList.toggle("bad", i === shown?.keyframe);
    this.fault.hide();
    if (shown) this.fault.tellFault(shown, () => this.teach.repair());
  }

  /** Marks the pose that the robot goes to while the draft is played. */
  private showProgress(state: State | null): void {
    const activity = state?.activity;
    const isPlaying = activity?.kind === CommandKind.ACTION && activity.name === kTemporaryName;
    const current = isPlaying ? keyframeAt(this.store.get().draft, state!.progress) : -1;
    if (current === this.current) return;
    this.dots.children[this.current]?.classList.remove("current");
    this.dots.children[current]?.classList.add("current");
    this.current = current;
  }
}
