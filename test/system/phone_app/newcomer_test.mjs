// A newcomer has scanned the address: how many touches, or keys, until the robot walks, kicks and bends a joint. How long it
// takes is told, not asserted: the machine may be busy.
import assert from "node:assert/strict";
import {test} from "node:test";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

const kMoved = 0.05;
const {stack, openPhone} = setUp({hasPhone: false});

/** Does what a person finds on the screen, and counts. */
class Newcomer {
  count = 0;

  constructor(phone) {
    this.phone = phone;
  }

  async touch(selector) {
    this.count++;
    await this.phone.tap(selector);
  }

  /** Pushes a pad up, and to the right by a fraction of its radius, until something is so. */
  async push(selector, right, what, isSo) {
    this.count++;
    const {x, y, radius} = await this.phone.middleOf(selector);
    await this.phone.fingers("touchStart", [{id: 1, x, y}]);
    await this.phone.fingers("touchMove", [{id: 1, x: x + right * radius, y: y - 0.6 * radius}]);
    await until(what, isSo).finally(() => this.phone.lift());
  }

  async press(key) {
    this.count++;
    await this.phone.page.keyboard.press(key);
  }

  async hold(key, what, isSo) {
    this.count++;
    await this.phone.page.keyboard.down(key);
    await until(what, isSo).finally(() => this.phone.page.keyboard.up(key));
  }

  /** @return how many since the last call. */
  take() {
    const {count} = this;
    this.count = 0;
    return count;
  }
}

const walks = (phone) => async () => (await phone.look("mode")) === "walking";
const stands = (phone) => until("the robot stands", async () => (await phone.look("mode")) === "holding");
const kicks = (phone) => until("the robot kicks", async () => (await phone.look("state.state.activity?.name ?? ''")).startsWith("kick"));
const isBent = async (phone, joint) => {
  const before = (await phone.look("jointAngles()"))[joint];
  return async () => Math.abs((await phone.look("jointAngles()"))[joint] - before) > kMoved;
};

test("by touch: walking in 3, a kick in 3 more, a bent joint in 4", async (t) => {
  const begin = Date.now();
  const phone = await openPhone(stack.url, undefined, {isNewcomer: true});
  const newcomer = new Newcomer(phone);
  await phone.sees("controller");
  await phone.page.locator(".hint").waitFor();  // Tells how to walk, as soon as the robot is known.
  await newcomer.push(".joystick-walk", 0, "the robot walks", walks(phone));
  t.diagnostic(`walks ${((Date.now() - begin) / 1000).toFixed(1)} s after the address was opened`);
  assert.ok(newcomer.take() <= 3);
  assert.ok(await phone.page.locator(".hint").isHidden(), "the hint stays");
  await stands(phone);
  await newcomer.touch(".more-button");
  await newcomer.touch('[data-name="kick-left"]');
  await kicks(phone);
  assert.ok(newcomer.take() <= 3);
  await stands(phone);
  // A touch on the arm itself: its ball is there, though not shown yet.
  const [x, y] = (await phone.rests())["right elbow"];
  newcomer.count++;
  await phone.page.touchscreen.tap(x, y);
  await until("joints mode, with the arm chosen", async () => (await phone.look("state.isJointsMode")) && (await phone.look("state.selectedGroup")) !== "");
  const group = await phone.look("state.selectedGroup");
  const joint = (await phone.look("state.robot.jointGroups")).find(({name}) => name === group);
  const bent = await isBent(phone, joint.pitchJoint || joint.yawJoint);
  await newcomer.push(".joystick-joint", 0.6, `${group} is bent`, bent);
  assert.ok(newcomer.take() <= 4);
  assert.deepEqual(phone.errors, []);
  await phone.close();
});

test("by keys: the same", async (t) => {
  const begin = Date.now();
  const phone = await openPhone(stack.url, {width: 1280, height: 800}, {isNewcomer: true, isMobile: false, hasTouch: false});
  const newcomer = new Newcomer(phone);
  await phone.sees("controller");
  await phone.page.locator(".hint", {hasText: "W A S D"}).waitFor();
  await newcomer.hold("w", "the robot walks", walks(phone));
  t.diagnostic(`walks ${((Date.now() - begin) / 1000).toFixed(1)} s after the address was opened`);
  assert.ok(newcomer.take() <= 3);
  await stands(phone);
  await newcomer.press("1");
  await kicks(phone);
  assert.ok(newcomer.take() <= 3);
  await stands(phone);
  await newcomer.press("l");
  await newcomer.press(".");
  const group = await phone.look("state.selectedGroup");
  const joint = (await phone.look("state.robot.jointGroups")).find(({name}) => name === group);
  await newcomer.hold("w", `${group} is bent`, await isBent(phone, joint.pitchJoint));
  assert.ok(newcomer.take() <= 4);
  assert.deepEqual(phone.errors, []);
  await phone.close();
});
