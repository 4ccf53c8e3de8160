// Phones that lose the link, are hidden, or share one robot.
import assert from "node:assert/strict";
import {test} from "node:test";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

const {stack, openPhone} = setUp({hasPhone: false});
let ana;
let ben;

const driverText = (phone) => phone.page.locator(".driver-name").textContent();

test("a wrong code is refused in words, and the whole address pasted in its place connects", async () => {
  ana = await openPhone(stack.url.replace(stack.token, "wrong"));
  await ana.page.getByText("The pairing code is not the right one.").waitFor();
  await ana.page.locator('[name="token"]').fill(stack.url);
  await ana.page.locator('[name="client-name"]').fill("Ana");
  await ana.page.locator('.card [type="submit"]').tap();
  await ana.sees("controller");
});

test("the first to touch a control drives; the second phone sees who, and may ask", async () => {
  await ana.tap('[data-name="Stand"]');
  await until("Ana drives", async () => (await driverText(ana)) === "You drive");
  ben = await openPhone();
  await ben.sees("controller");
  await until("Ben sees it", async () => (await driverText(ben)) === "Ana drives");
  // A command of the second phone moves nothing, and names the driver.
  await ben.tap('[data-name="Crouch"]');
  await ben.page.locator(".message", {hasText: "Ana drives"}).waitFor();
  // Ana is active: she is asked, and hands over by name. A third one sees who is next.
  await ana.tap('[data-name="Stand"]');
  await ben.tap(".driver-button");
  await ben.page.locator(".message", {hasText: "Ana sees that you would like to drive."}).waitFor();
  const eva = await openPhone();
  await eva.sees("controller");
  const name = await ben.look("state.clientName");
  await until("Eva sees who is next", async () => (await driverText(eva)) === `Ana drives, ${name} is next`);
  await ana.page.locator(".cause", {hasText: `${name} would like to drive.`}).waitFor();
  await ana.page.getByText(`Hand over to ${name}`).tap();
  await until("Ben drives", async () => (await driverText(ben)) === "You drive");
  await until("Ana sees it", async () => (await driverText(ana)) === `${name} drives`);
  await eva.close();
});

test("control is granted when the driver has given no command for 10 s", async () => {
  await until("Ana drives", async () => {
    if ((await driverText(ana)) === "You drive") return true;
    await ana.page.waitForTimeout(1000);
    // Asks, then waits no longer, and asks again.
    await ana.tap(".driver-button");
    return false;
  });
  await until("Ben sees it", async () => (await driverText(ben)) === "Ana drives");
  await ana.tap(".driver-button");
  await ben.tap('[data-name="StandInit"]');
  await until("Ben drives again", async () => (await driverText(ben)) === "You drive");
});

test("the driver hands over, and the other takes control by touching a joystick", async () => {
  await ben.tap(".driver-button");
  await until("no client drives", async () => (await ana.look("state.control.driverId")) === 0);
  await ana.tap('[data-name="StandInit"]');
  await until("Ana drives again", async () => (await driverText(ana)) === "You drive");
});

test("anybody may stop the robot, spectators too", async () => {
  await until("old messages are gone", async () => (await ben.page.locator(".message.bad").count()) === 0);
  await ben.tap(".stop");
  assert.equal(await ben.page.locator(".message.bad").count(), 0);
});

test("a killed gateway is told over the last view, with a button, and the app comes back by itself with it", async () => {
  await stack.end("nao-phone-gateway", "SIGKILL");
  await ana.page.locator('.cause [data-remedy="retry"]').waitFor();
  assert.ok(await ana.page.locator(".stage").isVisible(), "the view has gone");
  assert.equal(await ana.page.locator(".driver-button:visible").count(), 0, "control is handed over without a link");
  await stack.startGateway();
  await ana.page.locator(".cause").waitFor({state: "hidden"});
  await until("images go on", async () => {
    const count = await ana.look("numImages");
    return until("another", async () => (await ana.look("numImages")) > count, 2000);
  });
});

test("the app opens without the robot too, says that it is away, and drives as soon as it is back", async () => {
  const eva = await openPhone(stack.url, undefined, {locale: "de-DE"});
  for (const phone of [ana, eva]) {
    await phone.sees("controller");
    await until("the copy is kept", () => phone.page.evaluate(async () => {
      const loaded = performance.getEntriesByType("resource").map(({name}) => name).filter((name) => name.includes("/assets/"));
      return (await Promise.all(loaded.map((name) => caches.match(name)))).every(Boolean);
    }));
    await phone.touch.send("Network.setCacheDisabled", {cacheDisabled: true});
  }
  await stack.end("nao-phone-gateway", "SIGKILL");
  for (const [phone, words] of [[ana, "Nothing answers at this address."], [eva, "Unter dieser Adresse antwortet nichts."]]) {
    await phone.page.reload();
    await phone.sees("connection");
    await phone.page.getByText(words).first().waitFor();
  }
  await stack.startGateway();
  await ana.sees("controller");
  await eva.close();
});

test("a gateway that hangs is told at once, and given up after 5 s of silence", async () => {
  const gateway = stack.program("nao-phone-gateway");
  gateway.child.kill("SIGSTOP");
  const begin = Date.now();
  await ana.page.locator(".mode", {hasText: "Nothing new for"}).waitFor();
  assert.equal(await ana.page.locator(".stale .controller-screen").count(), 1, "the sticks are not locked");
  assert.equal(await ana.look("state.phase"), "connected", "told too late");
  // The controller stays while the app tries again.
  await ana.page.locator(".cause", {hasText: "The robot has gone quiet."}).waitFor();
  assert.ok(Date.now() - begin > 4000, "given up too early");
  gateway.child.kill("SIGCONT");
  await ana.sees("controller");
});
