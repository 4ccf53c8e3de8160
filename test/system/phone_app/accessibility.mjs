// The accessibility rules of axe-core, on what a phone shows.
import {readFileSync} from "node:fs";
import {requireFromApp} from "./phone.mjs";
import {kWebDir} from "./set_up.mjs";

/** Violations of the rules, one line each. */
export async function violations(phone) {
  if (!(await phone.page.evaluate("Boolean(window.axe)"))) {
    await phone.page.evaluate(readFileSync(requireFromApp(kWebDir).resolve("axe-core/axe.min.js"), "utf8"));
  }
  // Of the other results, what passed, it tells one element each, and nothing of them leaves the page.
  const violations = await phone.page.evaluate('axe.run({resultTypes: ["violations"]}).then(({violations}) => violations)');
  return violations.flatMap(({id, nodes}) => nodes.map((node) => `${id}: ${node.html} ${node.failureSummary}`));
}
