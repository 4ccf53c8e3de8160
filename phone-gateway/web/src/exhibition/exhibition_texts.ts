/** Words of an exhibition: of its visitors' phones, the big display and the operator's page; a file for each language. */
import {fillIn} from "../text/texts";
import type {Language} from "../text/texts";
import en from "./en.json";

export type ExhibitionKey = keyof typeof en;
type Words = Readonly<Record<ExhibitionKey, string>>;

const kFiles: Readonly<Record<Language, () => Promise<{default: Words}>>> = {
  en: () => Promise.resolve({default: en}),
  pt: () => import("./pt.json"),
  de: () => import("./de.json"),
  ar: () => import("./ar.json"),
};

let words: Words = en;

/** They stay as they were where the language's file cannot be had. */
export async function setWords(language: Language): Promise<void> {
  words = await kFiles[language]().then((file) => file.default, () => words);
}

export function tell(key: ExhibitionKey, values: Readonly<Record<string, string | number>> = {}): string {
  return fillIn(words[key], values);
}
