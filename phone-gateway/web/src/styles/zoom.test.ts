import {readdirSync, readFileSync} from "node:fs";
import {expect, it} from "vitest";

it("no element lets two fingers zoom the page", () => {
  const folder = new URL(".", import.meta.url);
  const styles = readdirSync(folder).filter((name) => name.endsWith(".css")).map((name) => readFileSync(new URL(name, folder), "utf8"));
  expect(styles.join("")).toMatch(/^\* \{[^}]*touch-action: pan-x pan-y;/m);
  const values = styles.flatMap((text) => [...text.matchAll(/touch-action: ([^;]*);/g)].map((match) => match[1]));
  expect(new Set(values)).toEqual(new Set(["pan-x pan-y", "none"]));
});
