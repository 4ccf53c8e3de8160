import {defineConfig} from "vitest/config";
import {iconImages} from "./icon_images";

// `npm run dev` serves the app from here and takes everything else from a running gateway.
const gateway = process.env["NAO_GATEWAY"] ?? "http://127.0.0.1:8080";

export default defineConfig({
  base: "./",
  plugins: [iconImages()],
  build: {
    target: "es2022",
    // One chunk: on a LAN a second round trip costs more than the bytes.
    chunkSizeWarningLimit: 1200,
    modulePreload: false,
  },
  server: {
    // As a number: a system without /etc/hosts knows no "localhost".
    host: "127.0.0.1",
    proxy: {
      "/ws": {target: gateway, ws: true, changeOrigin: true},
      "/robots": {target: gateway, changeOrigin: true},
      "/scenes": {target: gateway, changeOrigin: true},
    },
  },
  test: {include: ["src/**/*.test.ts"], environment: "node", setupFiles: "test_support/web_crypto.ts"},
});
