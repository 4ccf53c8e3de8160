/** Fingers, mouse and wheel on the stage: one finger looks around, two come nearer, a double tap
 * returns to the first view. A single tap calls the handler. What a finger grabs goes with it instead. */
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

/** Something that a finger holds; px from the canvas's top left. */
export interface Grip {
  move(x: number, y: number): void;
  end(): void;
}

/** @param tapped  called with the place of a tap, px from the canvas's top left.
 * @param grab  what a finger that goes down there holds; null: it looks around. */
export function attachGestures(stage: Stage, tapped: (x: number, y: number) => void,
                               grab: (x: number, y: number) => Grip | null): void {
  const {canvas, orbit} = stage;
  const fingers = new Map<number, Finger>();
  const grips = new Map<number, Grip>();
  let lastTapMs = -1e9;

  const spread = (): number => {
    const [a, b] = [...fingers.values()];
    return a && b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
  };

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, {x: event.clientX, y: event.clientY, startX: event.clientX,
                                  startY: event.clientY, startMs: event.timeStamp});
    const grip = grab(...placeOn(canvas, event));
    if (grip) grips.set(event.pointerId, grip);
  });
  canvas.addEventListener("pointermove", (event) => {
    const finger = fingers.get(event.pointerId);
    if (!finger) return;
    const before = spread();
    const dx = event.clientX - finger.x;
    const dy = event.clientY - finger.y;
    finger.x = event.clientX;
    finger.y = event.clientY;
    const grip = grips.get(event.pointerId);
    if (grip) grip.move(...placeOn(canvas, event));
    else if (fingers.size === 1) orbit.turn(-dx * kTurnPerPixel, dy * kTurnPerPixel);
    else if (before > 0) orbit.zoom(spread() / before);
  });
  const lift = (event: PointerEvent): void => {
    grips.get(event.pointerId)?.end();
    grips.delete(event.pointerId);
    const finger = fingers.get(event.pointerId);
    if (!fingers.delete(event.pointerId) || !finger || event.type !== "pointerup") return;
    const travel = Math.hypot(event.clientX - finger.startX, event.clientY - finger.startY);
    if (travel > kTapTravel || event.timeStamp - finger.startMs > kTapMs) return;
    if (event.timeStamp - lastTapMs < kDoubleTapMs) orbit.reset();
    lastTapMs = event.timeStamp;
    tapped(...placeOn(canvas, event));
  };
  canvas.addEventListener("pointerup", lift);
  canvas.addEventListener("pointercancel", lift);
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    orbit.zoom(Math.exp(-event.deltaY * 0.001));
  }, {passive: false});
}

/** Where a finger is, px from the canvas's top left. */
function placeOn(canvas: HTMLCanvasElement, event: PointerEvent): [number, number] {
  const box = canvas.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}
