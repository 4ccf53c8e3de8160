/** The app's icons as images: phones that put a page on their home screen want PNG, in these sizes. */
import {readFileSync} from "node:fs";
import {createRequire} from "node:module";
import {initWasm, Resvg} from "@resvg/resvg-wasm";
import type {Plugin} from "vite";

/** Name of each image, the drawing in public/ that it shows, and its width and height, px. */
const kImages = [
  {name: "icon-192.png", drawing: "icon.svg", size: 192},
  {name: "icon-512.png", drawing: "icon.svg", size: 512},
  {name: "icon-maskable-512.png", drawing: "icon-maskable.svg", size: 512},
  // iOS rounds the corners itself.
  {name: "apple-touch-icon.png", drawing: "icon-maskable.svg", size: 180},
] as const;

export function iconImages(): Plugin {
  return {
    name: "icon-images",
    // Once: with the page that public/ belongs to.
    apply: ({publicDir}, {command}) => command === "build" && publicDir !== false,
    async generateBundle() {
      await initWasm(readFileSync(createRequire(import.meta.url).resolve("@resvg/resvg-wasm/index_bg.wasm")));
      for (const {name, drawing, size} of kImages) {
        const svg = readFileSync(new URL(`public/${drawing}`, import.meta.url));
        const source = new Resvg(svg, {fitTo: {mode: "width", value: size}}).render().asPng();
        this.emitFile({type: "asset", fileName: name, source});
      }
    },
  };
}
