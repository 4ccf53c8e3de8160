/** The remote control: a view of the robot and its camera's image, what lies on them, and the controls. Where each
 * part is, says the grid of controller.css. */
import type {Commander} from "../commander";
import type {ImageView} from "../controls/image_view";
import {iconButton, onPressDown} from "../controls/press";
import type {TiltSensor} from "../controls/tilt_sensor";
import type {WalkSender} from "../controls/walk_sender";
import {el, icon} from "../dom";
import type {Messages} from "../messages";
import type {PlayStrip} from "../play/play_strip";
import type {RobotDescription} from "../protocol/generated/remote_pb";
import type {Store} from "../store";
import {say} from "../text/texts";
import type {TextKey} from "../text/texts";
import type {Actions} from "./actions";
import {Deck} from "./deck";
import {kDownIcon, kJointsIcon, kMenuIcon, kMoreIcon, kSpeechIcon, kStopIcon, kWalkIcon} from "./icons";
import type {JointsPanel} from "./joints_panel";
import {linkSign} from "./link_sign";
import {Status} from "./status";
import {Sticks} from "./sticks";

export class ControllerScreen {
  readonly element: HTMLElement;
  /** Where the robot is drawn in the midst, when it is the large view. */
  private readonly free = el("div", {class: "free"});
  private readonly hint = el("p", {class: "hint"}, el("span", {class: "by-touch"}, say("hint.walk")),
                             el("span", {class: "by-keys"}, say("hint.keys")));
  private readonly sticks: Sticks;
  private readonly joints: HTMLButtonElement;
  private readonly more = navButton("more-button", "drive.more", kMoreIcon, () => this.setOpen(!this.element.classList.contains("open")));

  /** @param view  the robot in 3D. @param notes  where messages and causes are. */
  constructor(store: Store, commander: Commander, walk: WalkSender, private readonly view: HTMLElement,
              private readonly image: ImageView, private readonly panel: JointsPanel, tilt: TiltSensor, play: PlayStrip,
              map: Element, notes: HTMLElement, messages: Messages, act: Actions) {
    this.sticks = new Sticks(store, walk, tilt);
    // The hint has served.
    this.sticks.onUse = () => {
      if (!store.get().settings.hasWalked) act.keep({hasWalked: true});
    };
    image.onSwap = (isLarge) => this.element.classList.toggle("camera-large", isLarge);
    const stop = el("button", {class: "stop"}, icon(kStopIcon), el("span", {}, say("drive.stop")),
                    el("kbd", {"aria-hidden": "true"}, say("drive.stopKey")));
    onPressDown(stop, () => act.stop());
    this.joints = navButton("joints-button", "drive.joints", kJointsIcon, () => act.setJointsMode(!store.get().isJointsMode));
    this.element = el("section", {class: "screen controller-screen"},
      view, image.element, this.free, el("div", {class: "sheet"}),
      new Status(store, commander, () => act.changeRobot()).element, linkSign(store, messages),
      notes, el("nav", {class: "modes", "aria-label": say("drive.menu")}, this.joints, this.more,
         navButton("speech-button", "drive.speak", kSpeechIcon, () => act.openSpeech()),
         navButton("menu-button", "drive.menu", kMenuIcon, () => act.openMenu())),
      new Deck(store, commander, play, map).element, this.hint,
      this.sticks.walkStick.element, stop, this.sticks.turnStick.element, panel.element);
    this.setOpen(false);
    store.watch((state) => state.isJointsMode, (isOn) => this.showMode(isOn));
    store.watch((state) => state.robot, (robot) => this.element.classList.toggle("walks", canWalk(robot)));
    store.watch((state) => state.settings, ({isSwapped, hasWalked}) => {
      this.element.classList.toggle("swapped", isSwapped);
      this.hint.hidden = hasWalked;
    });
  }

  /** Releases all controls. */
  release(): void {
    this.sticks.release();
    this.panel.release();
  }

  /** Calls `changed` with the part of the 3D view where the robot is to be, px, now and whenever it is another; null: all. */
  observeFreeArea(changed: (area: DOMRect | null) => void): void {
    const measure = (): void => {
      const view = this.view.getBoundingClientRect();
      const free = this.free.getBoundingClientRect();
      if (view.width === 0) return;
      changed(this.image.isLarge ? null : new DOMRect(free.left - view.left, free.top - view.top, free.width, free.height));
    };
    const observer = new ResizeObserver(measure);
    for (const part of [this.view, this.free]) observer.observe(part);
  }

  /** True: all that the robot can do is shown. */
  private setOpen(isOpen: boolean): void {
    this.element.classList.toggle("open", isOpen);
    this.more.setAttribute("aria-expanded", String(isOpen));
    relabel(this.more, isOpen ? "drive.less" : "drive.more", isOpen ? kDownIcon : kMoreIcon);
  }

  private showMode(isJointsMode: boolean): void {
    this.element.dataset["mode"] = isJointsMode ? "joints" : "drive";
    relabel(this.joints, isJointsMode ? "drive.drive" : "drive.joints", isJointsMode ? kWalkIcon : kJointsIcon);
    this.joints.append(el("kbd", {"aria-hidden": "true"}, "L"));
    this.joints.setAttribute("aria-pressed", String(isJointsMode));
  }
}

function canWalk(robot: RobotDescription | null): boolean {
  return robot !== null && (robot.maxVx > 0 || robot.maxVy > 0 || robot.maxWz > 0);
}

function navButton(name: string, key: TextKey, path: string, act: () => void): HTMLButtonElement {
  return iconButton(`nav-button ${name}`, path, say(key), act);
}

function relabel(button: HTMLButtonElement, key: TextKey, path: string): void {
  button.replaceChildren(icon(path), el("span", {}, say(key)));
}
