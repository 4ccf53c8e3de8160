// The app in a phone's browser against the real programs: a person's actions appear in the simulated world, and its
// events on the phone. NAO_BIN_DIR and NAO_WEB_SOURCE_DIR say where the programs and the app's package.json are.
import assert from "node:assert/strict";
import {test} from "node:test";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

const kDegree = Math.PI / 180;

const {stack, openPhone} = setUp({scene: "soccer", hasPhone: false});
let phone;

/** Asks the world until it meets the condition, for some seconds of simulated time. @return the last truth. */
async function untilWorld(what, isSo, simulatedSeconds) {
  const begin = (await stack.truth()).time;
  for (;;) {
    const truth = await stack.truth();
    if (isSo(truth)) return truth;
    assert.ok(truth.time - begin < simulatedSeconds,
              `${simulatedSeconds} simulated seconds passed and not yet: ${what}; ` +
              `torso ${truth.torso.map((one) => one.toFixed(3))}\n${stack.logs}`);
  }
}

/** Largest difference between the angles that the phone shows and the true ones, rad. */
async function worstJoint() {
  const [truth, shown] = await Promise.all([stack.truth(), phone.look("jointAngles()")]);
  let worst = {name: "", difference: 0};
  for (const [name, angle] of Object.entries(truth.angles)) {
    const difference = Math.abs(shown[name] - angle);
    if (!(difference <= worst.difference)) worst = {name, difference};
  }
  return worst;
}

test("a link with the token opens the controller", async () => {
  phone = await openPhone();
  await phone.sees("controller");
  assert.equal(await phone.page.evaluate("location.hash"), "", "the token is still in sight");
  await until("an image is drawn", async () => (await phone.look("numImages")) > 0);
});

test("Crouch lowers the torso to 0.229 m within 5 s, and the phone shows the same robot", async () => {
  const before = await phone.look("state.image.jpeg.join()");
  await phone.tap('[data-name="Crouch"]');
  await untilWorld("the torso is at 0.229 m", ({torso}) => Math.abs(torso[2] - 0.229) < 0.015, 5);
  await until("the phone shows the true angles within 1 degree",
              async () => (await worstJoint()).difference < 1 * kDegree);
  const height = (await phone.look("torsoPosition()"))[2];
  assert.ok(Math.abs(height - 0.229) < 0.02, `the phone shows the torso at ${height} m`);
  assert.notEqual(await phone.look("state.image.jpeg.join()"), before, "the image has not changed");
});

test("nothing went wrong on the page", () => {
  assert.deepEqual(phone.errors, []);
});
