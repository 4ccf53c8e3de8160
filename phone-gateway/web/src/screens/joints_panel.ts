/** Joints mode's controls: which joint, how far it is, a pad for yaw and pitch, a slider for roll; whether its limb
 * is limp; and the bar for teaching. */
import {ChoiceStrip} from "../controls/choice_strip";
import {JointDriver} from "../controls/joint_driver";
import {Joystick} from "../controls/joystick";
import {button} from "../controls/press";
import {cssColor, el, setText} from "../dom";
import type {Joint, JointGroup, State} from "../protocol/generated/remote_pb";
import {jointOfAxis, kAxes, kAxisColors} from "../robot/joint_axes";
import type {Axis} from "../robot/joint_axes";
import {jointPosition} from "../store";
import type {Store} from "../store";
import type {Teach} from "../teach/teach";
import {say, sayName} from "../text/texts";
import {kLimitPattern, vibrate} from "../vibrate";

/** This near to a limit a joint is at its end, rad. */
const kAtLimit = 0.012;

export class JointsPanel {
  readonly element: HTMLElement;
  private readonly stick = new Joystick(say("joints.move"), "joint", false, () => this.driver.setStick(this.stick.value),
                                        ["W", "A", "S", "D"]);
  private readonly strip = new ChoiceStrip(say("joints.groups"), "groups", (selectedGroup) => this.store.set({selectedGroup}));
  private readonly name = el("strong", {class: "joint-name"});
  private readonly angles = el("dl", {class: "angles"});
  private readonly roll = el("input", {type: "range", step: "any", "aria-label": say("joints.roll")});
  private readonly rollRow = paint("roll", el("label", {class: "roll"},
                                              el("span", {class: "joystick-label"}, say("joints.roll")), this.roll));
  private readonly both = button({class: "button small", "aria-pressed": "false"}, () => this.toggleBoth(), say("joints.both"));
  private readonly relax: HTMLButtonElement;
  /** Roll that was sent last while the slider is held, rad; NaN while it is free. */
  private heldRoll = NaN;
  private limitNow = "";
  /** What is shown of each axis of the group; `isOpening`: it opens and closes, as a hand does. */
  private rows: readonly {axis: Axis; joint: Joint; isOpening: boolean; row: HTMLElement; value: HTMLElement}[] = [];
  private groups: readonly JointGroup[] = [];

  /** @param reset  takes the robot back to its ready posture. */
  constructor(private readonly store: Store, private readonly driver: JointDriver, teach: Teach, reset: () => void) {
    this.relax = button({class: "button small relax", title: say("teach.relaxHelp")},
                        () => driver.group && void teach.relax(driver.group.name), say("teach.relax"));
    const ready = button({class: "button small"}, reset, say("joints.reset"));
    this.roll.addEventListener("pointerdown", () => this.heldRoll = this.roll.valueAsNumber);
    this.roll.addEventListener("input", () => this.rollChanged());
    for (const type of ["pointerup", "pointercancel", "change", "blur"]) {
      this.roll.addEventListener(type, () => this.heldRoll = NaN);
    }
    this.element = el("div", {class: "joints-panel"},
      teach.bar.element, this.strip.element,
      el("div", {class: "joint-card"}, this.name, this.angles, this.rollRow,
         el("div", {class: "joint-buttons"}, this.both, ready, this.relax)),
      this.stick.element);
    store.watch((state) => state.robot, (robot) => this.setGroups(robot?.jointGroups ?? []));
    store.watch((state) => state.selectedGroup, (name) => this.select(name));
    store.watch((state) => state.state, (state) => this.showState(state));
    store.watch((state) => state.relaxedGroups, () => this.showRelaxed());
  }

  release(): void {
    this.stick.release();
    this.heldRoll = NaN;
  }

  private setGroups(groups: readonly JointGroup[]): void {
    this.groups = groups;
    this.strip.setChoices(groups.map(({name}) => ({name, label: sayName("group", name)})));
    this.select(this.store.get().selectedGroup);
  }

  private select(name: string): void {
    const group = this.groups.find((one) => one.name === name) ?? null;
    this.release();
    this.driver.group = group;
    this.strip.mark(name);
    this.name.textContent = group ? sayName("group", name) : say("joints.choose");
    this.element.dataset["group"] = name;
    this.limitNow = "";
    this.rows = kAxes.flatMap((axis) => {
      const joint = this.joint(group, axis);
      if (!group || !joint) return [];
      const isOpening = group.isOpening && axis === "pitch";
      const value = el("dd");
      const row = el("div", {class: `axis axis-${axis}`}, el("dt", {}, say(isOpening ? "joints.opening" : `joints.${axis}`)), value);
      return {axis, joint, isOpening, value, row: paint(axis, row)};
    });
    this.angles.replaceChildren(...this.rows.map(({row}) => row));
    const limits = this.joint(group, "roll");
    this.rollRow.hidden = !limits;
    if (limits) {
      this.roll.min = String(limits.lower);
      this.roll.max = String(limits.upper);
    }
    this.stick.element.classList.toggle("idle", !group || (!group.yawJoint && !group.pitchJoint));
    this.showRelaxed();
    this.showState(this.store.get().state);
  }

  private showRelaxed(): void {
    const name = this.driver.group?.name ?? "";
    this.relax.disabled = name === "";
    this.relax.setAttribute("aria-pressed", String(this.store.get().relaxedGroups.includes(name)));
  }

  private showState(state: State | null): void {
    if (!state || !this.store.get().isJointsMode) return;
    let limit = "";
    for (const {axis, joint, isOpening, row, value} of this.rows) {
      const angle = jointPosition(this.joints, state, joint.name);
      const isAtLimit = angle < joint.lower + kAtLimit || angle > joint.upper - kAtLimit;
      row.classList.toggle("at-limit", isAtLimit);
      setText(value, angleText(isOpening, angle) + (isAtLimit ? ` · ${say("joints.limit")}` : ""));
      if (isAtLimit) limit += axis;
      if (axis === "roll" && Number.isNaN(this.heldRoll)) this.roll.value = String(angle);
    }
    if (limit && limit !== this.limitNow) vibrate(kLimitPattern);
    this.limitNow = limit;
  }

  private rollChanged(): void {
    const joint = this.joint(this.driver.group, "roll");
    const state = this.store.get().state;
    if (!joint || !state) return;
    const from = Number.isNaN(this.heldRoll) ? jointPosition(this.joints, state, joint.name) : this.heldRoll;
    const wanted = this.roll.valueAsNumber;
    this.driver.turn("roll", wanted - from);
    this.heldRoll = wanted;
  }

  private toggleBoth(): void {
    this.driver.isMirrored = !this.driver.isMirrored;
    this.both.setAttribute("aria-pressed", String(this.driver.isMirrored));
  }

  private get joints(): readonly Joint[] {
    return this.store.get().robot?.joints ?? [];
  }

  private joint(group: JointGroup | null, axis: Axis): Joint | undefined {
    const name = group ? jointOfAxis(group, axis) : "";
    return this.joints.find((joint) => joint.name === name);
  }
}

/** Gives an element the colour of its axis' arc. */
function paint(axis: Axis, element: HTMLElement): HTMLElement {
  element.style.setProperty("--axis", cssColor(kAxisColors[axis]));
  return element;
}

/** Degrees, as people know them; openings in percent. */
function angleText(isOpen: boolean, angle: number): string {
  return isOpen ? `${Math.round(angle * 100)} %` : `${Math.round(angle * 180 / Math.PI)}°`;
}
