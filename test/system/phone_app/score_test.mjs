// One tap on "Score": the robot sees the ball in rendered images, walks to it, aims and kicks it into the goal.
import assert from "node:assert/strict";
import {access} from "node:fs/promises";
import {join} from "node:path";
import {before, test} from "node:test";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

// Simulated time passes at this rate: rendering, seeing and a browser share the machine's cores.
const kPace = 0.25;
const kScoreMs = 600_000;
// Line of the opponent's goal, and half its width, m: scenes/soccer.yaml.
const kGoalLine = 4.5;
const kHalfGoal = 0.75;
// play_state_t's BEHAVIOR_SCORE.
const kScore = 4;

const hasVision = await access(join(process.env.NAO_BIN_DIR ?? "", "nao-vision")).then(() => true, () => false);
const {stack, openPhone} = setUp({scene: null, hasPhone: false});

const ball = async () => JSON.parse(await stack.nao("world", "show", "--json")).position_ball_in_world;

before(async () => {
  if (hasVision) await stack.start({scene: "soccer", plays: true, pace: kPace});
});

test("a tap on Score puts the ball into the goal", {skip: !hasVision && "nao-vision was not built"}, async (t) => {
  const phone = await openPhone();
  t.after(() => phone.close());
  await phone.sees("controller");
  await stack.nao("world", "place-ball", "1.2", "0.25");
  await phone.tap('.play-strip [data-name="score"]');
  await until("the robot plays", async () => (await phone.look("state.playState.behavior")) === kScore);
  const phases = new Set();
  const place = await until("the ball is in the goal", async () => {
    phases.add(await phone.page.locator(".activity").textContent());
    const [x, y] = await ball();
    return x > kGoalLine && Math.abs(y) < kHalfGoal && [x, y];
  }, kScoreMs).catch((error) => {
    throw new Error(`${error.message}; ${[...phases].join(" | ")}\n${stack.logs}`);
  });
  t.diagnostic(`ball at ${place.map((part) => part.toFixed(2))}; ${[...phases].join(" | ")}`);
  assert.ok([...phases].some((words) => words.includes("kicks")), `no kick was told: ${[...phases]}`);
  assert.deepEqual(phone.errors, []);
});
