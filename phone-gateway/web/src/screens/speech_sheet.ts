/** What the robot says, and the colours of its lights: one sheet, over everything. */
import {cssColor, el, icon} from "../dom";
import {getLanguage, say, sayName} from "../text/texts";
import type {TextKey} from "../text/texts";
import {kCloseIcon} from "./icons";
import {sheet} from "./sheet";

const kMaxBytes = 1000;
const kColors: readonly [TextKey, number][] = [
  ["lights.red", 0xff0000], ["lights.orange", 0xff8000], ["lights.yellow", 0xffd000], ["lights.green", 0x00ff00],
  ["lights.cyan", 0x00ffff], ["lights.blue", 0x0040ff], ["lights.magenta", 0xff00ff], ["lights.white", 0xffffff],
  ["lights.off", 0x000000],
];

export interface SpeechActions {
  say(text: string, language: string): void;
  stop(): void;
  setLights(names: readonly string[], rgb: number): void;
  keep(phrase: string): void;
  forget(phrase: string): void;
  setLanguage(language: string): void;
  setPlaying(isOn: boolean): void;
}

export class SpeechSheet {
  readonly element: HTMLDialogElement;
  private readonly text: HTMLTextAreaElement;
  private readonly fault = el("p", {class: "speech-fault", role: "alert", hidden: true});
  private readonly language: HTMLSelectElement;
  private readonly phrases = el("ul", {class: "phrases", "aria-label": say("speech.phrases")});
  private readonly lights: HTMLElement;
  private readonly which: HTMLSelectElement;
  private lightNames: readonly string[] = [];

  constructor(isPlaying: boolean, private readonly actions: SpeechActions) {
    this.text = el("textarea", {rows: 2, "aria-label": say("speech.text"), placeholder: say("speech.placeholder"),
                                enterkeyhint: "send", oninput: () => this.check()});
    this.text.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" || event.shiftKey) return;
      event.preventDefault();
      this.sayText();
    });
    this.language = el("select", {"aria-label": say("speech.language"),
                                  onchange: () => actions.setLanguage(this.language.value)});
    this.which = el("select", {});
    const playing = el("input", {type: "checkbox", role: "switch", checked: isPlaying,
                                 onchange: () => actions.setPlaying(playing.checked)});
    this.lights = el("section", {class: "lights"},
      el("label", {class: "row"}, el("span", {}, say("lights.which")), this.which),
      el("div", {class: "swatches", role: "group", "aria-label": say("lights.title")},
         ...kColors.map(([key, rgb]) => this.swatch(key, rgb))));
    this.element = sheet("speech-sheet", say("speech.title"), null, this.text, this.fault,
      el("div", {class: "speech-buttons"},
         el("button", {class: "button primary speech-say", onclick: () => this.sayText()}, say("speech.say")),
         el("button", {class: "button speech-stop", onclick: () => actions.stop()}, say("speech.stop")),
         el("button", {class: "button speech-save", onclick: () => this.keepText()}, say("speech.save"))),
      this.phrases,
      el("label", {class: "row"}, el("span", {}, say("speech.language")), this.language),
      el("label", {class: "row"}, el("span", {}, say("speech.here"),
                                     el("small", {class: "quiet"}, say("speech.hereHelp"))), playing),
      el("h3", {}, say("lights.title")), this.lights);
  }

  open(): void {
    this.element.showModal();
  }

  /** @param tags  BCP 47. @param chosen  one of them; else it is the page's, or English. */
  setLanguages(tags: readonly string[], chosen: string): void {
    const names = new Intl.DisplayNames([getLanguage()], {type: "language"});
    const selected = [chosen, getLanguage(), "en"].find((tag) => tags.includes(tag));
    const options = tags.map((tag) => ({tag, name: names.of(tag) ?? tag}))
        .sort((a, b) => a.name.localeCompare(b.name));
    this.language.replaceChildren(...options.map(({tag, name}) =>
        el("option", {value: tag, selected: tag === selected, lang: tag}, name)));
  }

  setLights(names: readonly string[]): void {
    this.lightNames = names;
    this.lights.hidden = names.length === 0;
    this.which.replaceChildren(el("option", {value: ""}, say("lights.all")),
                               ...names.map((name) => el("option", {value: name}, sayName("light", name))));
  }

  setPhrases(phrases: readonly string[]): void {
    this.phrases.replaceChildren(...phrases.map((phrase) => el("li", {class: "phrase"},
      el("button", {class: "chip", onclick: () => this.actions.say(phrase, this.language.value)}, phrase),
      el("button", {class: "phrase-forget", "aria-label": say("speech.forget", {phrase}),
                    onclick: () => this.actions.forget(phrase)}, icon(kCloseIcon)))));
  }

  private swatch(key: TextKey, rgb: number): HTMLElement {
    return el("button", {class: "swatch", style: `--swatch: ${cssColor(rgb)}`, "aria-label": say(key), title: say(key),
                         onclick: () => this.actions.setLights(this.chosenLights(), rgb)});
  }

  private chosenLights(): readonly string[] {
    return this.which.value ? [this.which.value] : this.lightNames;
  }

  /** @return the text, or null if there is none that can be said. */
  private check(): string | null {
    const text = this.text.value.trim();
    const bytes = new TextEncoder().encode(text).length;
    this.fault.hidden = bytes <= kMaxBytes;
    this.fault.textContent = this.fault.hidden ? "" : say("speech.tooLong", {bytes});
    return text && bytes <= kMaxBytes ? text : null;
  }

  private sayText(): void {
    const text = this.check();
    if (text) this.actions.say(text, this.language.value);
  }

  private keepText(): void {
    const text = this.check();
    if (text) this.actions.keep(text);
  }
}
