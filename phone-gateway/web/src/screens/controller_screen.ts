/** The remote control: status above, the robot in the middle, joysticks below. */
import type {Commander} from "../commander";
import {ChoiceStrip} from "../controls/choice_strip";
import {Joystick} from "../controls/joystick";
import type {ImageView} from "../controls/image_view";
import {onPress, onPressDown} from "../controls/press";
import {driveFromSticks} from "../controls/stick";
import type {TiltSensor} from "../controls/tilt_sensor";
import {driveFromTilt} from "../controls/tilt";
import type {Tilt} from "../controls/tilt";
import type {WalkSender} from "../controls/walk_sender";
import {el, icon} from "../dom";
import {Mode} from "../protocol/generated/remote_pb";
import type {Control, State} from "../protocol/generated/remote_pb";
import * as useCases from "../protocol/use_cases";
import {scoreboard} from "../match/scoreboard";
import type {PlayStrip} from "../play/play_strip";
import {isByItself, playInWords} from "../play/play_words";
import type {FreeArea} from "../robot/stage";
import {isStale} from "../store";
import type {AppState, Store} from "../store";
import {activityInWords, kModeNames, modeInWords} from "../text/activity";
import {batteryInWords, warningsInWords} from "../text/body";
import {say, sayName} from "../text/texts";
import {kStopIcon} from "./icons";
import type {JointsPanel} from "./joints_panel";
import {shirt} from "./robot_tag";
import {kSpeechIcon} from "./speech_sheet";

const kLockIcon = "M7 11V8a5 5 0 0 1 10 0v3M5 11h14v9H5zM12 14.5v2";
const kUnlockIcon = "M7 11V8a5 5 0 0 1 9.6-2M5 11h14v9H5zM12 14.5v2";
const kMenuIcon = "M4 7h16M4 12h16M4 17h16";
/** Above this the age of the state is shown, ms. Chosen: twice what a person perceives as a delay. */
const kShownAgeMs = 300;
const kNoStick = {right: 0, up: 0};

export interface ControllerActions {
  openMenu(): void;
  openSpeech(): void;
  /** Shows the robots to choose from. */
  changeRobot(): void;
  setJointsMode(isOn: boolean): void;
  stop(): void;
  /** Explains the link sign. */
  explainLink(): void;
}

export class ControllerScreen {
  readonly element: HTMLElement;
  private readonly walkStick: Joystick;
  private readonly turnStick: Joystick;
  private readonly postures: ChoiceStrip;
  private readonly actions: ChoiceStrip;
  private readonly mode = el("strong", {class: "mode"});
  private readonly activity = el("span", {class: "activity"});
  private readonly progress = el("progress", {max: 1, hidden: true, "aria-label": say("drive.progress")});
  private readonly body = el("div", {class: "body", hidden: true});
  private readonly battery = el("span", {class: "battery"});
  private readonly warning = el("span", {class: "body-warning", role: "status"});
  private readonly driver = el("span", {class: "driver-name"});
  private readonly driverButton: HTMLButtonElement;
  private readonly lock: HTMLButtonElement;
  private readonly link: HTMLButtonElement;
  private readonly linkText = el("span");
  private readonly robot: HTMLButtonElement;
  private readonly bottom: HTMLElement;
  private readonly status: HTMLElement;
  private tiltNeutral: Tilt | null = null;

