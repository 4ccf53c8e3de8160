/** Builds the app and the pages of an exhibition. Each page is a bundle of its own: what they share stays one file of the app,
 * which a phone fetches at once. Usage: vite-node build.ts --outDir FOLDER [--logLevel LEVEL] */
import {parseArgs} from "node:util";
import {build} from "vite";
import type {LogLevel} from "vite";

const {values} = parseArgs({options: {outDir: {type: "string", default: "dist"}, logLevel: {type: "string", default: "info"}}});

// vite-node says "development".
process.env["NODE_ENV"] = "production";

for (const page of ["index", "screen", "operator"]) {
  await build({
    logLevel: values.logLevel as LogLevel,
    // The first one empties the folder, and copies public/.
    publicDir: page === "index" ? "public" : false,
    build: {outDir: values.outDir, emptyOutDir: page === "index", rollupOptions: {input: `${page}.html`}},
  });
}
