/** The app: which screen is seen, and how the parts hang together. */
import {Commander} from "./commander";
import {Connection} from "./connection";
import {sticksFromPad, driveFromKeys, stickFromKeys} from "./controls/keys";
import type {PadButton} from "./controls/keys";
import {Gamepads, listenToKeys} from "./controls/held_keys";
import {JointDriver} from "./controls/joint_driver";
import {ImageView} from "./controls/image_view";
import {driveFromSticks} from "./controls/stick";
import type {Drive} from "./controls/stick";
import {TiltSensor} from "./controls/tilt_sensor";
import {WalkSender} from "./controls/walk_sender";
import {exposeAutomation} from "./automation";
import {el} from "./dom";
import {Messages} from "./messages";
import {registerOfflineShell} from "./offline";
import {Mode} from "./protocol/generated/remote_pb";
import type {Connected} from "./protocol/generated/remote_pb";
import * as useCases from "./protocol/use_cases";
import {JointBalls} from "./robot/joint_balls";
import {loadFieldLines} from "./robot/load_field";
import {loadRobot} from "./robot/load_robot";
import {PoseMirror} from "./robot/pose_mirror";
import type {RobotTree} from "./robot/robot_tree";
import {kDriveView, kJointsView, Stage} from "./robot/stage";
import {attachGestures} from "./robot/stage_gestures";
import {ConnectionScreen} from "./screens/connection_screen";
import type {ConnectionForm} from "./screens/connection_screen";
import {ControllerScreen, linkInWords, linkQuality} from "./screens/controller_screen";
import {JointsPanel} from "./screens/joints_panel";
import {LoadingScreen} from "./screens/loading_screen";
import {MenuSheet} from "./screens/menu_sheet";
import {WalkHere} from "./screens/walk_here";
import {pageUrl, remember, saveSettings, tokenFromUrl} from "./settings";
import type {Settings} from "./settings";
import {storage} from "./storage";
import {Store} from "./store";
import {say} from "./text/texts";
import type {Language} from "./text/texts";
import {WebSocketTransport} from "./transport";

const kSoftware = "nao-phone-app 0.1.0";
/** The screen's rate: a joint is seen to move 8 ms sooner than at half the rate, for 20 kB/s. */
const kStateRateHz = 60;
const kImageRateHz = 15;

/** Felt: a tap that did something, the end of a joint's range, a refusal; ms on, off, on. */
const kTapPattern = 12;
const kLimitPattern = 30;
const kRefusalPattern = [25, 60, 25];

type ScreenName = "loading" | "connection" | "controller";

export class App {
  private readonly store = new Store();
  private readonly messages = new Messages(this.store);
  private readonly connection: Connection;
  private readonly commander: Commander;
  private readonly walk: WalkSender;
  private readonly stage: Stage;
  private readonly image = new ImageView(() => this.subscribe(), (yaw, pitch) =>
      this.turnCamera(yaw, pitch));
  private readonly jointDriver = new JointDriver((change) =>
      this.commander.stream(useCases.changeJoints(change)));
  private readonly tilt = new TiltSensor();
  private readonly gamepads = new Gamepads();
  private readonly walkHere: WalkHere;
  private readonly menu: MenuSheet;
  private readonly connectionScreen: ConnectionScreen;
  private readonly controllerScreen: ControllerScreen;
  private token = "";
  private robot: RobotTree | null = null;
  private robotPath = "";
  private mirror: PoseMirror | null = null;
  private balls: JointBalls | null = null;
  private isPadHeld = false;
  private isShown = false;

