/** The page is no longer in a person's hands. Blurred: another window has the keys, and what was held may be let go without a
 * word. Hidden: nobody sees the page, as with another app, a locked screen, a closed page. Shown: it is seen again. */
export function listenToLeaving(listener: Readonly<Record<"blurred" | "hidden" | "shown", () => void>>): void {
  window.addEventListener("blur", () => listener.blurred());
  window.addEventListener("pagehide", () => listener.hidden());
  document.addEventListener("visibilitychange", () =>
      document.visibilityState === "hidden" ? listener.hidden() : listener.shown());
}
