/** The phone's memory for this page; null where the browser forbids it. */
export function storage(): Storage | null {
  try {
    return window.localStorage;
  } catch {
    return null;
  }
}

/** What was kept under a key; null: nothing, or what another version wrote badly. */
export function recall<Kept>(memory: Storage | null, key: string): Partial<Kept> | null {
  try {
    return JSON.parse(memory?.getItem(key) ?? "null") as Partial<Kept> | null;
  } catch {
    return null;
  }
}

/** Private browsing may have no memory, or a full one: the app works, it only forgets. */
export function keep(memory: Storage | null, key: string, value: unknown): void {
  try {
    memory?.setItem(key, JSON.stringify(value));
  } catch {
    // As said.
  }
}
