/** Fingers, mouse and wheel on the stage: one finger looks around, two come nearer, a double tap
 * returns to the first view. A single tap calls the handler. */
import type {Stage} from "./stage";

/** A touch that moves less and lasts shorter is a tap: px, ms. */
const kTapTravel = 12;
const kTapMs = 350;
const kDoubleTapMs = 320;
const kTurnPerPixel = 0.008;

interface Finger {
  x: number;
  y: number;
  startX: number;
  startY: number;
  startMs: number;
}

/** @param tapped  called with the place of a tap, px from the canvas's top left. */
export function attachGestures(stage: Stage, tapped: (x: number, y: number) => void = () => {}): void {
  const {canvas, orbit} = stage;
  const fingers = new Map<number, Finger>();
  let lastTapMs = -1e9;

  const spread = (): number => {
    const [a, b] = [...fingers.values()];
    return a && b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
  };

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, {x: event.clientX, y: event.clientY, startX: event.clientX,
                                  startY: event.clientY, startMs: event.timeStamp});
  });
  canvas.addEventListener("pointermove", (event) => {
    const finger = fingers.get(event.pointerId);
    if (!finger) return;
    const before = spread();
    const dx = event.clientX - finger.x;
    const dy = event.clientY - finger.y;
    finger.x = event.clientX;
    finger.y = event.clientY;
    if (fingers.size === 1) orbit.turn(-dx * kTurnPerPixel, dy * kTurnPerPixel);
    else if (before > 0) orbit.zoom(spread() / before);
  });
  const lift = (event: PointerEvent): void => {
    const finger = fingers.get(event.pointerId);
    if (!fingers.delete(event.pointerId) || !finger || event.type !== "pointerup") return;
    const travel = Math.hypot(event.clientX - finger.startX, event.clientY - finger.startY);
    if (travel > kTapTravel || event.timeStamp - finger.startMs > kTapMs) return;
    if (event.timeStamp - lastTapMs < kDoubleTapMs) orbit.reset();
    lastTapMs = event.timeStamp;
    const box = canvas.getBoundingClientRect();
    tapped(event.clientX - box.left, event.clientY - box.top);
  };
  canvas.addEventListener("pointerup", lift);
  canvas.addEventListener("pointercancel", lift);
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    orbit.zoom(Math.exp(-event.deltaY * 0.001));
  }, {passive: false});
}
