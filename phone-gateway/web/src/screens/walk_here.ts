/** Tap to walk: a tap marks a spot on the ground, a second one on "Walk here" sends the robot there. */
import {walkTo} from "../controls/ground_target";
import {Offer} from "../controls/offer";
import type {UseCaseValue} from "../protocol/codec";
import type {Stage} from "../robot/stage";
import {say} from "../text/texts";

/** A spot farther away than this is not seen well enough to be meant, m. */
const kMaxDistance = 3;
/** Taps closer to the robot than this are not walk goals, m. */
const kMinDistance = 0.15;

export class WalkHere {
  private spot: {x: number; y: number} | null = null;
  private readonly offer = new Offer("walk-here", say("drive.walkHere"),
      [{name: "walk", label: say("drive.walkHere"), act: () => this.chosen()}], () => this.forget());
  readonly element = this.offer.element;

  constructor(private readonly stage: Stage, private readonly go: (pose: UseCaseValue<"moveTo">) => void) {}

  /** A tap on the stage, px from its top left. */
  tapped(x: number, y: number): void {
    const spot = this.stage.groundAt(x, y);
    const robot = this.stage.orbit;
    const distance = spot ? Math.hypot(spot.x - robot.x, spot.y - robot.y) : Infinity;
    if (!spot || this.spot || distance > kMaxDistance || distance < kMinDistance) return this.clear();
    this.spot = spot;
    this.stage.floor.mark(spot, robot);
    this.stage.outdate();
    // As it is now: a button that sways with the view is hard to hit.
    this.offer.show(x, y, this.stage.canvas.clientWidth);
  }

  readonly clear = (): void => this.offer.clear();

  private forget(): void {
    this.spot = null;
    this.stage.floor.mark(null);
    this.stage.outdate();
  }

  private chosen(): void {
    const {spot, stage} = this;
    const pose = spot && walkTo(spot, stage.orbit, stage.heading);
    if (pose) this.go(pose);
  }
}
