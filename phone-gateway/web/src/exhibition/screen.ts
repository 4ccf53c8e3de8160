/** The big display beside the robot: code, live image and 3D view, who drives, queue, countdown, challenge. */
import "../styles/app.css";
import "./screen.css";
import {el, setText} from "../dom";
import type {Exhibition} from "../protocol/generated/remote_pb";
import {Store} from "../store";
import {tell} from "./exhibition_texts";
import {LiveView} from "./live_view";
import {pairingToken, takeLanguage} from "./page";
import {challengeInWords, challengeTime, driverInWords} from "./words";
import {clockInWords} from "../text/clock";

class Screen {
  private readonly driver = el("h1");
  private readonly time = el("p", {class: "screen-time"});
  private readonly challenge = el("p", {class: "screen-challenge"});
  private readonly best = el("p", {class: "screen-best"});
  private readonly scan = el("h2");
  private readonly title = el("h2");
  private readonly queue = el("ol", {class: "screen-queue"});
  private readonly rest = el("p", {class: "screen-rest"});
  private readonly link = el("p", {class: "screen-link", role: "alert", hidden: true});

  constructor(root: HTMLElement, store: Store, live: LiveView) {
    root.append(
      el("section", {class: "big-screen"},
         el("div", {class: "screen-view"}, live.canvas, live.image, this.link),
         el("header", {class: "screen-head"}, this.driver, this.time),
         el("div", {class: "screen-side"}, this.scan, el("img", {class: "screen-code", src: "/qr.png", alt: ""}),
            this.title, this.queue, this.rest),
         el("footer", {class: "screen-foot"}, this.challenge, this.best)));
    store.watch((state) => state.exhibition, (exhibition) => this.show(exhibition));
    store.watch((state) => state.phase, (phase) => {
      this.link.hidden = phase === "connected";
      setText(this.link, tell("noLink"));
    });
  }

  private show(exhibition: Exhibition | null): void {
    void takeLanguage(exhibition?.language ?? "").then((isNew) => {
      if (isNew) this.show(exhibition);
    });
    setText(this.scan, tell("scan"));
    if (!exhibition) return;
    const {driver, waiting, numWaiting, bestTime, bestNickname} = exhibition;
    setText(this.driver, driverInWords(exhibition));
    setText(this.time, driver ? clockInWords(exhibition.turnLeft) : "");
    this.time.classList.toggle("warned", exhibition.isWarned);
    setText(this.title, waiting.length > 0 ? tell("queue") : "");
    if (this.queue.textContent !== waiting.join("")) this.queue.replaceChildren(...waiting.map((name) => el("li", {}, name)));
    const hidden = numWaiting - waiting.length;
    setText(this.rest, hidden > 0 ? tell("more", {number: hidden}) : !driver && numWaiting === 0 ? tell("nobody") :
            exhibition.numTurns > 0 ? tell("turns", {number: exhibition.numTurns}) : "");
    setText(this.challenge, challengeInWords(exhibition));
    setText(this.best, bestTime > 0 ? tell("best", {time: challengeTime(bestTime), name: bestNickname}) : "");
  }
}

await takeLanguage("");
const store = new Store();
const live = new LiveView(store);
new Screen(document.getElementById("app")!, store, live);
live.connection.connect({token: pairingToken(), clientName: "screen", clientSoftware: "nao-phone-app screen"});
