/** All that the app says, in the language of the page: en.json and its like, of which a phone fetches one. Placeholders are
 * written {name}. `texts` has all keys; `reasons`, by code and with {0}, {1} for arguments, has the sentences of nao-motion
 * (reason_table.h) and of the gateway (gateway_reasons.h), which come in English with the message. */
import type {Response} from "../protocol/generated/remote_pb";
import en from "./en.json";

/** In English, and as a code. */
type Reason = Pick<Response, "message" | "reasonCode" | "reasonArguments">;

export type TextKey = keyof typeof en.texts;

interface Texts {
  texts: Readonly<Record<TextKey, string>>;
  reasons: Readonly<Record<string, string>>;
}

/** What each language calls itself. */
export const kLanguageNames = {en: "English", pt: "Português", de: "Deutsch", ar: "العربية"} as const;
export type Language = keyof typeof kLanguageNames;
export const kLanguages = Object.keys(kLanguageNames) as Language[];
const kRightToLeft: readonly Language[] = ["ar"];

const kFiles: Readonly<Record<Exclude<Language, "en">, () => Promise<{default: Texts}>>> = {
  pt: () => import("./pt.json"),
  de: () => import("./de.json"),
  ar: () => import("./ar.json"),
};

let language: Language = "en";
let said: Texts = en;

/** English at once, another language when its file is here. */
export async function setLanguage(value: Language): Promise<void> {
  said = value === "en" ? en : (await kFiles[value]()).default;
  language = value;
}

/** For the whole page: also its direction. It speaks English where the language's file cannot be had. */
export async function setPageLanguage(value: Language): Promise<void> {
  await setLanguage(value).catch(() => {});
  document.documentElement.lang = language;
  document.documentElement.dir = kRightToLeft.includes(language) ? "rtl" : "ltr";
}

export function getLanguage(): Language {
  return language;
}

/** The first of the preferred languages ("pt-BR", "de") that the app speaks. */
export function chooseLanguage(preferred: readonly string[]): Language {
  const known = preferred.map((tag) => tag.toLowerCase().split("-")[0] as Language);
  return known.find((tag) => kLanguages.includes(tag)) ?? "en";
}

/** A text with its placeholders filled in. */
export function fillIn(text: string, values: Readonly<Record<string, string | number>>): string {
  return text.replace(/\{(\w+)\}/g, (place, name: string) => String(values[name] ?? place));
}

/** What to say, in the page's language. */
export function say(key: TextKey, values: Readonly<Record<string, string | number>> = {}): string {
  return fillIn(said.texts[key], values);
}

/** True for the key of a text. */
export function isText(key: string): key is TextKey {
  return key in en.texts;
}

/** The reason that a response or a notice gives.
 * @return the translated sentence; the English one in English and for a code without translation. */
export function reasonInWords({message, reasonCode, reasonArguments}: Reason): string {
  return fillIn(said.reasons[reasonCode] ?? message, Object.fromEntries(reasonArguments.entries()));
}

/** What the connected robot calls its postures, actions, joint groups, cameras and lights: by "posture.Crouch",
 * then by language. */
let labels: ReadonlyMap<string, ReadonlyMap<string, string>> = new Map();

/** @param list  RobotDescription.labels of the connected robot. */
export function setLabels(list: readonly {kind: string; name: string; language: string; text: string}[]): void {
  const all = new Map<string, Map<string, string>>();
  for (const {kind, name, language: tag, text} of list) {
    const key = `${kind}.${name}`;
    all.set(key, (all.get(key) ?? new Map<string, string>()).set(tag, text));
  }
  labels = all;
}

/** A name from the robot ("posture", "Crouch") as a person says it; unknown names as they are. */
export function sayName(family: "posture" | "action" | "group" | "camera" | "light", name: string): string {
  const known = labels.get(`${family}.${name}`);
  return known?.get(language) ?? known?.get("en") ?? name.replace(/[-_]/g, " ");
}
