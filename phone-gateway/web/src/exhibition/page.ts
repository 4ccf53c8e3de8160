/** What the big display and the operator's page have in common: their address and their language. */
import {loadSettings, tokenFromUrl} from "../settings";
import {storage} from "../storage";
import {chooseLanguage, getLanguage, setPageLanguage} from "../text/texts";
import {setWords} from "./exhibition_texts";

/** A value behind the '#' of the address, kept for the next visit: it is the gateway's own page. */
export function fromAddress(name: string): string {
  const given = new URLSearchParams(location.hash.slice(1)).get(name);
  const memory = storage();
  if (given) memory?.setItem(`nao-remote-${name}`, given);
  return given ?? memory?.getItem(`nao-remote-${name}`) ?? "";
}

/** The pairing code: of the address, or that of an earlier visit. */
export function pairingToken(): string {
  const known = loadSettings(storage()).recent.find(({address}) => address === location.host);
  return tokenFromUrl(new URL(location.href)) || fromAddress("token") || (known?.token ?? "");
}

/** @param tag  of the exhibition's settings. @return whether it is another one than before. */
export async function takeLanguage(tag: string): Promise<boolean> {
  const language = chooseLanguage([new URLSearchParams(location.hash.slice(1)).get("lang") ?? "", tag]);
  const isNew = getLanguage() !== language;
  if (isNew) await Promise.all([setPageLanguage(language), setWords(language)]);
  return isNew && getLanguage() === language;
}
