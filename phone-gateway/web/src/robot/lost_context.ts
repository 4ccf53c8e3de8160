/** The browser may take the drawing context, as in the background, and gives it back when it can. */

/** From the loss to telling it; ms. Chosen: browsers restore a context within one second, or not at all. */
export const kRestoreMs = 3000;

/** @param changed  called with true if the view stays empty, and with false when it is drawn again. */
export function watchContext(canvas: EventTarget, changed: (isLost: boolean) => void): void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  canvas.addEventListener("webglcontextlost", (event) => {
    // Otherwise it is never restored.
    event.preventDefault();
    clearTimeout(timer);
    timer = setTimeout(() => changed(true), kRestoreMs);
  });
  canvas.addEventListener("webglcontextrestored", () => {
    clearTimeout(timer);
    changed(false);
  });
}
