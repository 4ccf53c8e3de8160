/** Settings and help: one sheet, over everything. */
import {TiltSensor} from "../controls/tilt_sensor";
import {el} from "../dom";
import {getLanguage, kLanguageNames, kLanguages, say} from "../text/texts";
import type {TextKey} from "../text/texts";
import type {Actions} from "./actions";
import {sheet} from "./sheet";

const kHelp: readonly TextKey[] = ["menu.helpWalk", "menu.helpView", "menu.helpImage",
                                   "menu.helpGround", "menu.helpKeys", "menu.helpPad"];

export class MenuSheet {
  readonly element: HTMLDialogElement;
  private readonly condition = el("ul", {class: "help-list condition"});
  private readonly change = el("button", {class: "button wide change-robot", hidden: true,
                                          onclick: this.closeAnd(() => this.act.changeRobot())}, say("lobby.open"));

  constructor(isSwapped: boolean, private readonly act: Actions) {
    // Words are put in place once; another language starts the page again, which connects by itself.
    const language = el("select", {onchange: () => {
      act.keep({language: language.value});
      location.reload();
    }},
      ...kLanguages.map((tag) => el("option", {value: tag, selected: tag === getLanguage()},
                                    kLanguageNames[tag])));
    this.element = sheet("settings", say("menu.title"), null, this.tiltSwitch(),
      switchRow(say("menu.swap"), "", isSwapped, false, (input) => act.keep({isSwapped: input.checked})),
      el("label", {class: "row"}, el("span", {}, say("menu.language")), language),
      el("h3", {}, say("body.title")), this.condition,
      el("h3", {}, say("menu.help")),
      el("ul", {class: "help-list"}, ...kHelp.map((key) => el("li", {}, say(key)))),
      el("div", {class: "menu-buttons"}, this.change,
         el("button", {class: "button wide", onclick: this.closeAnd(() => this.act.leave())}, say("drive.leave"))));
  }

  /** @param condition  Of the robot's body, one sentence each.
   * @param hasSeveralRobots  There are others to choose. */
  open(condition: readonly string[], hasSeveralRobots: boolean): void {
    this.change.hidden = !hasSeveralRobots;
    this.condition.replaceChildren(...condition.map((line) => el("li", {}, line)));
    this.element.showModal();
  }

  private closeAnd(go: () => void): () => void {
    return () => {
      this.element.close();
      go();
    };
  }

  private tiltSwitch(): HTMLElement {
    const isAvailable = TiltSensor.isAvailable();
    const row = switchRow(say("menu.tilt"), say(isAvailable ? "menu.tiltHelp" : "menu.tiltMissing"), false,
                          !isAvailable, (input) => {
      const wasAsked = input.checked;
      void this.act.setTilt(wasAsked).then((isOn) => {
        input.checked = isOn;
        row.querySelector("small")!.textContent = say(wasAsked && !isOn ? "menu.tiltRefused" : "menu.tiltHelp");
      });
    });
    return row;
  }
}

export function switchRow(label: string, help: string, isOn: boolean, isDisabled: boolean,
                          changed: (input: HTMLInputElement) => void): HTMLElement {
  const input = el("input", {type: "checkbox", role: "switch", checked: isOn, disabled: isDisabled,
                             onchange: () => changed(input)});
  return el("label", {class: "row"},
            el("span", {}, label, help ? el("small", {class: "quiet"}, help) : null), input);
}
