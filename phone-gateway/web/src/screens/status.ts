/** What lies on the views: what the robot does, and who drives it. */
import type {Commander} from "../commander";
import {button} from "../controls/press";
import {el, setHidden, setText} from "../dom";
import {scoreboard} from "../match/scoreboard";
import {isByItself, playInWords} from "../play/play_words";
import {Mode} from "../protocol/generated/remote_pb";
import type {Control} from "../protocol/generated/remote_pb";
import {nameOf} from "../protocol/names";
import {isStale} from "../store";
import type {AppState, Store} from "../store";
import {activityInWords, modeInWords} from "../text/activity";
import {batteryInWords, warningsInWords} from "../text/body";
import {say} from "../text/texts";
import {ageWhileSilent} from "./link_sign";
import {shirt} from "./robot_tag";

export class Status {
  readonly element: HTMLElement;
  private readonly mode = el("strong", {class: "mode"});
  private readonly activity = el("span", {class: "activity"});
  private readonly progress = el("progress", {max: 1, hidden: true, "aria-label": say("drive.progress")});
  private readonly body = el("div", {class: "body", hidden: true});
  private readonly battery = el("span", {class: "battery"});
  private readonly warning = el("span", {class: "body-warning", role: "status"});
  private readonly driver = el("span", {class: "driver-name"});
  private readonly ask = button({class: "button small driver-button"}, () => this.changeDriver());
  private readonly robot: HTMLButtonElement;

  /** @param changeRobot  shows the robots to choose from. */
  constructor(private readonly store: Store, private readonly commander: Commander, changeRobot: () => void) {
    this.robot = el("button", {class: "robot-tag", hidden: true, onclick: changeRobot});
    this.body.append(this.battery, this.warning);
    this.element = el("div", {class: "status"},
      el("div", {class: "status-line", role: "status"}, this.mode, this.activity), this.progress, this.body,
      el("div", {class: "driver"}, this.robot, this.driver, this.ask), scoreboard(store));
    const watch = (parts: (keyof AppState)[], show: () => void) => parts.forEach((part) => store.watch((state) => state[part], show));
    watch(["state", "playState", "phase"], () => this.showState());
    store.watch(ageWhileSilent, () => this.showState());
    watch(["control", "phase"], () => this.showDriver());
    watch(["robots", "robot"], () => this.showRobot());
  }

  private showState(): void {
    const {state, playState, stateAgeMs, robot} = this.store.get();
    const isOld = isStale(this.store.get()) && state?.mode !== Mode.NO_ROBOT;
    setText(this.mode, !state ? say("mode.waiting") : isOld ? say("mode.stale", {seconds: (stateAgeMs / 1000).toFixed(1)}) :
            modeInWords(state.mode, isByItself(playState)));
    setText(this.activity, isOld ? "" : playInWords(playState) || activityInWords(state?.activity));
    const progress = state?.activity ? state.progress : -1;
    setHidden(this.progress, !(progress >= 0));
    if (progress >= 0) this.progress.value = progress;
    setHidden(this.body, !state?.body);
    setText(this.battery, batteryInWords(state?.body));
    setText(this.warning, warningsInWords(state?.body, robot).join(" "));
    const mode = state ? nameOf(Mode, state.mode, "no-robot") : "";
    if (this.element.dataset["mode"] !== mode) this.element.dataset["mode"] = mode;
  }

  private showDriver(): void {
    const {control, phase} = this.store.get();
    const who = driverOf(control);
    this.element.dataset["control"] = who;
    const driver = who === "mine" ? say("control.mine") : who === "other" ? say("control.other", {name: control!.driverName}) :
        say(control?.isMuted ? "control.muted" : "control.free");
    const isNext = this.isNext;
    const next = !control?.nextId ? "" : isNext ? say("control.youNext") : say("control.next", {name: control.nextName});
    setText(this.driver, next ? say("lobby.list", {first: driver, second: next}) : driver);
    // Without a link no gateway receives it. While another client waits there is nothing to ask for, and its request has its own button.
    this.ask.hidden = phase !== "connected" || who === "free" || (control?.isMuted ?? false) || (next !== "" && !isNext);
    setText(this.ask, say(who === "mine" ? "control.release" : isNext ? "control.withdraw" : "control.ask"));
  }

  private get isNext(): boolean {
    const {control, clientId} = this.store.get();
    return control !== null && control.nextId !== 0 && control.nextId === clientId;
  }

  private changeDriver(): void {
    const isMine = this.store.get().control?.isMine ?? false;
    void (isMine || this.isNext ? this.commander.releaseControl() : this.commander.askForControl());
  }

  /** Which of several robots this is. */
  private showRobot(): void {
    const {robots, robot} = this.store.get();
    const shown = robots.find(({name}) => name === robot?.name);
    this.robot.hidden = !shown;
    if (!shown) return;
    this.robot.replaceChildren(shirt(shown), shown.name);
    this.robot.setAttribute("aria-label", `${shown.name}: ${say("lobby.open")}`);
  }
}

function driverOf(control: Control | null): "free" | "mine" | "other" {
  return !control || control.driverId === 0 ? "free" : control.isMine ? "mine" : "other";
}
