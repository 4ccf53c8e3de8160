/** The operator's page of an exhibition, for a tablet in one hand. */
import "../styles/app.css";
import "./operator.css";
import {create} from "@bufbuild/protobuf";
import type {MessageInitShape} from "@bufbuild/protobuf";
import {Connection} from "../connection";
import {cssColor, el, setText} from "../dom";
import {ErrorCode, RunExhibitionSchema} from "../protocol/generated/remote_pb";
import type {Exhibition} from "../protocol/generated/remote_pb";
import {Store} from "../store";
import {reasonInWords} from "../text/texts";
import {GatewayTransport, isInvitation} from "../relay/gateway_transport";
import {tell} from "./exhibition_texts";
import type {ExhibitionKey} from "./exhibition_texts";
import {fromAddress, pairingToken, takeLanguage} from "./page";
import {driverInWords} from "./words";
import {clockInWords} from "../text/clock";

type Change = MessageInitShape<typeof RunExhibitionSchema>;

const kMoreTime = 30;
const kSpeeds = [0.25, 0.5, 0.75, 1];
const kVolumes = [0, 0.3, 0.6, 1];
/** White, red, yellow, green, blue, off: 0xRRGGBB. */
const kColors = [0xffffff, 0xff2020, 0xffc000, 0x20d060, 0x2060ff, 0x000000];

class OperatorPage {
  private readonly driver = el("h1");
  private readonly time = el("strong", {class: "operator-time"});
  private readonly queue = el("p", {class: "quiet"});
  private readonly fault = el("p", {class: "operator-fault", role: "alert"});
  private readonly body = el("div", {class: "operator-body"});
  private readonly token = pairingToken();
  /** An invitation for operating needs none. */
  private readonly secret = isInvitation(this.token) ? "" : fromAddress("secret");
  private readonly connection: Connection;
  /** Mark what is set, for what the gateway tells. */
  private marks: ((exhibition: Exhibition) => void)[] = [];

  constructor(root: HTMLElement, store: Store) {
    this.connection = new Connection(new GatewayTransport(new URL(location.href)), store, {
      connected: () => void this.run({}), state: () => {}, image: () => {}, notice: () => {},
    });
    root.append(el("section", {class: "operator"},
      el("header", {}, el("div", {}, this.driver, this.queue), this.time), this.fault, this.body));
    this.fill();
    store.watch((state) => state.exhibition, (exhibition) => this.show(exhibition));
    store.watch((state) => state.phase, (phase) => setText(this.fault, phase === "connected" ? "" : tell("noLink")));
    this.connection.connect({token: this.token, clientName: "operator", clientSoftware: "nao-phone-app operator"});
  }

  private async run(change: Change): Promise<void> {
    if (!this.secret && !isInvitation(this.token)) return setText(this.fault, tell("secret"));
    const value = create(RunExhibitionSchema, {...change, secret: this.secret});
    const response = await this.connection.request({case: "runExhibition", value});
    if (!response) return;
    // A wrong secret closes the connection: another attempt would not help.
    if (response.error === ErrorCode.NOT_ALLOWED) this.connection.disconnect();
    setText(this.fault, response.error === ErrorCode.OK ? "" : reasonInWords(response));
  }

  private fill(): void {
    this.marks = [];
    this.body.replaceChildren(
      el("button", {class: "stop", onclick: () => void this.connection.request({case: "stop", value: {}})}, tell("stop")),
      this.toggle("isPaused", (isOn) => tell(isOn ? "resume" : "pause")),
      this.button("skip", {skips: true}),
      this.button("moreTime", {moreTime: kMoreTime}),
      this.toggle("isResting", (isOn) => tell(isOn ? "wake" : "rest")),
      this.toggle("forbidsKicks", (isOn) => this.permission("kicks", isOn)),
      this.toggle("forbidsFalls", (isOn) => this.permission("falls", isOn)),
      this.choice("speed", kSpeeds),
      this.choice("volume", kVolumes),
      el("fieldset", {}, el("legend", {}, tell("lights")),
         ...kColors.map((lightRgb) => el("button", {
           class: "button color", style: `--color: ${cssColor(lightRgb)}`,
           "aria-label": `${tell("lights")} ${cssColor(lightRgb)}`, onclick: () => void this.run({lightRgb})}))));
  }

  private permission(key: "kicks" | "falls", isForbidden: boolean): string {
    return `${tell(key)}: ${tell(isForbidden ? "forbidden" : "allowed")}`;
  }

  private button(key: ExhibitionKey, change: Change): HTMLButtonElement {
    return el("button", {class: "button", "data-act": key, onclick: () => void this.run(change)}, tell(key));
  }

  private toggle(what: "isPaused" | "isResting" | "forbidsKicks" | "forbidsFalls",
                 words: (isOn: boolean) => string): HTMLButtonElement {
    let isOn = false;
    const button = el("button", {class: "button", onclick: () => void this.run({[what]: !isOn})}, words(false));
    this.marks.push((exhibition) => {
      isOn = exhibition[what];
      button.setAttribute("aria-pressed", String(isOn));
      setText(button, words(isOn));
    });
    return button;
  }

  private choice(what: "speed" | "volume", values: readonly number[]): HTMLElement {
    const buttons = values.map((value) =>
        el("button", {class: "button", onclick: () => void this.run({[what]: value})}, `${Math.round(value * 100)} %`));
    this.marks.push((exhibition) => {
      for (const [i, button] of buttons.entries()) {
        button.setAttribute("aria-pressed", String(Math.abs(values[i]! - exhibition[what]) < 0.01));
      }
    });
    return el("fieldset", {"data-choice": what}, el("legend", {}, tell(what)), ...buttons);
  }

  private show(exhibition: Exhibition | null): void {
    if (!exhibition) return;
    void takeLanguage(exhibition.language).then((isNew) => {
      if (!isNew) return;
      this.fill();
      this.show(exhibition);
    });
    setText(this.driver, driverInWords(exhibition));
    setText(this.time, exhibition.driver ? clockInWords(exhibition.turnLeft) : "");
    this.time.classList.toggle("warned", exhibition.isWarned);
    const names = exhibition.waiting.join(", ");
    setText(this.queue, `${tell("waiting", {number: exhibition.numWaiting})}${names ? ` (${names})` : ""} · ` +
                        tell("turns", {number: exhibition.numTurns}));
    for (const mark of this.marks) mark(exhibition);
  }
}

await takeLanguage("");
new OperatorPage(document.getElementById("app")!, new Store());
