// The tour: points at real controls that work meanwhile, is shown once, and again from the menu.
import assert from "node:assert/strict";
import {test} from "node:test";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

const {stack, openPhone} = setUp({hasPhone: false});

const open = async (options = {}, size = {width: 360, height: 640}) => {
  const phone = await openPhone(stack.url, size, {hasTour: true, ...options});
  await phone.sees("controller");
  await phone.page.locator(".tour-bubble").waitFor();
  return phone;
};
const isShown = (phone) => phone.page.locator(".tour").isVisible();

/** The ring lies around the control, and the words neither over it nor off the screen. */
async function pointsAt(phone, selector) {
  const boxes = await until(`the tour points at ${selector}`, async () => {
    const [ring, bubble, control] = await phone.page.evaluate((selector) =>
        [".tour-ring", ".tour-bubble", selector].map((one) => document.querySelector(one).getBoundingClientRect().toJSON()), selector);
    const isAround = ring.left <= Math.max(control.left, 4) && ring.top <= control.top && ring.bottom >= control.bottom;
    return control.width > 0 && isAround && ring.height < control.height + 30 && {bubble, control};
  });
  const {bubble, control} = boxes;
  const {width, height} = phone.page.viewportSize();
  assert.ok(bubble.left >= 0 && bubble.right <= width && bubble.top >= 0 && bubble.bottom <= height, `${selector}: words off the screen`);
  assert.ok(bubble.bottom <= control.top || bubble.top >= control.bottom, `${selector}: words over the control`);
}

const kControls = [".link", ".joystick-walk", ".strips", ".lock", ".teach-bar", ".stop"];

for (const size of [{width: 360, height: 640}, {width: 412, height: 915}, {width: 915, height: 412}]) {
  test(`points at six controls, one after the other, at ${size.width}x${size.height}`, async () => {
    const phone = await open({}, size);
    for (const control of kControls) {
      await pointsAt(phone, control);
      await phone.tap(".tour-bubble .primary");
    }
    assert.equal(await isShown(phone), false);
    assert.ok(await phone.page.locator(".joystick-walk").isVisible(), "it ends where driving begins");
    assert.deepEqual(phone.errors, []);
    await phone.close();
  });
}

test("goes on by itself when the control is used, which does what it always does", async () => {
  const phone = await open();
  await phone.tap(".tour-bubble .primary");
  const pad = await phone.middleOf(".joystick-walk");
  await phone.fingers("touchStart", [{id: 1, x: pad.x, y: pad.y}]);
  await phone.fingers("touchMove", [{id: 1, x: pad.x, y: pad.y - 0.5 * pad.radius}]);
  await until("the robot walks", async () => (await phone.look("mode")) === "walking");
  await phone.fingers("touchEnd", []);
  await pointsAt(phone, ".strips");
  await phone.tap(".tour-bubble .primary");
  await phone.tap(".lock");
  await pointsAt(phone, ".teach-bar");
  assert.ok(await phone.look("state.isJointsMode"));
  await phone.close();
});

test("is shown once, skippable, in the phone's language, and again from the menu", async () => {
  const phone = await open({locale: "de-DE"});
  await phone.page.getByText("Überspringen").tap();
  assert.equal(await isShown(phone), false);
  await phone.page.reload();
  await phone.sees("controller");
  assert.equal(await isShown(phone), false);
  await phone.page.locator(".menu-button").tap();
  await phone.tap(".tour-again");
  await pointsAt(phone, ".link");
  await phone.close();
});