  constructor(private readonly root: HTMLElement, private settings: Settings) {
    this.connection = new Connection(
        new WebSocketTransport(new URL(location.href)), this.store, {
          connected: (connected) => void this.connected(connected),
          state: (state) => {
            this.mirror?.setTarget(state);
            this.stage.wake();
            this.store.set({state});
          },
          image: (image) => {
            this.store.set({image});
            this.image.show(image);
          },
          notice: (notice) => this.commander.notice(notice),
        });
    this.commander = new Commander(this.connection, this.store, this.messages);
    this.walk = new WalkSender((drive) => this.sendWalk(drive));
    const canvas = el("canvas", {class: "stage", role: "img", "aria-label": say("drive.stage")});
    root.append(canvas);
    this.stage = new Stage(canvas);
    this.stage.onFrame = (dt) => this.frame(dt);
    this.stage.orbit.isGliding = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    attachGestures(this.stage, (x, y) => this.tapped(x, y));
    this.jointDriver.isInFront = () => this.stage.orbit.isInFront;
    this.walkHere = new WalkHere(this.stage, ({x, y, theta}) =>
        void this.commander.command(useCases.moveTo(x, y, theta)));
    this.commander.onRefusal = () => vibrate(kRefusalPattern);
    this.connectionScreen = new ConnectionScreen(this.store, {
      connect: (form) => this.connect(form),
      cancel: () => this.connection.disconnect(),
      retryNow: () => this.connection.retryNow(),
    });
    const joints = new JointsPanel(this.store, this.jointDriver, {
      reset: () => this.goToPosture(this.store.get().robot?.readyPosture),
      select: (selectedGroup) => this.store.set({selectedGroup}),
      atLimit: () => vibrate(kLimitPattern),
    });
    this.controllerScreen = new ControllerScreen(this.store, this.commander, this.walk, this.image,
                                                 joints, this.tilt, this.walkHere.element, {
      openMenu: () => this.openMenu(),
      setJointsMode: (isJointsMode) => this.setJointsMode(isJointsMode),
      stop: () => this.stop(),
      explainLink: () => this.explainLink(),
    });
    this.controllerScreen.setSwapped(settings.isSwapped);
    this.menu = new MenuSheet(settings.isSwapped, {
      setTilt: (isOn) => this.setTilt(isOn),
      setSwapped: (isSwapped) => {
        this.keep({isSwapped});
        this.controllerScreen.setSwapped(isSwapped);
      },
      setLanguage: (language) => this.setLanguage(language),
      leave: () => this.leave(),
    });
    root.append(new LoadingScreen(this.store, () => void this.prepareRobot()).element,
                this.connectionScreen.element, this.controllerScreen.element, this.menu.element);
    this.controllerScreen.observeFreeArea((area) => this.stage.setFreeArea(area));
  }

  start(): void {
    exposeAutomation(this.store, this.stage, this.image, () => this.robot, () => this.balls);
    listenToKeys(() => this.root.dataset["screen"] === "controller", {
      heldChanged: (held, isSlow) => this.keysChanged(held, isSlow),
      pressed: (button) => this.pressed(button),
    });
    this.store.watch((state) => state.isJointsMode, (isOn) => {
      this.balls?.show(isOn);
      this.stage.outdate();
    });
    // Another motion replaces the walk to the marked spot.
    this.store.watch((state) => state.state?.activity?.name ?? "", (activity) => {
      if (activity) this.walkHere.clear();
    });
    this.store.watch((state) => state.selectedGroup, (group) => {
      this.balls?.select(group);
      this.stage.outdate();
    });
    this.store.watch((state) => state.state?.mode ?? Mode.NO_ROBOT, (mode) => {
      if (mode === Mode.FALLING || mode === Mode.FALLEN) this.messages.show("info", say("fall.calm"));
    });
    void loadFieldLines(location.href).then((lines) => {
      if (!lines) return;
      this.stage.floor.setField(lines);
      this.stage.outdate();
    });
    this.store.watch((state) => `${state.phase} ${state.loading.done} ${state.loading.error}`,
                     () => this.chooseScreen());
    window.addEventListener("online", () => this.connection.retryNow());
    document.addEventListener("visibilitychange", () => this.visibilityChanged());
    window.addEventListener("pagehide", () => this.letGo());
    this.openFromUrl();
  }

  /** A link with a token, or an address used before, connects at once. */
  private openFromUrl(): void {
    const known = this.settings.recent.find((recent) => recent.address === location.host);
    const fromUrl = tokenFromUrl(new URL(location.href));
    this.token = fromUrl || (known?.token ?? "");
    // The token does not stay in sight, nor in a screenshot of the address bar.
    if (fromUrl) history.replaceState(null, "", location.pathname);
    this.connectionScreen.fill(location.host, this.token, this.settings);
    if (fromUrl || known || isLoopback(location.hostname)) this.open();
  }

