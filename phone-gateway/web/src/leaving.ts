/** The page is no longer in a person's hands: another window has the focus, or nobody sees the page. */
export interface LeavingListener {
  /** Another window has the keys, and what was held may be let go without a word. */
  blurred(): void;
  /** Nobody sees the page: another app, a locked screen, a closed page. */
  hidden(): void;
  /** It is seen again. */
  shown(): void;
}

export function listenToLeaving(listener: LeavingListener): void {
  window.addEventListener("blur", () => listener.blurred());
  window.addEventListener("pagehide", () => listener.hidden());
  document.addEventListener("visibilitychange", () =>
      document.visibilityState === "hidden" ? listener.hidden() : listener.shown());
}
