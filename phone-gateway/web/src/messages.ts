/** Short messages to the user that disappear after some seconds. */
import type {Message, Store} from "./store";

const kMaxShown = 3;
/** Long enough to read a sentence of 12 words at a slow 2 words a second. */
const kShownMs = 6000;

export class Messages {
  private nextId = 1;
  private readonly timers = new Map<number, ReturnType<typeof setTimeout>>();

  constructor(private readonly store: Store) {}

  /** Shows a sentence. One that is shown already stays, for longer.
   * @return false if it was shown already: a refusal that comes ten times a second is one event. */
  show(kind: Message["kind"], text: string): boolean {
    if (!text) return false;
    const shown = this.store.get().messages.find((message) => message.text === text);
    const message = shown ?? {id: this.nextId++, kind, text};
    clearTimeout(this.timers.get(message.id));
    this.timers.set(message.id, setTimeout(() => this.remove(message.id), kShownMs));
    if (!shown) this.store.set({messages: [...this.store.get().messages, message].slice(-kMaxShown)});
    return !shown;
  }

  private remove(id: number): void {
    this.timers.delete(id);
    this.store.set({messages: this.store.get().messages.filter((message) => message.id !== id)});
  }
}
