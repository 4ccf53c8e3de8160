/** Relates the gateway's clock to this page's by pings: what is how old is known without a common clock. */

/** Pings that count; ms of drift between two clocks in the 20 s that they take: 2 at most. */
const kNumPings = 20;

export class ClockRelation {
  private readonly samples: {roundTripMs: number; offsetMs: number}[] = [];
  /** The gateway's clock minus this page's, ms; null: no ping has been answered. */
  private offsetMs: number | null = null;

  /** A ping was answered. @param sentMs, receivedMs  on this page's clock. @param gatewayTime  when the answer was sent, s on the
   * gateway's clock; 0: not told. */
  add(sentMs: number, receivedMs: number, gatewayTime: number): void {
    if (!(gatewayTime > 0)) return;
    this.samples.push({roundTripMs: receivedMs - sentMs, offsetMs: gatewayTime * 1000 - (sentMs + receivedMs) / 2});
    if (this.samples.length > kNumPings) this.samples.shift();
    // The fastest ping says most: its answer was held up least, and its error is below half its round trip.
    this.offsetMs = this.samples.reduce((best, one) => one.roundTripMs < best.roundTripMs ? one : best).offsetMs;
  }

  /** How long a message was under way, ms; null: not known. @param sentAt  s on the gateway's clock. */
  transitMs(sentAt: number, nowMs: number): number | null {
    if (this.offsetMs === null || !(sentAt > 0)) return null;
    return Math.max(0, nowMs + this.offsetMs - sentAt * 1000);
  }

  /** Another gateway, or the same after a restart. */
  reset(): void {
    this.samples.length = 0;
    this.offsetMs = null;
  }
}
