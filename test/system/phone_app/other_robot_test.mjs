// Another robot than the NAO, driven from the app: its names, its shells, its camera, its walk.
import assert from "node:assert/strict";
import {test} from "node:test";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

const {stack, phone} = setUp({scene: "soccer", model: "t1"});

test("the app shows the robot's own groups, postures and actions", async () => {
  assert.equal(await phone.look("state.robot.model"), "t1");
  assert.deepEqual(await phone.look("state.robot.postures"), ["ready", "zero", "crouch"]);
  const actions = await phone.look("state.robot.actions");
  assert.ok(actions.includes("wave"), `no wave in ${actions}`);
  assert.ok(await phone.page.locator('.chip[data-name="crouch"]').count());
});

test("all of it is on the screen, from head to feet", async () => {
  await until("it stands ready", async () => (await phone.look("mode")) === "holding");
  const {width, height} = phone.page.viewportSize();
  await until("the eye has come to rest", async () => {
    const places = await phone.look("ballPlaces()");
    const parts = ["head", "left elbow", "right elbow", "left ankle", "right ankle"].map((name) => places[name]);
    const heights = parts.map(([, y]) => y);
    // It must not be a tiny spot in the distance either.
    return parts.every(([x, y]) => x > 0 && x < width && y > 0 && y < height) &&
        Math.max(...heights) - Math.min(...heights) > 0.2 * height;
  }, 10_000);
});

test("its camera's images arrive", async () => {
  await until("an image of the head's camera comes", async () => (await phone.look("state.image.camera")) === "head");
});

test("the joystick walks it ahead, and it stands again", async () => {
  await until("it stands ready", async () => (await phone.look("mode")) === "holding");
  const start = (await stack.truth()).torso;
  const pad = await phone.middleOf(".joystick-walk");
  await phone.fingers("touchStart", [{id: 1, x: pad.x, y: pad.y}]);
  await phone.fingers("touchMove", [{id: 1, x: pad.x, y: pad.y - 0.5 * pad.radius}]);
  await until("it has walked half a meter", async () => {
    const {torso} = await stack.truth();
    assert.ok(torso[2] > 0.5, "it fell");
    return torso[0] - start[0] > 0.5;
  });
  await phone.lift();
  await until("it stands", async () => (await phone.look("mode")) === "holding");
});

test("a posture's button bends its knees", async () => {
  await phone.page.locator('.chip[data-name="crouch"]').tap();
  await until("it crouches", async () => (await phone.look("state.state.posture")) === "crouch");
});

test("the phone has no complaint", () => {
  assert.deepEqual(phone.errors, []);
});
