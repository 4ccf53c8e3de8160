/** Moves limbs by hand: makes them limp or stiff, and pulls them in a simulation. */
import type {Commander} from "../commander";
import {Repeater} from "../controls/repeater";
import type {UseCaseValue} from "../protocol/codec";
import type {Store} from "../store";

/** A pull ends 0.2 s after the last request, and wants one every 0.1 s. */
export const kDragPeriodMs = 50;
/** nao-motion changes a stiffness within 0.5 s; a limb is not limp before. */
export const kStiffnessMs = 600;

export class HandGuide {
  private readonly repeater = new Repeater(() => this.send(), kDragPeriodMs);
  private pull: UseCaseValue<"drag"> | null = null;

  constructor(private readonly store: Store, private readonly commander: Commander) {}

  /** Makes the groups of a limb limp, or stiff if the first of them is limp. */
  async toggle(groups: readonly string[]): Promise<void> {
    const isLimp = groups[0] !== undefined && this.store.get().relaxedGroups.includes(groups[0]);
    await this.setStiffness(groups, isLimp ? 1 : 0);
  }

  /** Makes all limbs stiff that were relaxed. */
  async stiffen(): Promise<void> {
    await this.setStiffness(this.store.get().relaxedGroups, 1);
  }

  /** Pulls a link of a simulated robot until endDrag(). */
  drag(pull: UseCaseValue<"drag">): void {
    this.pull = pull;
    this.repeater.start();
  }

  endDrag(): void {
    this.repeater.stop();
    this.pull = null;
  }

  private send(): void {
    if (this.pull) this.commander.stream({case: "drag", value: this.pull});
  }

  /** Commands one group after the other, and ends when all have their stiffness. */
  private async setStiffness(groups: readonly string[], stiffness: number): Promise<void> {
    let isChanging = false;
    for (const group of groups) {
      // Refused for one joint of a limb: told once, and the others are left as they are.
      if (!(await this.commander.command({case: "changeJoints", value: {group, stiffness}}))) break;
      const others = this.store.get().relaxedGroups.filter((one) => one !== group);
      this.store.set({relaxedGroups: stiffness === 0 ? [...others, group] : others});
      isChanging = true;
    }
    if (isChanging) await new Promise((resolve) => setTimeout(resolve, kStiffnessMs));
  }
}
