/** Presses that work while another finger is down. A browser makes a click of the first finger only, so a
 * button that listens for clicks alone does not react while another finger holds a joystick: Stop above all. */

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

/** Calls `act` at the first touch, without waiting for the finger to leave: for what must be fast. */
export function onPressDown(element: HTMLElement, act: () => void): void {
  element.addEventListener("pointerdown", () => act());
  element.addEventListener("click", (event) => {
    // A key makes a click without a pointer (detail 0); a pointer has acted already.
    if (event.detail === 0) act();
  });
}
