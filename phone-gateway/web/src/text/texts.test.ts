import {describe, expect, it} from "vitest";
import {readActions, readJointGroups, readLabels, readPostures} from "../../test_support/nao_files";
import {chooseLanguage, kAllTexts, kLanguages, say, sayName, setLabels, setLanguage} from "./texts";

describe("texts", () => {
  it.each(Object.entries(kAllTexts))("%s is said in every language, with the same values", (_, row) => {
    expect(row).toHaveLength(kLanguages.length);
    const places = row.map((text) => (text.match(/\{\w+\}/g) ?? []).sort().join());
    for (const [i, text] of row.entries()) {
      expect(text.trim()).not.toBe("");
      expect(places[i]).toBe(places[0]);
    }
  });

  it("are chosen by the phone's languages", () => {
    expect(chooseLanguage(["fr-FR", "pt-BR", "en"])).toBe("pt");
    expect(chooseLanguage(["de-AT"])).toBe("de");
    expect(chooseLanguage(["ja"])).toBe("en");
  });

  it("fill values in", () => {
    setLanguage("en");
    expect(say("control.other", {name: "Ana"})).toBe("Ana drives");
  });

  it("call all that the robot does and each of its joint groups as the robot says, in every language", () => {
    const folder = new URL("../../../../data/robots/nao", import.meta.url).pathname;
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
    setLanguage("pt");
    expect(sayName("posture", "Crouch")).toBe("Agachar");
    setLanguage("en");
    setLabels([]);
  });

  it("show a name without translation as it is", () => {
    expect(sayName("posture", "Crouch")).toBe("Crouch");
    expect(sayName("action", "moon-walk")).toBe("moon walk");
  });
});
