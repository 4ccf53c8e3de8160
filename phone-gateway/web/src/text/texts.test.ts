import {readFileSync} from "node:fs";
import {afterEach, describe, expect, it} from "vitest";
import {readActions, readJointGroups, readLabels, readPostures} from "../../test_support/nao_files";
import {chooseLanguage, kLanguages, reasonInWords, say, sayName, setLabels, setLanguage} from "./texts";

const kRoot = new URL("../../../../", import.meta.url).pathname;
const kFolders = [new URL("./", import.meta.url), new URL("../exhibition/", import.meta.url)];

type Tree = {[key: string]: string | Tree};
/** Paths and texts of a language's file. */
const flat = (tree: Tree, path = ""): [string, string][] => Object.entries(tree).flatMap(([key, value]) =>
    typeof value === "string" ? [[`${path}/${key}`, value] as [string, string]] : flat(value, `${path}/${key}`));
const textsOf = (folder: URL, language: string) =>
    new Map(flat(JSON.parse(readFileSync(new URL(`${language}.json`, folder), "utf8")) as Tree));
const places = (text: string) => (text.match(/\{\w+\}/g) ?? []).sort().join();

/** Codes and number of arguments in a C++ table of {"code", "arguments", "sentence"}. */
function reasonsOf(file: string): Map<string, number> {
  const rows = readFileSync(kRoot + file, "utf8").matchAll(/^ *\{"([a-z]+(?:-[a-z]+)+)", "([^"]*)", "/gm);
  return new Map([...rows].map(([, code, names]) => [code ?? "", names ? names.split(",").length : 0]));
}

afterEach(() => setLanguage("en"));

describe.each(kLanguages.filter((tag) => tag !== "en"))("%s", (language) => {
  it.each(kFolders.map((folder) => [folder.pathname.split("/").at(-2), folder] as const))("says all texts of %s, with the same values", (_, folder) => {
    const english = textsOf(folder, "en");
    const texts = textsOf(folder, language);
    expect([...texts.keys()].filter((path) => !path.startsWith("/reasons/"))).toEqual([...english.keys()]);
    for (const [path, text] of texts) {
      expect(text.trim(), path).not.toBe("");
      if (english.has(path)) expect(places(text), path).toBe(places(english.get(path)!));
    }
  });

  it("has a sentence for every reason of both tables, with arguments that exist", () => {
    const documented = new Map([...reasonsOf("libs/messages/reason_table.h"),
                                ...reasonsOf("phone-gateway/server/core/gateway_reasons.h")]);
    expect(documented.size).toBeGreaterThan(80);
    const texts = textsOf(kFolders[0]!, language);
    expect([...documented.keys()].filter((code) => !texts.has(`/reasons/${code}`))).toEqual([]);
    for (const [code, count] of documented) {
      for (const [, index] of texts.get(`/reasons/${code}`)!.matchAll(/\{(\d)\}/g)) expect(Number(index), code).toBeLessThan(count);
    }
  });
});

describe("texts", () => {
  it("are chosen by the phone's languages", () => {
    expect(chooseLanguage(["fr-FR", "pt-BR", "en"])).toBe("pt");
    expect(chooseLanguage(["de-AT"])).toBe("de");
    expect(chooseLanguage(["ar-EG"])).toBe("ar");
    expect(chooseLanguage(["ja"])).toBe("en");
  });

  it("fill values in", () => {
    expect(say("control.other", {name: "Ana"})).toBe("Ana drives");
  });

  it("call all that the robot does and each of its joint groups as the robot says, in every language", async () => {
    const folder = `${kRoot}data/robots/nao`;
    const labels = readLabels(folder);
    const keys = [...Object.keys(readPostures(folder)).map((name) => `posture ${name}`),
                  ...readActions(folder).map((name) => `action ${name}`),
                  ...readJointGroups(folder).map(({name}) => `group ${name}`)];
    expect(keys.length).toBeGreaterThan(30);
    for (const language of kLanguages) {
      const known = labels.filter((label) => label.language === language)
          .map(({kind, name}) => `${kind} ${name}`);
      expect(keys.filter((key) => !known.includes(key)), language).toEqual([]);
    }
    setLabels(labels);
    await setLanguage("pt");
    expect(sayName("posture", "Crouch")).toBe("Agachar");
    setLabels([]);
  });

  it("show a name without translation as it is", () => {
    expect(sayName("posture", "Crouch")).toBe("Crouch");
    expect(sayName("action", "moon-walk")).toBe("moon walk");
  });
});

describe("reasonInWords", () => {
  const reason = {message: "Joint Tail is unknown.", reasonCode: "joint-unknown", reasonArguments: ["Tail"]};

  it("translates a code and fills in its arguments", async () => {
    await setLanguage("de");
    expect(reasonInWords(reason)).toBe("Der Roboter hat kein Gelenk Tail.");
    await setLanguage("pt");
    expect(reasonInWords(reason)).toBe("O robô não tem a articulação Tail.");
  });

  it("shows the English sentence in English and for an unknown code", async () => {
    expect(reasonInWords(reason)).toBe(reason.message);
    await setLanguage("de");
    expect(reasonInWords({...reason, reasonCode: "not-in-the-table"})).toBe(reason.message);
  });
});
