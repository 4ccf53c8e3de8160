/** When to try again: soon at first, for a gateway that restarts is back within seconds; later at a
 * calm pace, so that a phone left on the table does not empty its battery. */

const kFirstDelayMs = 500;
const kLongestDelayMs = 5000;

/** Pause before the attempt after `numFailures` failures in a row (1, 2, ...), ms. */
export function retryDelayMs(numFailures: number): number {
  return Math.min(kFirstDelayMs * 2 ** Math.max(0, numFailures - 1), kLongestDelayMs);
}