  private connect({address, token, clientName}: ConnectionForm): void {
    this.keep({clientName});
    this.token = token;
    const url = pageUrl(address, token);
    // Another robot's page comes from that robot: its gateway lets no foreign page in.
    if (url && url.host !== location.host) location.assign(url);
    else this.open();
  }

  private open(): void {
    this.connection.connect({token: this.token, clientName: this.settings.clientName,
                             clientSoftware: kSoftware});
  }

  private leave(): void {
    this.letGo();
    this.connection.disconnect();
  }

  private async connected({robot}: Connected): Promise<void> {
    this.keep(remember(this.settings, location.host, this.token));
    this.connectionScreen.fill(location.host, this.token, this.settings);
    this.image.setCameras(robot?.cameras ?? []);
    this.subscribe();
    if (robot && robot.urdfPath !== this.robotPath) await this.prepareRobot();
    else this.makeMirror();
  }

  private async prepareRobot(): Promise<void> {
    const path = this.store.get().robot?.urdfPath ?? "";
    this.store.set({loading: {done: 0, total: 0, error: ""}});
    try {
      const robot = await loadRobot(new URL(path, location.href), this.stage.surface, (done, total) =>
          this.store.set({loading: {done, total, error: ""}}));
      this.robot = robot;
      this.robotPath = path;
      this.stage.setRobot(robot);
      this.balls = new JointBalls(robot, this.stage.surface,
                                 this.store.get().robot?.jointGroups ?? []);
      this.balls.show(this.store.get().isJointsMode);
      this.makeMirror();
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      this.store.set({loading: {done: 0, total: 0, error: why}});
    }
  }

  private makeMirror(): void {
    const {robot, state} = this.store.get();
    if (!robot || !this.robot) return;
    this.mirror = new PoseMirror(this.robot, robot.joints);
    if (state) this.mirror.setTarget(state);
  }

  private subscribe(): void {
    if (this.store.get().phase !== "connected") return;
    const isHidden = document.visibilityState === "hidden";
    const request = {camera: this.image.camera, width: this.image.isLarge ? 640 : 320};
    void this.connection.request(useCases.subscribe(isHidden ? 0 : kStateRateHz,
                                                    isHidden ? 0 : kImageRateHz, request));
  }

  private visibilityChanged(): void {
    if (document.visibilityState === "hidden") this.letGo();
    else this.connection.retryNow();
    this.subscribe();
  }

  /** @return true if the robot looks different from the last frame. */
  private frame(dt: number): boolean {
    if (this.mirror?.hasPose && !this.isShown) this.markShown();
    const axes = this.gamepads.poll((button) => this.pressed(button));
    // One that was unplugged is at rest: what it held must not go on.
    this.padMoved(axes ?? []);
    const hasMoved = this.mirror?.step(dt) ?? false;
    if (hasMoved) this.balls?.update();
    return hasMoved;
  }

  /** The robot is drawn in its pose for the first time. The mark is for measurements. */
  private markShown(): void {
    this.isShown = true;
    performance.mark("robot-shown");
    registerOfflineShell();
  }

  private tapped(x: number, y: number): void {
    if (!this.store.get().isJointsMode) return this.walkHere.tapped(x, y);
    const {width, height} = this.stage.size;
    const group = this.balls?.pick(x, y, this.stage.camera, width, height) ?? "";
    if (group) {
      vibrate(kTapPattern);
      this.store.set({selectedGroup: group});
    }
  }

  private setJointsMode(isJointsMode: boolean): void {
    this.letGo();
    this.walkHere.clear();
    this.store.set({isJointsMode, selectedGroup: ""});
    this.stage.orbit.setView(isJointsMode ? kJointsView : kDriveView);
  }

  /** Scales fractions of the controls' range by the limits of the robot's walk. */
  private sendWalk({x, y, theta}: Drive): void {
    const {robot} = this.store.get();
    if (!robot) return;
    const vx = x * (x < 0 ? -robot.minVx : robot.maxVx);
    this.commander.stream(useCases.walkTurn(vx, y * robot.maxVy, theta * robot.maxWz));
  }

