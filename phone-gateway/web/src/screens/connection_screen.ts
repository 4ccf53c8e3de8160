/** Where to connect to, and why it does not work just now. */
import {chooseRobot, findBluetooth, isApple} from "../bluetooth/web_bluetooth";
import {el} from "../dom";
import type {Gateway} from "../nearby";
import {readForm} from "../settings";
import type {Settings} from "../settings";
import type {AppState, Problem, Store} from "../store";
import {say} from "../text/texts";
import type {Actions, ConnectionForm} from "./actions";
import {reloadButton} from "./reload_button";

/** Problems of which the gateway knows more than this page. */
const kDetailed: readonly Problem[] = ["closed", "not-a-robot", "too-many", "wrong-token", "wrong-version"];

export class ConnectionScreen {
  readonly element: HTMLElement;
  private readonly fields: Readonly<Record<keyof ConnectionForm, HTMLInputElement>> = {
    address: field("address", "url", "192.168.1.20:8080"), token: field("token", "text", ""),
    clientName: field("client-name", "text", say("connection.namePlaceholder"))};
  private readonly problem = el("div", {class: "problem", role: "alert", hidden: true});
  private readonly submit = el("button", {class: "button primary", type: "submit"});
  private readonly cancel = el("button", {class: "button", type: "button", onclick: () => this.act.leave()}, say("connection.cancel"));
  private readonly recent = el("ul", {class: "recent", "aria-label": say("connection.recent")});
  private readonly nearby = el("ul", {class: "recent nearby", "aria-label": say("connection.nearby"), hidden: true});
  private countdown: ReturnType<typeof setInterval> | undefined;

  constructor(private readonly store: Store, private readonly act: Actions) {
    const form = el("form", {class: "card", onsubmit: (event: Event) => this.submitted(event),
                             onpaste: () => setTimeout(() => this.read())},
      el("header", {}, el("img", {class: "logo", src: "icon.svg", alt: ""}),
         el("div", {}, el("h1", {}, say("connection.title")),
            el("p", {class: "quiet"}, say("connection.subtitle")))),
      this.problem,
      labelled(say("connection.address"), this.fields.address),
      labelled(say("connection.token"), this.fields.token, say("connection.tokenHelp")),
      labelled(say("connection.name"), this.fields.clientName),
      el("div", {class: "buttons"}, this.cancel, this.submit), this.bluetooth(),
      this.nearby, this.recent);
    this.element = el("section", {class: "screen connection-screen"}, form);
    store.watch((state) => `${state.phase} ${state.problem} ${state.nextAttemptMs}`,
                () => this.update());
  }

  /** Fills the form in. */
  fill(address: string, token: string, {clientName, recent}: Settings): void {
    this.put({address, token, clientName});
    const others = recent.filter((one) => one.address !== address);
    this.recent.replaceChildren(...others.map((one) => this.choice(one.address, one)));
    this.recent.hidden = others.length === 0;
  }

  /** Other robots in the network; each opens its own page. */
  showNearby(gateways: readonly Gateway[]): void {
    this.nearby.hidden = gateways.length === 0;
    this.nearby.replaceChildren(el("li", {class: "quiet"}, say("connection.nearby")), ...gateways.map(({name, address}) =>
        this.choice(`${name} (${address})`, {address, token: ""})));
  }

  private choice(text: string, robot: Omit<ConnectionForm, "clientName">): HTMLElement {
    const connect = () => this.act.connect({...robot, clientName: this.fields.clientName.value});
    return el("li", {}, el("button", {class: "button quiet", type: "button", onclick: connect}, text));
  }

  /** The second way; or the sentence why there is none. */
  private bluetooth(): HTMLElement | null {
    const bluetooth = findBluetooth();
    if (!bluetooth) return isApple() ? el("p", {class: "quiet help no-bluetooth"}, say("connection.noBluetooth")) : null;
    const connect = async () => {
      const form = this.read();
      const device = await chooseRobot(bluetooth);
      if (device) this.act.connect(form, device);
    };
    return el("button", {class: "button quiet bluetooth", type: "button", onclick: () => void connect()},
              say("connection.bluetooth"));
  }

  private submitted(event: Event): void {
    event.preventDefault();
    if (this.store.get().phase === "waiting") return this.act.retry();
    this.act.connect(this.read());
  }

  /** Puts what was typed or pasted where it belongs. */
  private read(): ConnectionForm {
    const {address, token, clientName} = this.fields;
    const form = readForm({address: address.value, token: token.value, clientName: clientName.value});
    this.put(form);
    return form;
  }

  private put(form: ConnectionForm): void {
    for (const name of ["address", "token", "clientName"] as const) this.fields[name].value = form[name];
  }

  private update(): void {
    const state = this.store.get();
    clearInterval(this.countdown);
    this.showProblem(state);
    const isBusy = state.phase === "connecting";
    const isWaiting = state.phase === "waiting";
    this.cancel.hidden = state.phase === "idle";
    this.submit.disabled = isBusy;
    this.submit.textContent = say(isBusy ? "connection.connecting" : isWaiting ? "connection.now" : "connection.connect");
    if (isWaiting) this.countdown = setInterval(() => this.showProblem(this.store.get()), 250);
  }

  private showProblem(state: Readonly<AppState>): void {
    this.problem.hidden = state.problem === null;
    if (state.problem === null) return;
    const lines: HTMLElement[] = [el("strong", {}, say(`problem.${state.problem}`)),
                                  el("span", {}, say(`advice.${state.problem}`))];
    if (kDetailed.includes(state.problem) && state.problemDetail) lines.push(el("span", {class: "quiet"}, state.problemDetail));
    if (state.problem === "wrong-version") lines.push(reloadButton());
    if (state.phase === "waiting") {
      const seconds = Math.max(0, Math.ceil((state.nextAttemptMs - performance.now()) / 1000));
      // Not read aloud each second.
      lines.push(el("span", {class: "quiet", "aria-hidden": "true"},
                    say("connection.retry", {seconds})));
    }
    this.problem.replaceChildren(...lines);
  }
}

function field(name: string, type: string, placeholder: string): HTMLInputElement {
  return el("input", {name, type: type === "url" ? "text" : type, placeholder,
                      inputmode: type === "url" ? "url" : "text", autocomplete: "off",
                      autocapitalize: "off", spellcheck: "false", maxlength: 200});
}

function labelled(text: string, input: HTMLInputElement, help = ""): HTMLElement {
  return el("label", {}, el("span", {class: "label"}, text), input,
            help ? el("span", {class: "quiet help"}, help) : null);
}
