/** Reports what happens in the match by a message and a sound. */
import type {Messages} from "../messages";
import {Match_Event} from "../protocol/generated/remote_pb";
import type {Match} from "../protocol/generated/remote_pb";
import type {Sound} from "../sound";
import type {Store} from "../store";
import {eventInWords} from "./match_words";
import {playTones, tonesOf} from "./match_sound";

export class MatchEvents {
  /** Number of the last event that was told; negative before the first match. */
  private lastEvent = -1n;

  constructor(store: Store, private readonly messages: Messages, private readonly sound: Pick<Sound, "running">) {
    store.watch((state) => state.match, (match) => this.changed(match));
  }

  private changed(match: Match | null): void {
    const event = match?.eventId ?? -1n;
    // What happened before this phone came, or before another match, is not told.
    const isNew = this.lastEvent >= 0n && event > this.lastEvent;
    this.lastEvent = event;
    if (!match || !isNew) return;
    const words = eventInWords(match);
    if (words) this.messages.show(match.event === Match_Event.GOAL ? "good" : "info", words);
    playTones(this.sound.running, tonesOf(match.event));
  }
}
