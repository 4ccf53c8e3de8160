// One tap on "Score": the robot sees the ball in rendered images, walks to it, aims and kicks it into the goal.
import assert from "node:assert/strict";
import {access} from "node:fs/promises";
import {join} from "node:path";
import {before, test} from "node:test";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

// Simulated seconds per second, of each tap: rendering, seeing and a browser share the machine's cores, perhaps with other
// programs. A person taps again, too, when the robot has given up, or has kicked past the goal.
const kPaces = [0.25, 0.125, 0.125];
/** Timeout of one tap: a quarter of a minute of walking, looking and kicking, at these rates and on a busy machine. */
const kScoreMs = 240_000;
// Line of the opponent's goal, and half its width, m: data/scenes/soccer.yaml.
const kGoalLine = 4.5;
const kHalfGoal = 0.75;
// play_state_t's BEHAVIOR_*.
const kNone = 0;
const kScore = 4;

const hasVision = await access(join(process.env.NAO_BIN_DIR ?? "", "nao-vision")).then(() => true, () => false);
const {stack, openPhone} = setUp({scene: null, hasPhone: false});

const ball = async () => JSON.parse(await stack.nao("world", "show", "--json")).position_ball_in_world;

const behavior = (phone) => phone.look("state.playState.behavior");

before(async () => {
  if (hasVision) await stack.start({scene: "soccer", plays: true});
});

test("a tap on Score puts the ball into the goal", {skip: !hasVision && "nao-vision was not built"}, async (t) => {
  const phone = await openPhone();
  t.after(() => phone.close());
  await phone.sees("controller");
  const phases = new Set();
  let place = null;
  for (const pace of kPaces) {
    await stack.nao("world", "set-pace", String(pace));
    await stack.nao("world", "place-ball", "1.2", "0.25");
    await until("nothing is played", async () => (await behavior(phone)) === kNone);
    await phone.choose('.play-strip [data-name="score"]');
    await until("the robot plays", async () => (await behavior(phone)) === kScore).catch(async (error) => {
      throw new Error(`${error.message}; the phone shows: ${await phone.page.locator("body").innerText()}\n${stack.logs}`);
    });
    place = await until("the ball is in the goal, or the robot has given up", async () => {
      phases.add(await phone.page.locator(".activity").textContent());
      const [x, y] = await ball();
      if (x > kGoalLine && Math.abs(y) < kHalfGoal) return [x, y];
      return (await behavior(phone)) === kNone && null;
    }, kScoreMs);
    if (place) break;
  }
  assert.ok(place, `no goal; ${[...phases].join(" | ")}\n${stack.logs}`);
  t.diagnostic(`ball at ${place.map((part) => part.toFixed(2))}; ${[...phases].join(" | ")}`);
  assert.ok([...phases].some((words) => words.includes("kicks")), `no kick was told: ${[...phases]}`);
  assert.deepEqual(phone.errors, []);
});
