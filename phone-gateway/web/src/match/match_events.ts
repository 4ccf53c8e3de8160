/** Reports what happens in the match by a message and a sound. */
import type {Messages} from "../messages";
import {Match_Event} from "../protocol/generated/remote_pb";
import type {Sound} from "../sound";
import type {Store} from "../store";
import {eventInWords} from "./match_words";
import {playTones, tonesOf} from "./match_sound";

export function reportMatch(store: Store, messages: Messages, sound: Pick<Sound, "running">): void {
  // Number of the last event that was told; negative before the first match.
  let lastEvent = -1n;
  store.watch((state) => state.match, (match) => {
    const event = match?.eventId ?? -1n;
    // What happened before this phone came, or before another match, is not told.
    const isNew = lastEvent >= 0n && event > lastEvent;
    lastEvent = event;
    if (!match || !isNew) return;
    const words = eventInWords(match);
    if (words) messages.show(match.event === Match_Event.GOAL ? "good" : "info", words);
    playTones(sound.running, tonesOf(match.event));
  });
}
