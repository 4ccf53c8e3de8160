// The page itself: it is accessible and small, logs nothing, and each screen is laid out.
import assert from "node:assert/strict";
import {test} from "node:test";
import {Air} from "./air.mjs";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

/** All that a phone fetches on its first visit, as it goes over the air. */
const kMaxBytes = 347_000;

const {stack, openPhone} = setUp({scene: "soccer", hasPhone: false});

/** When the robot was first drawn, ms since the link was followed. */
const robotShown = (phone) => until("the robot is drawn", () => phone.page.evaluate(
    () => performance.getEntriesByName("robot-shown")[0]?.startTime));

test("a first visit fetches less than 347 kB, and nothing twice", async (t) => {
  const air = new Air(stack.httpPort);
  const port = await air.start();
  t.after(() => air.stop());
  const phone = await openPhone(stack.url.replace(`:${stack.httpPort}`, `:${port}`));
  await robotShown(phone);
  t.diagnostic(`${air.paths.length} files, ${air.numBytes} bytes until the robot is seen`);
  assert.ok(air.paths.length > 20 && air.numBytes > 100_000, "the measurement saw too little");
  await phone.page.evaluate(async () => {
    await navigator.serviceWorker.ready;
  });
  t.diagnostic(`${air.paths.length} files, ${air.numBytes} bytes with the copy for when the robot is away`);
  assert.ok(air.numBytes <= kMaxBytes, `${air.numBytes} bytes: ${air.paths.join(" ")}`);
  const heavy = air.paths.filter((path) => /^.(assets|robots)/.test(path));
  assert.equal(new Set(heavy).size, heavy.length, `fetched twice: ${air.paths.join(" ")}`);
  await phone.close();
});

test("every icon of the manifest is an image of the size it says, as phones want for their home screen", async () => {
  const phone = await openPhone();
  const icons = await phone.page.evaluate(async () => {
    const manifest = await (await fetch("/manifest.webmanifest")).json();
    return Promise.all(manifest.icons.filter(({type}) => type === "image/png").map(async ({src, sizes, purpose}) => {
      const {width, height} = await createImageBitmap(await (await fetch(src)).blob());
      return {purpose, sizes, found: `${width}x${height}`};
    }));
  });
  for (const {sizes, found} of icons) assert.equal(found, sizes);
  for (const wanted of ["any 192x192", "any 512x512", "maskable 512x512"]) {
    assert.ok(icons.some(({purpose, found}) => `${purpose} ${found}` === wanted), `there is no icon ${wanted}`);
  }
  await phone.close();
});

test("a browser without 3D gets a message", async () => {
  const phone = await openPhone("about:blank");
  await phone.context.addInitScript(() => HTMLCanvasElement.prototype.getContext = () => null);
  await phone.page.goto(stack.url);
  await phone.page.getByText("This browser cannot draw in 3D.").waitFor();
  assert.deepEqual(phone.errors, []);
  await phone.close();
});

