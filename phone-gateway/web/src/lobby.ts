/** Which of several robots the person drives or watches: the list of robots, and changes to another one. */
import type {Commander} from "./commander";
import type {Messages} from "./messages";
import type {Actions} from "./screens/actions";
import {LobbyScreen} from "./screens/lobby_screen";
import type {Store} from "./store";
import {say} from "./text/texts";

export class Lobby {
  readonly screen: LobbyScreen;
  /** Name of the robot that the person has asked for last. */
  private chosen = "";

  constructor(private readonly store: Store, private readonly commander: Commander, private readonly messages: Messages,
              private readonly act: Actions) {
    this.screen = new LobbyScreen(store, this, act);
    // Also when the operator has assigned a robot to this phone.
    store.watch((state) => state.control?.isMine ?? false, (isMine) => {
      if (isMine) this.close();
    });
  }

  /** Shows the robots. The watched one is kept until another one is chosen. */
  open(): void {
    this.act.letGo();
    this.store.set({isChoosingRobot: true});
    this.act.subscribe();
  }

  /** The watched robot is another one, by choice or by the operator: nothing of the one before goes on. */
  robotChanged(): void {
    // Its limp limbs belong to the robot before.
    this.store.set({relaxedGroups: []});
    this.act.letGo();
    const {robot} = this.store.get();
    if (robot && robot.name !== this.chosen) this.messages.show("info", say("lobby.changed", {name: robot.name}));
  }

  /** Drives a robot, or only watches it. */
  async choose(robot: string, isDriver: boolean): Promise<void> {
    this.chosen = robot;
    if (await (isDriver ? this.commander.takeControl(robot) : this.commander.watchRobot(robot))) this.close();
  }

  private close(): void {
    if (!this.store.get().isChoosingRobot) return;
    this.store.set({isChoosingRobot: false});
    this.act.subscribe();
  }
}
