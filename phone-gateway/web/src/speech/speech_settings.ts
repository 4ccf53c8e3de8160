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
    phrases: Array.isArray(phrases) ? phrases.filter((phrase) => typeof phrase === "string") : null,
    language: typeof language === "string" ? language : "",
    isPlaying: isPlaying === true,
  };
}

/** @return the settings as they are kept, with the newest phrases. */
export function saveSpeechSettings(storage: Storage | null, settings: SpeechSettings): SpeechSettings {
  const kept = {...settings, phrases: settings.phrases?.slice(0, kMaxPhrases) ?? null};
  keep(storage, kKey, kept);
  return kept;
}
