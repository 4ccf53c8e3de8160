/** Reasons of refusals and failures in the page's language, by their code. */
import {kReasonTexts} from "./reason_texts";
import {getLanguage} from "./texts";

/** The reason fields that Response and Notice share. */
export interface Reason {
  /** English sentence. */
  message: string;
  reasonCode: string;
  reasonArguments: string[];
}

/** @return the translated sentence; the English one in English and for a code without translation. */
export function reasonInWords({message, reasonCode, reasonArguments}: Reason): string {
  const language = getLanguage();
  const row = kReasonTexts[reasonCode];
  if (language === "en" || !row) return message;
  const text = language === "pt" ? row[0] : row[1];
  return text.replace(/\{(\d)\}/g, (place, index: string) => reasonArguments[Number(index)] ?? place);
}