  private stop(): void {
    this.letGo();
    vibrate(kTapPattern);
    void this.commander.stop();
  }

  private keysChanged(held: ReadonlySet<string>, isSlow: boolean): void {
    const isJointsMode = this.store.get().isJointsMode;
    this.jointDriver.setStick(isJointsMode ? stickFromKeys(held, isSlow) : null);
    this.walk.set("keys", isJointsMode ? null : driveFromKeys(held, isSlow));
  }

  private padMoved(axes: readonly number[]): void {
    const {walk, turn} = sticksFromPad(axes);
    const drive = driveFromSticks(walk, turn);
    const isHeld = drive.x !== 0 || drive.y !== 0 || drive.theta !== 0;
    const isJointsMode = this.store.get().isJointsMode;
    if (isHeld || this.isPadHeld) {
      this.walk.set("gamepad", isHeld && !isJointsMode ? drive : null);
      if (isJointsMode) this.jointDriver.setStick(isHeld ? walk : null);
    }
    this.isPadHeld = isHeld;
  }

  private pressed(button: PadButton): void {
    switch (button) {
      case "stop": return this.stop();
      case "lock": return this.setJointsMode(!this.store.get().isJointsMode);
      case "ready": return this.goToPosture(this.store.get().robot?.readyPosture);
      case "stand": return this.goToPosture(this.store.get().robot?.standPosture);
      case "crouch": return this.goToPosture(this.store.get().robot?.restPosture);
      case "kick-left": return this.kick("left");
      case "kick-right": return this.kick("right");
    }
  }

  private goToPosture(posture: string | undefined): void {
    if (posture) void this.commander.command(useCases.goToPosture(posture));
  }

  private kick(side: "left" | "right"): void {
    const roles = this.store.get().robot?.actionRoles ?? [];
    const action = roles.find((role) => role.kind === "kick" && role.side === side);
    if (action) void this.commander.command(useCases.doAction(action.name));
  }

  /** Turns what carries the camera. */
  private turnCamera(yaw: number, pitch: number): void {
    const group = this.store.get().robot?.cameraGroup;
    if (group) this.commander.stream(useCases.changeJoints({group, yaw, pitch, roll: 0}));
  }

  private openMenu(): void {
    this.letGo();
    this.menu.open();
  }

  private async setTilt(isOn: boolean): Promise<boolean> {
    const isTilting = isOn && (await this.tilt.switchOn());
    if (!isTilting) this.tilt.switchOff();
    this.controllerScreen.setTilt(isTilting);
    return isTilting;
  }

  /** Words are put in place once; another language starts the page again, which connects by itself. */
  private setLanguage(language: Language): void {
    this.keep({language});
    this.letGo();
    location.reload();
  }

  private explainLink(): void {
    const state = this.store.get();
    const words = linkInWords(state);
    this.messages.show("info", linkQuality(state) === "poor" ? `${words}. ${say("drive.linkPoor")}` : words);
  }

  private keep(settings: Partial<Settings>): void {
    this.settings = {...this.settings, ...settings};
    saveSettings(storage(), this.settings);
  }

  /** Nothing drives any more: the fingers may be anywhere. */
  private letGo(): void {
    this.controllerScreen.release();
    this.jointDriver.setStick(null);
    this.walk.release();
  }

  private chooseScreen(): void {
    const {phase, loading} = this.store.get();
    const isLoaded = loading.total > 0 && loading.done === loading.total;
    const screen: ScreenName = phase !== "connected" ? "connection" :
        isLoaded ? "controller" : "loading";
    if (this.root.dataset["screen"] === screen) return;
    this.root.dataset["screen"] = screen;
    if (screen === "controller") this.stage.start();
    else {
      this.letGo();
      this.stage.stop();
    }
  }
}

function isLoopback(host: string): boolean {
  return host === "localhost" || host === "127.0.0.1" || host === "[::1]";
}

/** Felt where the phone can; silently nothing where it cannot. */
function vibrate(pattern: VibratePattern): void {
  navigator.vibrate?.(pattern);
}
