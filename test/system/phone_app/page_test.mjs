// The page itself: it is accessible and small, logs nothing, and each screen is laid out.
import assert from "node:assert/strict";
import {test} from "node:test";
import {violations} from "./accessibility.mjs";
import {faultsOfLayout} from "./layout.mjs";
import {Air} from "./air.mjs";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

/** All that a phone fetches on its first visit, as it goes over the air. */
const kMaxBytes = 400_000;

const {stack, openPhone} = setUp({scene: "soccer", hasPhone: false});

/** When the robot was first drawn, ms since the link was followed. */
const robotShown = (phone) => until("the robot is drawn", () => phone.page.evaluate(
    () => performance.getEntriesByName("robot-shown")[0]?.startTime));

test("a first visit fetches less than 400 kB, and nothing twice", async (t) => {
  const air = new Air(stack.httpPort);
  const port = await air.start();
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
  air.stop();
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

for (const size of [{width: 320, height: 568}, {width: 360, height: 640}, {width: 412, height: 915}, {width: 915, height: 412},
                    {width: 1280, height: 800}]) {
  test(`every screen is accessible and laid out, at ${size.width}x${size.height}`, async () => {
    const phone = await openPhone(stack.url.replace(stack.token, "wrong"), size);
    const isWell = async () => assert.deepEqual([...await violations(phone), ...await faultsOfLayout(phone)], []);
    await phone.page.locator(".problem").waitFor();
    await isWell();
    await phone.page.locator('[name="token"]').fill(stack.token);
    await phone.tap('.card [type="submit"]');
    await phone.sees("controller");
    await until("the postures are drawn", () => phone.page.locator(".postures canvas").count());
    await isWell();
    await phone.tap(".more-button");
    await isWell();
    await phone.tap(".more-button");
    await phone.tap(".joints-button");
    await phone.page.locator('[data-name="left hip"]').tap();
    await isWell();
    await phone.tap(".teach-add");
    await isWell();
    await phone.tap(".teach-open");
    await phone.page.locator(".pose-title").tap();
    await isWell();
    await phone.page.locator(".motions header .round").tap();
    await phone.page.locator(".menu-button").tap();
    await phone.page.locator(".menu[open]").waitFor();
    await isWell();
    // A wrong code answers with a close that the console reports; nothing else may be there.
    assert.deepEqual(phone.errors, []);
    await phone.close();
  });
}
