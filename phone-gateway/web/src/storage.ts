/** The phone's memory for this page; null where the browser forbids it. */
export function storage(): Storage | null {
  try {
    return window.localStorage;
  } catch {
    return null;
  }
}
