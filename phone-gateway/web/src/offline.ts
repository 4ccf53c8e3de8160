/** Secure pages keep a copy of the app, so that it opens without the robot and says that it is away.
 * Called when the robot is in sight: the copy must not compete with what is needed to see it. */
export async function registerOfflineShell(): Promise<void> {
  if (!import.meta.env.PROD || !("serviceWorker" in navigator)) return;
  try {
    await navigator.serviceWorker.register("/sw.js");
    const {active} = await navigator.serviceWorker.ready;
    active?.postMessage(performance.getEntriesByType("resource").map(({name}) => name).filter((name) => name.includes("/assets/")));
  } catch {
    // A certificate that the phone only tolerates allows no service worker: the app does without.
  }
}
