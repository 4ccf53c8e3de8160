/** Presses that work while another finger is down. A browser makes a click of the first finger only, so a
 * button that listens for clicks alone does not react while another finger holds a joystick: Stop above all. */
import {el, icon} from "../dom";
import type {Attributes, Child} from "../dom";

/** A touch that moves farther is a drag, not a press, px. */
const kTravel = 14;

/** Calls `act` when the element is pressed and released: by any finger, mouse, or key. */
export function onPress(element: HTMLElement, act: () => void): void {
  const starts = new Map<number, {x: number; y: number}>();
  element.addEventListener("click", () => act());
  element.addEventListener("pointerdown", (event) => {
    if (!event.isPrimary) starts.set(event.pointerId, {x: event.clientX, y: event.clientY});
  });
  element.addEventListener("pointercancel", (event) => starts.delete(event.pointerId));
  element.addEventListener("pointerup", (event) => {
    const start = starts.get(event.pointerId);
    starts.delete(event.pointerId);
    if (start && Math.hypot(event.clientX - start.x, event.clientY - start.y) < kTravel) act();
  });
}

/** A button that is pressed so. */
export function button(attributes: Attributes, act: () => void, ...children: Child[]): HTMLButtonElement {
  const element = el("button", attributes, ...children);
  onPress(element, act);
  return element;
}

/** One with an icon before its words. */
export function iconButton(className: string, path: string, text: Child, act: () => void): HTMLButtonElement {
  return button({class: className}, act, icon(path), typeof text === "string" ? el("span", {}, text) : text);
}

/** Calls `act` at the first touch, without waiting for the finger to leave: for what must be fast. */
export function onPressDown(element: HTMLElement, act: () => void): void {
  element.addEventListener("pointerdown", () => act());
  element.addEventListener("click", (event) => {
    // A key makes a click without a pointer (detail 0); a pointer has acted already.
    if (event.detail === 0) act();
  });
}
