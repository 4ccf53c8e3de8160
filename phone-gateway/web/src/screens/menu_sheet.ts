/** Settings and help: one sheet, over everything. */
import {TiltSensor} from "../controls/tilt_sensor";
import {el, icon} from "../dom";
import {getLanguage, kLanguageNames, kLanguages, say} from "../text/texts";
import type {Language, TextKey} from "../text/texts";

const kHelp: readonly TextKey[] = ["menu.helpWalk", "menu.helpView", "menu.helpImage",
                                   "menu.helpGround", "menu.helpKeys", "menu.helpPad"];

export interface MenuActions {
  /** @return whether tilting is on now. */
  setTilt(isOn: boolean): Promise<boolean>;
  setSwapped(isSwapped: boolean): void;
  setLanguage(language: Language): void;
  changeRobot(): void;
  leave(): void;
}

export class MenuSheet {
  readonly element: HTMLDialogElement;
  private readonly condition = el("ul", {class: "help-list condition"});
  private readonly change = el("button", {class: "button wide change-robot", hidden: true,
                                          onclick: () => this.changeRobot()}, say("lobby.open"));

  constructor(isSwapped: boolean, private readonly actions: MenuActions) {
    const language = el("select", {onchange: () => actions.setLanguage(language.value as Language)},
      ...kLanguages.map((tag) => el("option", {value: tag, selected: tag === getLanguage()},
                                    kLanguageNames[tag])));
    this.element = el("dialog", {class: "menu", "aria-label": say("menu.title")},
      el("header", {}, el("h2", {}, say("menu.title")),
         el("button", {class: "round", "aria-label": say("menu.close"),
                       onclick: () => this.element.close()}, icon("M6 6l12 12M18 6L6 18"))),
      this.tiltSwitch(),
      switchRow(say("menu.swap"), "", isSwapped, false, (input) => actions.setSwapped(input.checked)),
      el("label", {class: "row"}, el("span", {}, say("menu.language")), language),
      el("h3", {}, say("body.title")), this.condition,
      el("h3", {}, say("menu.help")),
      el("ul", {class: "help-list"}, ...kHelp.map((key) => el("li", {}, say(key)))),
      el("div", {class: "menu-buttons"}, this.change,
         el("button", {class: "button wide", onclick: () => this.leave()}, say("drive.leave"))));
    // A tap beside the sheet closes it, as people expect.
    this.element.addEventListener("click", (event) => {
      if (event.target === this.element) this.element.close();
    });
  }

  /** @param condition  Of the robot's body, one sentence each.
   * @param hasSeveralRobots  There are others to choose. */
  open(condition: readonly string[], hasSeveralRobots: boolean): void {
    this.change.hidden = !hasSeveralRobots;
    this.condition.replaceChildren(...condition.map((line) => el("li", {}, line)));
    this.element.showModal();
  }

  private changeRobot(): void {
    this.element.close();
    this.actions.changeRobot();
  }

  private leave(): void {
    this.element.close();
    this.actions.leave();
  }

  private tiltSwitch(): HTMLElement {
    const isAvailable = TiltSensor.isAvailable();
    const row = switchRow(say("menu.tilt"), say(isAvailable ? "menu.tiltHelp" : "menu.tiltMissing"), false,
                          !isAvailable, (input) => {
      const wasAsked = input.checked;
      void this.actions.setTilt(wasAsked).then((isOn) => {
        input.checked = isOn;
        row.querySelector("small")!.textContent = say(wasAsked && !isOn ? "menu.tiltRefused" : "menu.tiltHelp");
      });
    });
    return row;
  }
}

function switchRow(label: string, help: string, isOn: boolean, isDisabled: boolean,
                   changed: (input: HTMLInputElement) => void): HTMLElement {
  const input = el("input", {type: "checkbox", role: "switch", checked: isOn, disabled: isDisabled,
                             onchange: () => changed(input)});
  return el("label", {class: "row"},
            el("span", {}, label, help ? el("small", {class: "quiet"}, help) : null), input);
}
