/** Teaching motions: joins the draft, the robot's host, the hands on the robot and the two views. */
import type {Commander} from "../commander";
import type {Messages} from "../messages";
import type {JointChange} from "../controls/joint_change";
import type {RobotView} from "../robot/robot_view";
import type {Grip} from "../robot/stage_gestures";
import {MotionSheet} from "../screens/motion_sheet";
import {TeachBar} from "../screens/teach_bar";
import {poseOf} from "../store";
import type {Store} from "../store";
import {say} from "../text/texts";
import {DraftEditor} from "./draft_editor";
import {HandGuide} from "./hand_guide";
import {jointsOfChange, jointsOfGroups, limbOf} from "./limbs";
import {addPose, changeKeyframe, kMaxKeyframes, repair, touch} from "./motion_draft";
import type {Pose} from "./motion_draft";
import {MotionHost} from "./motion_host";

export class Teach {
  readonly bar: TeachBar;
  readonly sheet: MotionSheet;
  private readonly editor: DraftEditor;
  private readonly host: MotionHost;
  private readonly guide: HandGuide;
  private wasExplained = false;

  /** @param stop  ends every motion of the robot. */
  constructor(private readonly store: Store, commander: Commander, private readonly messages: Messages,
              private readonly view: RobotView, storage: Storage | null, readonly stop: () => void) {
    this.editor = new DraftEditor(store, storage);
    this.guide = new HandGuide(store, commander);
    this.host = new MotionHost(store, commander, () => this.guide.stiffen());
    this.bar = new TeachBar(store, this);
    this.sheet = new MotionSheet(store, this.editor, this.host, this);
  }

  /** Tells once how it goes, to a person who has not taught anything yet. */
  explain(): void {
    if (this.wasExplained || this.editor.draft.keyframes.length > 0) return;
    this.wasExplained = true;
    this.messages.show("info", say("teach.hint"));
  }

  /** A joint change is about to be sent: its joints belong to the motion. */
  turned({group = "", bothSides = false}: JointChange): void {
    const {robot} = this.store.get();
    if (robot) this.noteJoints(jointsOfChange(robot.jointGroups, robot.joints, group, bothSides));
  }

  /** Makes the limb of a joint group limp, or stiff again. */
  async relax(group: string): Promise<void> {
    const {robot} = this.store.get();
    const {tree} = this.view;
    if (!robot || !tree) return;
    const limb = limbOf(tree.urdf, robot.jointGroups, group);
    // The chosen one first: it says whether the limb is limp.
    const groups = [group, ...limb.filter((name) => name !== group)];
    this.noteJoints(jointsOfGroups(robot.jointGroups, groups));
    await this.guide.toggle(groups);
    if (!this.store.get().relaxedGroups.includes(group)) return;
    this.messages.show("info", say(robot.isSimulated ? "teach.relaxedSimulated" : "teach.relaxed"));
  }

  /** Ends hand guiding: all limbs are stiff again. */
  async leave(): Promise<void> {
    this.guide.endDrag();
    await this.guide.stiffen();
  }

  /** Stop was pressed: what is being checked is not played. */
  cancel(): void {
    this.endDrag();
    this.host.cancel();
  }

  /** Pulls no limb any more. */
  endDrag(): void {
    this.guide.endDrag();
  }

  /** A finger on a ball of a relaxed limb of a simulated robot pulls it; null for any other.
   * @param x,y  px from the canvas's top left. */
  grab(x: number, y: number): Grip | null {
    const {robot, isJointsMode, relaxedGroups} = this.store.get();
    if (!isJointsMode || !robot?.isSimulated || relaxedGroups.length === 0) return null;
    const held = this.view.holdBall(x, y, relaxedGroups);
    if (!held) return null;
    return {
      move: (toX, toY) => {
        const target = held.drag.targetAt(toX, toY);
        if (target) this.guide.drag({link: held.link, targetX: target.x, targetY: target.y, targetZ: target.z});
      },
      end: () => this.guide.endDrag(),
    };
  }

  /** Plays a draft, or shows why it is not safe. */
  play(draft = this.editor.draft): void {
    this.sheet.element.close();
    void this.host.play(draft);
  }

  /** Gives a keyframe the pose that the robot is in. */
  capture(index: number): void {
    this.withPose((pose) => this.editor.change(changeKeyframe(this.editor.draft, index, {pose})));
  }

  addPose(): void {
    this.withPose((pose) => {
      const {draft} = this.editor;
      const longer = addPose(draft, pose, this.store.get().robot?.joints ?? []);
      if (longer === draft) this.messages.show("bad", say("teach.full", {number: kMaxKeyframes}));
      this.editor.change(longer);
    });
  }

  /** The draft becomes the repaired motion of its fault. */
  repair(): void {
    const {draft, motionFault} = this.store.get();
    if (!motionFault?.repaired) return;
    this.editor.change(repair(draft, motionFault.repaired));
    this.messages.show("good", say("teach.repaired"));
  }

  private noteJoints(joints: readonly string[]): void {
    this.withPose((pose) => this.editor.note(touch(this.editor.draft, joints, pose)));
  }

  private withPose(act: (pose: Pose) => void): void {
    const {robot, state} = this.store.get();
    if (robot && state) act(poseOf(robot.joints, state));
  }
}