  constructor(private readonly store: Store, private readonly commander: Commander,
              private readonly walk: WalkSender, private readonly image: ImageView,
              private readonly joints: JointsPanel, private readonly tilt: TiltSensor,
              walkHere: HTMLElement, play: PlayStrip, map: HTMLElement,
              private readonly act: ControllerActions) {
    this.walkStick = new Joystick(say("drive.walk"), "walk", false, () => this.sticksChanged());
    this.turnStick = new Joystick(say("drive.turn"), "turn", true, () => this.sticksChanged());
    this.tilt.onChange = () => this.sticksChanged();
    this.tilt.onTurn = () => this.walkStick.release();
    this.postures = new ChoiceStrip(say("drive.postures"), (name) =>
        void commander.command(useCases.goToPosture(name)));
    this.actions = new ChoiceStrip(say("drive.actions"), (name) =>
        void commander.command(useCases.doAction(name)));
    this.driverButton = el("button", {class: "button small driver-button"});
    onPress(this.driverButton, () => this.changeDriver());
    this.lock = el("button", {class: "round lock"});
    onPress(this.lock, () => this.toggleMode());
    const stop = el("button", {class: "stop"}, icon(kStopIcon), el("span", {}, say("drive.stop")));
    onPressDown(stop, () => act.stop());
    this.link = el("button", {class: "link", onclick: () => act.explainLink()},
                   el("span", {class: "bars", "aria-hidden": "true"}, el("i"), el("i"), el("i")),
                   this.linkText);
    this.robot = el("button", {class: "robot-tag", hidden: true, onclick: () => act.changeRobot()});
    this.status = el("div", {class: "status"}, scoreboard(store),
      el("div", {class: "status-line", role: "status"}, this.mode, this.activity),
      this.progress, this.body,
      el("div", {class: "driver"}, this.robot, this.driver, this.driverButton), map);
    this.body.append(this.battery, this.warning);
    this.bottom = el("footer", {class: "bottom"},
      el("div", {class: "strips"}, play.element, this.postures.element, this.actions.element),
      this.walkStick.element,
      stop,
      this.turnStick.element, joints.element);
    this.element = el("section", {class: "screen controller-screen"},
      walkHere,
      el("header", {class: "top"}, image.element, this.status,
         el("div", {class: "corner"}, this.lock,
            el("button", {class: "round speech-button", "aria-label": say("speech.open"),
                          onclick: () => act.openSpeech()}, icon(kSpeechIcon)),
            el("button", {class: "round menu-button", "aria-label": say("drive.menu"), onclick: () => act.openMenu()},
               icon(kMenuIcon)),
            this.link)),
      this.bottom);
    this.watch();
  }

  /** Releases all controls. */
  release(): void {
    this.walkStick.release();
    this.turnStick.release();
    this.joints.release();
  }

  /** True: walk on the right, turn on the left. */
  setSwapped(isSwapped: boolean): void {
    this.element.classList.toggle("swapped", isSwapped);
  }

  setTilt(isOn: boolean): void {
    this.walkStick.relabel(say(isOn ? "drive.holdTilt" : "drive.walk"));
    this.walkStick.element.classList.toggle("tilting", isOn);
  }

  /** Calls `changed` with the part that no control covers, now and whenever it is another. */
  observeFreeArea(changed: (area: FreeArea) => void): void {
    const measure = (): void => {
      const box = this.element.getBoundingClientRect();
      if (box.width === 0) return;
      const image = this.image.element.getBoundingClientRect();
      const bottom = this.bottom.getBoundingClientRect();
      const isBeside = box.width > box.height;
      changed({
        left: isBeside && this.image.isLarge ? image.right : 0,
        right: box.width,
        // A large image in portrait pushes the words below it.
        top: isBeside ? 4 : this.image.isLarge ? this.status.getBoundingClientRect().bottom : image.bottom,
        bottom: isBeside ? this.centreTop() : bottom.top,
      });
    };
    const observer = new ResizeObserver(measure);
    for (const part of [this.element, this.bottom, this.image.element, this.status]) observer.observe(part);
    this.store.watch((state) => state.isJointsMode, measure);
  }

  /** Upper edge of the elements between the joysticks in landscape, px. */
  private centreTop(): number {
    const middle = this.store.get().isJointsMode ? this.joints.teachBar.buttons : this.postures.element;
    return middle.getBoundingClientRect().top;
  }

  private watch(): void {
    const {store} = this;
    store.watch((state) => state.robot, (robot) => {
      this.postures.setChoices((robot?.postures ?? []).map(
          (name) => ({name, label: sayName("posture", name)})));
    });
    store.watch((state) => state.robot, () => this.showActions());
    store.watch((state) => state.savedMotions, () => this.showActions());
    store.watch((state) => state.state, (state) => this.showState(state));
    store.watch((state) => state.playState, () => this.showState(store.get().state));
    store.watch((state) => state.control, (control) => this.showDriver(control));
    store.watch((state) => state.robots, () => this.showRobot());
    store.watch((state) => state.robot, () => this.showRobot());
    store.watch((state) => state.latencyMs, () => this.showLink());
    // While nothing new comes: each tenth of a second.
    store.watch((state) => state.phase !== "connected" || state.stateAgeMs > kShownAgeMs ? `${state.phase} ${state.stateAgeMs}` : "",
                () => {
                  this.showState(store.get().state);
                  this.showLink();
                });
    store.watch((state) => state.isJointsMode, (isOn) => this.showMode(isOn));
  }

  /** The robot's own actions, and the motions that people have saved. */
  private showActions(): void {
    const {robot, savedMotions} = this.store.get();
    const own = (robot?.actions ?? []).filter((name) => !robot?.savedMotions.includes(name));
    this.actions.setChoices([...own, ...savedMotions].map((name) => ({name, label: sayName("action", name)})));
  }

