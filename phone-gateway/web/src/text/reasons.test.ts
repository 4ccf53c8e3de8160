import {readFileSync} from "node:fs";
import {afterEach, describe, expect, it} from "vitest";
import {kReasonTexts} from "./reason_texts";
import {reasonInWords} from "./reasons";
import {setLanguage} from "./texts";

const kRoot = new URL("../../../../", import.meta.url).pathname;

/** Codes and number of arguments in a C++ table of {"code", "arguments", "sentence"}. */
function reasonsOf(file: string): Map<string, number> {
  const rows = readFileSync(kRoot + file, "utf8").matchAll(/^ *\{"([a-z]+(?:-[a-z]+)+)", "([^"]*)", "/gm);
  return new Map([...rows].map(([, code, names]) => [code ?? "", names ? names.split(",").length : 0]));
}

const documented = new Map([...reasonsOf("libs/messages/reason_table.h"),
                            ...reasonsOf("phone-gateway/server/core/gateway_reasons.h")]);
const reason = {message: "Joint Tail is unknown.", reasonCode: "joint-unknown", reasonArguments: ["Tail"]};

afterEach(() => setLanguage("en"));

describe("reasonInWords", () => {
  it("translates a code and fills in its arguments", () => {
    setLanguage("de");
    expect(reasonInWords(reason)).toBe("Der Roboter hat kein Gelenk Tail.");
    setLanguage("pt");
    expect(reasonInWords(reason)).toBe("O robô não tem a articulação Tail.");
  });
  it("shows the English sentence in English and for an unknown code", () => {
    expect(reasonInWords(reason)).toBe(reason.message);
    setLanguage("de");
    expect(reasonInWords({...reason, reasonCode: "not-in-the-table"})).toBe(reason.message);
  });
});

describe("reason texts", () => {
  it("exist for every code of both tables", () => {
    expect(documented.size).toBeGreaterThan(80);
    expect([...documented.keys()].filter((code) => !(code in kReasonTexts))).toEqual([]);
  });
  it.each(Object.entries(kReasonTexts))("%s has a sentence in both languages, with arguments that exist",
                                        (code, row) => {
    for (const text of row) {
      expect(text.trim()).not.toBe("");
      for (const [, index] of text.matchAll(/\{(\d)\}/g)) {
        expect(Number(index)).toBeLessThan(documented.get(code) ?? 9);
      }
    }
  });
});
