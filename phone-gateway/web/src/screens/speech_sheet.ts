/** What the robot says, and the colours of its lights: one sheet, over everything. */
import type {Commander} from "../commander";
import {cssColor, el, icon} from "../dom";
import type {UseCaseValue} from "../protocol/codec";
import {Say_Operation} from "../protocol/generated/remote_pb";
import type {SpeechSettings} from "../speech/speech_settings";
import type {Store} from "../store";
import {getLanguage, say, sayName} from "../text/texts";
import type {TextKey} from "../text/texts";
import {kCloseIcon} from "./icons";
import {switchRow} from "./menu_sheet";
import {sheet} from "./sheet";

const kMaxBytes = 1000;
const kColors: readonly [TextKey, number][] = [
  ["lights.red", 0xff0000], ["lights.orange", 0xff8000], ["lights.yellow", 0xffd000], ["lights.green", 0x00ff00],
  ["lights.cyan", 0x00ffff], ["lights.blue", 0x0040ff], ["lights.magenta", 0xff00ff], ["lights.white", 0xffffff],
  ["lights.off", 0x000000],
];

export class SpeechSheet {
  readonly element: HTMLDialogElement;
  private readonly text: HTMLTextAreaElement;
  private readonly fault = el("p", {class: "speech-fault", role: "alert", hidden: true});
  private readonly language = el("select", {"aria-label": say("speech.language"),
                                            onchange: () => this.keep({language: this.language.value})});
  private readonly phrases = el("ul", {class: "phrases", "aria-label": say("speech.phrases")});
  private readonly lights: HTMLElement;
  private readonly which = el("select");

  /** @param keep  remembers settings. */
  constructor(private readonly store: Store, private readonly commander: Commander,
              private readonly keep: (settings: Partial<SpeechSettings>) => void) {
    this.text = el("textarea", {rows: 2, "aria-label": say("speech.text"), placeholder: say("speech.placeholder"),
                                enterkeyhint: "send", oninput: () => this.check(), onkeydown: (event: KeyboardEvent) => {
      if (event.key !== "Enter" || event.shiftKey) return;
      event.preventDefault();
      this.sayText();
    }});
    this.lights = el("section", {class: "lights"},
      el("label", {class: "row"}, el("span", {}, say("lights.which")), this.which),
      el("div", {class: "swatches", role: "group", "aria-label": say("lights.title")},
         ...kColors.map(([key, rgb]) => this.swatch(key, rgb))));
    this.element = sheet("speech-sheet", say("speech.title"), null, this.text, this.fault,
      el("div", {class: "speech-buttons"},
         el("button", {class: "button primary speech-say", onclick: () => this.sayText()}, say("speech.say")),
         el("button", {class: "button speech-stop", onclick: () => this.command({operation: Say_Operation.STOP})}, say("speech.stop")),
         el("button", {class: "button speech-save", onclick: () => this.keepText()}, say("speech.save"))),
      this.phrases,
      el("label", {class: "row"}, el("span", {}, say("speech.language")), this.language),
      switchRow(say("speech.here"), say("speech.hereHelp"), store.get().speech.isPlaying, false,
                ({checked}) => keep({isPlaying: checked})),
      el("h3", {}, say("lights.title")), this.lights);
    store.watch(({speech}) => speech.phrases, () => this.showPhrases());
    store.watch(({robot}) => robot, (robot) => {
      this.showLanguages(robot?.languages ?? []);
      this.showLights((robot?.lights ?? []).map(({name}) => name));
    });
  }

  /** @param tags  BCP 47. */
  private showLanguages(tags: readonly string[]): void {
    const names = new Intl.DisplayNames([getLanguage()], {type: "language"});
    const selected = [this.store.get().speech.language, getLanguage(), "en"].find((tag) => tags.includes(tag));
    const options = tags.map((tag) => ({tag, name: names.of(tag) ?? tag}))
        .sort((a, b) => a.name.localeCompare(b.name));
    this.language.replaceChildren(...options.map(({tag, name}) =>
        el("option", {value: tag, selected: tag === selected, lang: tag}, name)));
  }

  private showLights(names: readonly string[]): void {
    this.lights.hidden = names.length === 0;
    this.which.replaceChildren(el("option", {value: ""}, say("lights.all")),
                               ...names.map((name) => el("option", {value: name}, sayName("light", name))));
  }

  private get keptPhrases(): readonly string[] {
    return this.store.get().speech.phrases ?? [say("speech.phraseHello"), say("speech.phraseThanks"), say("speech.phrasePass")];
  }

  private showPhrases(): void {
    this.phrases.replaceChildren(...this.keptPhrases.map((phrase) => el("li", {class: "phrase"},
      el("button", {class: "chip", onclick: () => this.sayText(phrase)}, phrase),
      el("button", {class: "phrase-forget", "aria-label": say("speech.forget", {phrase}),
                    onclick: () => this.keep({phrases: this.without(phrase)})}, icon(kCloseIcon)))));
  }

  private without(phrase: string): string[] {
    return this.keptPhrases.filter((other) => other !== phrase);
  }

  private command(value: UseCaseValue<"say">): void {
    void this.commander.command({case: "say", value});
  }

  private swatch(key: TextKey, rgb: number): HTMLElement {
    return el("button", {class: "swatch", style: `--swatch: ${cssColor(rgb)}`, "aria-label": say(key), title: say(key),
                         onclick: () => this.paint(rgb)});
  }

  /** Gives the chosen light a color, or all of them. */
  private paint(rgb: number): void {
    const lightNames = this.which.value ? [this.which.value] : this.store.get().robot?.lights.map(({name}) => name) ?? [];
    void this.commander.command({case: "setLights", value: {lightNames, lightRgb: lightNames.map(() => rgb)}});
  }

  /** @return the text, or null if there is none that can be said. */
  private check(): string | null {
    const text = this.text.value.trim();
    const bytes = new TextEncoder().encode(text).length;
    this.fault.hidden = bytes <= kMaxBytes;
    this.fault.textContent = this.fault.hidden ? "" : say("speech.tooLong", {bytes});
    return text && bytes <= kMaxBytes ? text : null;
  }

  private sayText(text = this.check()): void {
    if (text) this.command({text, language: this.language.value});
  }

  private keepText(): void {
    const text = this.check();
    if (text) this.keep({phrases: [text, ...this.without(text)]});
  }
}