  private sticksChanged(): void {
    const {walkStick, turnStick} = this;
    const walkValue = this.tilt.tilt ? null : walkStick.value;
    const isHeld = walkValue !== null || turnStick.value !== null;
    this.walk.set("sticks", isHeld ? driveFromSticks(walkValue ?? kNoStick,
                                                     turnStick.value ?? kNoStick) : null);
    this.tiltChanged();
  }

  /** Tilt drives only while the pad is touched: a phone that falls or is handed on must not drive. */
  private tiltChanged(): void {
    const {tilt} = this.tilt;
    if (!tilt || this.walkStick.value === null) {
      this.tiltNeutral = null;
      this.walk.set("tilt", null);
      return;
    }
    this.tiltNeutral ??= tilt;
    this.walk.set("tilt", driveFromTilt(tilt, this.tiltNeutral));
  }

  private toggleMode(): void {
    this.act.setJointsMode(!this.store.get().isJointsMode);
  }

  private showMode(isJointsMode: boolean): void {
    this.element.dataset["mode"] = isJointsMode ? "joints" : "drive";
    this.lock.replaceChildren(icon(isJointsMode ? kUnlockIcon : kLockIcon));
    this.lock.setAttribute("aria-label", say(isJointsMode ? "drive.lock" : "drive.unlock"));
    this.lock.setAttribute("aria-pressed", String(isJointsMode));
  }

  private changeDriver(): void {
    const isMine = this.store.get().control?.isMine ?? false;
    void (isMine ? this.commander.releaseControl() : this.commander.takeControl());
  }

  private showState(state: State | null): void {
    const {playState, phase, problem, stateAgeMs} = this.store.get();
    const isOld = isStale(this.store.get()) && state?.mode !== Mode.NO_ROBOT;
    setText(this.mode, phase !== "connected" && state && problem ? say(`problem.${problem}`) :
            isOld && state ? say("mode.stale", {seconds: (stateAgeMs / 1000).toFixed(1)}) :
            state ? modeInWords(state.mode, isByItself(playState)) : say("mode.waiting"));
    setText(this.activity, isOld ? "" : playInWords(playState) || activityInWords(state?.activity));
    const progress = state?.activity ? state.progress : -1;
    this.progress.hidden = !(progress >= 0);
    if (progress >= 0) this.progress.value = progress;
    this.postures.mark(state?.posture ?? "");
    this.body.hidden = !state?.body;
    setText(this.battery, batteryInWords(state?.body));
    setText(this.warning, warningsInWords(state?.body, this.store.get().robot).join(" "));
    const mode = state ? kModeNames[state.mode] ?? "" : "";
    if (this.status.dataset["mode"] !== mode) this.status.dataset["mode"] = mode;
  }

  private showDriver(control: Control | null): void {
    const who = !control || control.driverId === 0 ? "free" : control.isMine ? "mine" : "other";
    this.element.dataset["control"] = who;
    setText(this.driver, who === "mine" ? say("control.mine") :
            who === "other" ? say("control.other", {name: control!.driverName}) :
            say(control?.isMuted ? "control.muted" : "control.free"));
    this.driverButton.hidden = who === "free" || (control?.isMuted ?? false);
    setText(this.driverButton, say(who === "mine" ? "control.release" : "control.ask"));
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

  private showLink(): void {
    const state = this.store.get();
    this.link.hidden = state.latencyMs < 0;
    setText(this.linkText, state.phase === "connected" ? `${Math.round(linkDelay(state))} ms` : "–");
    this.link.dataset["quality"] = linkQuality(state);
    this.link.setAttribute("aria-label", linkInWords(state));
  }
}

/** What the link sign shows, ms: the round trip, and while nothing new comes the age of what is shown. */
export function linkDelay({latencyMs, stateAgeMs}: Readonly<AppState>): number {
  return stateAgeMs > kShownAgeMs ? Math.max(latencyMs, stateAgeMs) : latencyMs;
}

/** Good: the delay is not noticeable; fair: noticeable; poor: drive slowly. */
export function linkQuality(state: Readonly<AppState>): "good" | "fair" | "poor" {
  if (isStale(state)) return "poor";
  const worst = Math.max(linkDelay(state), state.imageAgeMs / 2);
  return worst < 60 ? "good" : worst < 200 ? "fair" : "poor";
}

export function linkInWords(state: Readonly<AppState>): string {
  return say("drive.link", {latency: Math.round(linkDelay(state)), image: Math.round(Math.max(0, state.imageAgeMs))});
}

/** Leaves the page alone where nothing changes: states come 30 times a second. */
function setText(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}
