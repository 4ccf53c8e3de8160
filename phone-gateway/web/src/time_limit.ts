/** Aborts a fetch after a time, ms. iPhones before iOS 16 have no AbortSignal.timeout(). */
export function timeLimit(ms: number): AbortSignal {
  const controller = new AbortController();
  setTimeout(() => controller.abort(), ms);
  return controller.signal;
}
