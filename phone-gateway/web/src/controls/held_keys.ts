/** Keyboard and gamepad of this page; what they mean is in keys.ts. */
import {isDeflected, isDriveKey, kButtonKeys, pressedButtons, sticksFromPad} from "./keys";
import type {PadButton, PadSticks} from "./keys";
import {kSilenceMs} from "./walk_sender";

/** Listens on the page; keys meant for a form or a dialog are left to it.
 * @param heldChanged  called when drive keys went down or up. @param pressed  called when another key that counts went down.
 * @return a function that releases all keys: each must be pressed anew. */
export function listenToKeys(isActive: () => boolean, heldChanged: (held: ReadonlySet<string>, isSlow: boolean) => void,
                             pressed: (button: PadButton) => void): () => void {
  const held = new Set<string>();
  const notify = (event: KeyboardEvent) => heldChanged(held, event.shiftKey);
  document.addEventListener("keydown", (event) => {
    if (!isActive() || event.ctrlKey || event.metaKey || event.altKey || isForAnother(event)) return;
    if (isDriveKey(event.code)) {
      event.preventDefault();
      if (event.repeat) return;
      held.add(event.code);
      notify(event);
      return;
    }
    const button = kButtonKeys[event.code];
    if (button === "stop") event.preventDefault();
    if (button && (button === "stop" || !event.repeat)) pressed(button);
  });
  document.addEventListener("keyup", (event) => {
    if (held.delete(event.code) || event.key === "Shift") notify(event);
  });
  return () => held.clear();
}

function isForAnother({target, code}: KeyboardEvent): boolean {
  if (!(target instanceof Element)) return false;
  if (target.closest("input, select, textarea, dialog")) return true;
  return code === "Space" && target.closest("button") !== null;
}

/** What the app remembers of a gamepad. */
interface SeenPad {
  /** Its timestamp and the values of its sticks and buttons. */
  told: string;
  /** When any of them was another one last, ms. */
  aliveMs: number;
  readonly before: boolean[];
}

export interface PadListener {
  pressed(button: PadButton): void;
  /** A gamepad is there whose layout the browser does not know. */
  unknown(name: string): void;
  /** A gamepad tells nothing new although its sticks are held. */
  silent(): void;
}

/** Looks at the gamepads; call it once a frame. */
export class Gamepads {
  private readonly seen = new Map<number, SeenPad>();

  /** @param now  ms. */
  constructor(private readonly listener: PadListener, private readonly now: () => number = () => performance.now()) {}

  /** @return the position of the sticks of each gamepad that is there and shows life: a browser goes on to report the last
   * axes of one that is out of range, until the system drops it.
   *
   * Chromium on Windows stamps each reading; on Linux, as Firefox and WebKit everywhere, each change. There a stick that is held
   * quite still, at its end for example, looks as one out of range: both end, which is safe. */
  poll(): PadSticks[] {
    const held: PadSticks[] = [];
    const pads = (navigator.getGamepads?.() ?? []).filter((pad) => pad !== null);
    for (const index of this.seen.keys()) {
      if (!pads.some((pad) => pad.index === index && pad.connected)) this.seen.delete(index);
    }
    for (const pad of pads) {
      if (!pad.connected) continue;
      const seen = this.look(pad);
      if (pad.mapping !== "standard") continue;
      for (const button of pressedButtons(pad.buttons.map(({pressed}) => pressed), seen.before)) this.listener.pressed(button);
      const sticks = sticksFromPad(pad.axes);
      if (this.now() - seen.aliveMs <= kSilenceMs) held.push(sticks);
      else if (isDeflected(sticks)) this.listener.silent();
    }
    return held;
  }

  private look(pad: Gamepad): SeenPad {
    const told = [pad.timestamp, ...pad.axes, ...pad.buttons.map(({value}) => value)].join();
    let seen = this.seen.get(pad.index);
    if (!seen) {
      seen = {told, aliveMs: this.now(), before: []};
      this.seen.set(pad.index, seen);
      if (pad.mapping !== "standard") this.listener.unknown(pad.id);
    }
    if (told !== seen.told) {
      seen.told = told;
      seen.aliveMs = this.now();
    }
    return seen;
  }
}
