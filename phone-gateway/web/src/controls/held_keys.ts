/** Keyboard and gamepad of this page; what they mean is in keys.ts. */
import {isDriveKey, pressedButtons} from "./keys";
import type {PadButton} from "./keys";

export interface KeyActions {
  /** Drive keys went down or up. */
  heldChanged(held: ReadonlySet<string>, isSlow: boolean): void;
  pressed(button: PadButton): void;
}

/** Listens on the page; keys meant for a form or a dialog are left to it. */
export function listenToKeys(isActive: () => boolean, actions: KeyActions): void {
  const held = new Set<string>();
  const notify = (event: KeyboardEvent) => actions.heldChanged(held, event.shiftKey);
  document.addEventListener("keydown", (event) => {
    if (!isActive() || event.ctrlKey || event.metaKey || event.altKey || isForAnother(event)) return;
    if (isDriveKey(event.code)) {
      event.preventDefault();
      if (event.repeat) return;
      held.add(event.code);
      notify(event);
    } else if (event.code === "Space" || event.code === "Escape") {
      event.preventDefault();
      actions.pressed("stop");
    } else if (event.code === "KeyL" && !event.repeat) {
      actions.pressed("lock");
    }
  });
  document.addEventListener("keyup", (event) => {
    if (held.delete(event.code) || event.key === "Shift") notify(event);
  });
  window.addEventListener("blur", () => {
    held.clear();
    actions.heldChanged(held, false);
  });
}

function isForAnother({target, code}: KeyboardEvent): boolean {
  if (!(target instanceof Element)) return false;
  if (target.closest("input, select, textarea, dialog")) return true;
  return code === "Space" && target.closest("button") !== null;
}

/** Looks at the first gamepad; call it once a frame. */
export class Gamepads {
  private readonly before: boolean[] = [];
  private readonly axes: number[] = [];
  private readonly buttons: boolean[] = [];

  /** @param pressed  called for each button that went down.
   * @return the sticks' axes, or null where there is no gamepad; valid until the next call. */
  poll(pressed: (button: PadButton) => void): readonly number[] | null {
    const pad = navigator.getGamepads?.().find((one) => one?.mapping === "standard");
    if (!pad) return null;
    for (let i = 0; i < pad.buttons.length; i++) this.buttons[i] = pad.buttons[i]!.pressed;
    for (const button of pressedButtons(this.buttons, this.before)) pressed(button);
    for (let i = 0; i < pad.axes.length; i++) this.axes[i] = pad.axes[i]!;
    return this.axes;
  }
}
