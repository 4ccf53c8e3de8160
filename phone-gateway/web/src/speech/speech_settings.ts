/** What the phone remembers about speech. */
import {keep, recall} from "../storage";

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

/** Reads the settings; those that another version wrote badly count as not there. */
export function loadSpeechSettings(storage: Storage | null): SpeechSettings {
  const {phrases, language, isPlaying} = recall<SpeechSettings>(storage, kKey) ?? {};
  return {
    phrases: Array.isArray(phrases) ? phrases.filter((phrase) => typeof phrase === "string").slice(0, kMaxPhrases) : null,
    language: typeof language === "string" ? language : "",
    isPlaying: isPlaying === true,
  };
}

export function saveSpeechSettings(storage: Storage | null, settings: SpeechSettings): void {
  keep(storage, kKey, settings);
}

/** Puts a phrase in front of those that are kept. */
export function keepPhrase(phrases: readonly string[], phrase: string): string[] {
  return [phrase, ...phrases.filter((other) => other !== phrase)].slice(0, kMaxPhrases);
}
