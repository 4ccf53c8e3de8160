/** What the phone remembers about speech. */

const kKey = "nao-remote-speech";
const kMaxPhrases = 30;

export interface SpeechSettings {
  /** Kept phrases, newest first; null: none was kept or forgotten yet. */
  phrases: readonly string[] | null;
  /** Tag of the texts' language; empty: the app's. */
  language: string;
  /** True: this phone plays what the robot says. */
  isPlaying: boolean;
}

const kDefaults: SpeechSettings = {phrases: null, language: "", isPlaying: false};

/** Reads the settings; those that another version wrote badly count as not there. */
export function loadSpeechSettings(storage: Storage | null): SpeechSettings {
  try {
    const {phrases, language, isPlaying} = JSON.parse(storage?.getItem(kKey) ?? "{}") as Partial<SpeechSettings>;
    return {
      phrases: Array.isArray(phrases) ? phrases.filter((phrase) => typeof phrase === "string").slice(0, kMaxPhrases)
          : null,
      language: typeof language === "string" ? language : "",
      isPlaying: isPlaying === true,
    };
  } catch {
    return {...kDefaults};
  }
}

export function saveSpeechSettings(storage: Storage | null, settings: SpeechSettings): void {
  try {
    storage?.setItem(kKey, JSON.stringify(settings));
  } catch {
    // Private browsing without storage: the app works, it only forgets.
  }
}

/** Puts a phrase in front of those that are kept. */
export function keepPhrase(phrases: readonly string[], phrase: string): string[] {
  return [phrase, ...phrases.filter((other) => other !== phrase)].slice(0, kMaxPhrases);
}
