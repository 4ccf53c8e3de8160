/** The app: which screen is seen, and how the parts hang together. */
import type {BluetoothDevice} from "./bluetooth/web_bluetooth";
import {Commander} from "./commander";
import {Connection} from "./connection";
import {HeldControls} from "./controls/held_controls";
import type {PadButton} from "./controls/keys";
import {JointDriver} from "./controls/joint_driver";
import {ImageView} from "./controls/image_view";
import type {Drive} from "./controls/stick";
import {TiltSensor} from "./controls/tilt_sensor";
import {WalkSender} from "./controls/walk_sender";
import {automationOf} from "./automation";
import {el} from "./dom";
import {reloadButton} from "./screens/reload_button";
import {listenToLeaving} from "./leaving";
import {Lobby} from "./lobby";
import {reportMatch} from "./match/match_events";
import {Messages} from "./messages";
import {registerOfflineShell} from "./offline";
import {Mode, Notice_Component} from "./protocol/generated/remote_pb";
import {Perception} from "./play/perception";
import {PlayStrip} from "./play/play_strip";
import {loadFieldLines} from "./robot/load_field";
import {watchContext} from "./robot/lost_context";
import {RobotView} from "./robot/robot_view";
import {kDriveView, kJointsView, Stage} from "./robot/stage";
import {attachGestures} from "./robot/stage_gestures";
import type {Actions, ConnectionForm} from "./screens/actions";
import {ConnectionScreen} from "./screens/connection_screen";
import {causeBar} from "./screens/cause";
import {ControllerScreen} from "./screens/controller_screen";
import {JointsPanel} from "./screens/joints_panel";
import {loadingScreen} from "./screens/loading_screen";
import {messageList} from "./screens/message_list";
import {MenuSheet} from "./screens/menu_sheet";
import {WalkHere} from "./screens/walk_here";
import {pageUrl, remember, saveSettings, tokenFromUrl} from "./settings";
import type {Settings} from "./settings";
import {Sound} from "./sound";
import {Speech} from "./speech/speech";
import {storage} from "./storage";
import {isStale, Store} from "./store";
import {Teach} from "./teach/teach";
import {bodyInWords} from "./text/body";
import {findGateways} from "./nearby";
import {say} from "./text/texts";
import {GatewayTransport} from "./relay/gateway_transport";
import {kRefusalPattern, kTapPattern, vibrate} from "./vibrate";
import {WakeLock} from "./wake_lock";

const kSoftware = "nao-phone-app 0.1.0";
/** The screen's rate: a joint is seen to move 8 ms sooner than at half the rate, for 20 kB/s. */
const kStateRateHz = 60;
const kImageRateHz = 15;
/** By Bluetooth, 100 kbit/s: 20 states a second also while an image is sent. */
const kNarrowStateRateHz = 25;
/** Hosts that let a page in without a token. */
const kLoopback = ["localhost", "127.0.0.1", "[::1]"];
const kNarrowImage = {rate: 1, width: 160, quality: 30};

export class App implements Actions {
  private readonly store = new Store();
  private readonly messages = new Messages(this.store);
  private readonly transport = new GatewayTransport(new URL(location.href));
  private readonly connection: Connection;
  private readonly commander: Commander;
  private readonly walk: WalkSender;
  private readonly stage: Stage;
  private readonly image = new ImageView(() => this.subscribe(), (yaw, pitch) =>
      this.turnCamera(yaw, pitch));
  private readonly jointDriver = new JointDriver((change) => {
    this.teach.turned(change);
    this.commander.stream({case: "changeJoints", value: change});
  });
  private readonly tilt = new TiltSensor();
  private readonly sound = new Sound();
  private readonly wakeLock = new WakeLock();
  private readonly held: HeldControls;
  private readonly view: RobotView;
  private readonly teach: Teach;
  private readonly walkHere: WalkHere;
  private readonly menu: MenuSheet;
  private readonly lobby: Lobby;
  private readonly speech: Speech;
  private readonly play: PlayStrip;
  private readonly perception: Perception;
  private readonly connectionScreen: ConnectionScreen;
  private readonly controllerScreen: ControllerScreen;
  private token = "";
  private isShown = false;
  private isVisiting = false;

  constructor(private readonly root: HTMLElement, settings: Settings) {
    this.store.set({settings});
    this.connection = new Connection(
        this.transport, this.store, {
          connected: () => void this.connected(),
          robotChanged: () => {
            this.lobby.robotChanged();
            void this.showRobot();
          },
          state: (state) => {
            this.view.setTarget(state);
            this.store.set({state});
          },
          image: (image) => {
            this.store.set({image});
            this.image.show(image);
          },
          notice: (notice) => this.commander.notice(notice),
          audio: (audio) => this.speech.play(audio),
        });
    this.commander = new Commander(this.connection, this.store, this.messages);
    this.walk = new WalkSender((drive, isLocked) => this.sendWalk(drive, isLocked));
    const canvas = el("canvas", {class: "stage", role: "img", "aria-label": say("drive.stage")});
    const lost = el("div", {class: "lost-context", role: "alert", hidden: true}, el("p", {}, say("drive.lostContext")),
                    reloadButton());
    watchContext(canvas, (isLost) => {
      lost.hidden = !isLost;
      this.stage.outdate();
    });
    this.stage = new Stage(canvas);
    this.stage.onFrame = (dt) => this.frame(dt);
    this.stage.orbit.isGliding = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.view = new RobotView(this.store, this.stage, (meshes) =>
        this.messages.show("bad", say("loading.damaged", {files: meshes.join(", ")})));
    this.held = new HeldControls(this.store, this.walk, this.jointDriver, {
      pressed: (button) => this.pressed(button),
      unknown: (name) => this.messages.show("info", say("pad.unknown", {name})),
      silent: () => this.messages.show("bad", say("pad.silent")),
    });
    this.teach = new Teach(this.store, this.commander, this.messages, this.view, storage(), () => this.stop());
    attachGestures(this.stage, (x, y) => this.tapped(x, y), (x, y) => this.teach.grab(x, y));
    this.jointDriver.isInFront = () => this.stage.orbit.isInFront;
    this.walkHere = new WalkHere(this.stage, (value) => void this.commander.command({case: "moveTo", value}));
    this.commander.onRefusal = () => vibrate(kRefusalPattern);
    this.held.yieldTo(this.commander, this.messages);
    this.held.releaseScreen = () => {
      this.controllerScreen.release();
      this.teach.endDrag();
    };
    this.speech = new Speech(this.store, this.commander, this.stage, storage(), this.sound, () => this.subscribe());
    this.connectionScreen = new ConnectionScreen(this.store, this);
    const joints = new JointsPanel(this.store, this.jointDriver, this.teach, () =>
        void this.teach.leave().then(() => this.goToPosture(this.store.get().robot?.readyPosture)));
    this.play = new PlayStrip(this.store, this.commander, this.messages);
    this.perception = new Perception(this.store, this.stage, this.image, this.play, this);
    const view = el("div", {class: "view"}, canvas, this.walkHere.element, lost);
    const notes = el("div", {class: "notes"}, causeBar(this.store, this.commander, this));
    this.controllerScreen = new ControllerScreen(this.store, this.commander, this.walk, view, this.image, joints, this.tilt,
                                                 this.play, this.perception.map.element, notes, this.messages, this);
    this.menu = new MenuSheet(settings.isSwapped, this);
    this.lobby = new Lobby(this.store, this.commander, this.messages, this);
    const messages = messageList(this.store);
    this.store.watch((state) => state.isChoosingRobot, (isLobby) => (isLobby ? this.lobby.screen.element : notes).append(messages));
    root.append(loadingScreen(this.store, () => void this.view.load()),
                this.connectionScreen.element, this.lobby.screen.element, this.controllerScreen.element,
                this.menu.element, this.speech.sheet.element, this.teach.sheet.element,
                this.perception.choice.element);
    this.controllerScreen.observeFreeArea((area) => this.stage.setFreeArea(area));
  }

  start(): void {
    window.naoRemote = automationOf(this.store, this.stage, this.image, this.view, this.perception.objects);
    reportMatch(this.store, this.messages, this.sound);
    this.store.watch((state) => state.imageAgeMs, (ageMs) => this.image.showAge(ageMs));
    this.store.watch(isStale, (isOn) => this.root.classList.toggle("stale", isOn));
    this.held.lockWhileStale(() => {
      vibrate(kRefusalPattern);
      this.messages.show("bad", say("drive.linkLost"));
    });
    this.store.watch((state) => state.exhibition !== null, (isOn) => {
      if (isOn) void this.visit();
    });
    matchMedia("(prefers-color-scheme: light)").addEventListener("change", () => this.stage.takeColors());
    this.held.listen(() => this.root.dataset["screen"] === "controller");
    this.store.watch((state) => state.unavailableComponents.includes(Notice_Component.CAMERA), (isOff) => this.image.setOff(isOff));
    // Another motion replaces the walk to the marked spot.
    this.store.watch((state) => state.state?.activity?.name ?? "", (activity) => {
      if (activity) this.walkHere.clear();
    });
    this.store.watch((state) => state.state?.mode ?? Mode.NO_ROBOT, (mode) => {
      if (mode === Mode.FALLING || mode === Mode.FALLEN) this.messages.show("info", say("fall.calm"));
    });
    void loadFieldLines(location.href).then((lines) => {
      if (!lines) return;
      this.stage.floor.setField(lines);
      this.perception.map.setField(lines);
      this.stage.outdate();
    });
    this.store.watch((state) => `${state.phase} ${state.problem} ${state.isFormOpen} ${state.isChoosingRobot} ${state.loading.done} ${state.loading.error}`,
                     () => this.chooseScreen());
    window.addEventListener("online", () => this.connection.retryNow());
    listenToLeaving({
      blurred: () => void this.held.release(),
      // Nobody sees the robot any more: it does nothing by itself either.
      hidden: () => {
        this.held.release();
        this.play.letGo();
        this.subscribe();
      },
      shown: () => {
        void this.wakeLock.renew();
        this.connection.retryNow();
        this.subscribe();
      },
    });
    this.openFromUrl();
    this.store.watch((state) => state.phase, (phase) => {
      if (phase === "connected") {
        this.wakeLock.hold();
        this.store.set({isFormOpen: false});
      } else {
        this.wakeLock.release();
      }
      if (phase === "idle" || phase === "waiting") {
        void findGateways(location.href).then((gateways) => this.connectionScreen.showNearby(gateways));
      }
    });
  }

  /** The person stands in an exhibition's queue, once. */
  private async visit(): Promise<void> {
    if (this.isVisiting) return;
    this.isVisiting = true;
    const {Visit} = await import("./exhibition/visit");
    await Visit.begin(this.store, this.commander, this.root, this.root.querySelector<HTMLElement>(".notes")!, storage(),
                      () => this.letGo());
  }

  /** A link with a token, or an address used before, connects at once. */
  private openFromUrl(): void {
    const known = this.settings.recent.find((recent) => recent.address === location.host);
    const fromUrl = tokenFromUrl(new URL(location.href));
    this.token = fromUrl || (known?.token ?? "");
    // The token does not stay in sight, nor in a screenshot of the address bar.
    if (fromUrl) history.replaceState(null, "", location.pathname);
    this.connectionScreen.fill(location.host, this.token, this.settings);
    if (fromUrl || known || kLoopback.includes(location.hostname)) this.open();
  }

  connect({address, token, clientName}: ConnectionForm, device: BluetoothDevice | null = null): void {
    this.keep({clientName});
    this.token = token;
    this.transport.device = device;
    const url = device ? null : pageUrl(address, token);
    // Another robot's page comes from that robot: its gateway lets no foreign page in.
    if (url && url.host !== location.host) location.assign(url);
    else this.open();
  }

  private open(): void {
    this.connection.connect({token: this.token, clientName: this.settings.clientName,
                             clientSoftware: kSoftware});
  }

  /** At once; also after a refusal that waiting alone would not change. */
  retry(): void {
    if (this.store.get().phase === "waiting") this.connection.retryNow();
    else this.open();
  }

  leave(): void {
    this.held.release();
    this.connection.disconnect();
  }

  private async connected(): Promise<void> {
    // By Bluetooth it may be another robot than that of the page.
    if (!this.transport.device) this.keep(remember(this.settings, location.host, this.token));
    this.connectionScreen.fill(location.host, this.token, this.settings);
    await this.showRobot();
  }

  private async showRobot(): Promise<void> {
    this.image.setCameras(this.store.get().robot?.cameras ?? []);
    this.subscribe();
    await this.view.showConnected();
  }

  /** Drive mode, with nothing held. */
  letGo(): void {
    if (this.store.get().isJointsMode) this.setJointsMode(false);
    this.held.release();
    this.walkHere.clear();
  }

  subscribe(): void {
    if (this.store.get().phase !== "connected") return;
    // Nothing is seen of the robot in the list of robots either.
    const isHidden = document.visibilityState === "hidden" || this.store.get().isChoosingRobot;
    const {isNarrow} = this.transport;
    const {camera} = this.image;
    const image = isNarrow ? {camera, width: kNarrowImage.width, quality: kNarrowImage.quality} :
        {camera, width: this.image.isLarge ? 640 : 320};
    const [stateRate, imageRate] = isHidden ? [0, 0] : isNarrow ? [kNarrowStateRateHz, kNarrowImage.rate] : [kStateRateHz, kImageRateHz];
    void this.connection.request({case: "subscribe", value: {
      stateRate, imageRate, image, audio: this.store.get().speech.isPlaying && !isNarrow, playState: true, vision: !isHidden}});
  }

  /** @return true if the robot looks different from the last frame. */
  private frame(dt: number): boolean {
    if (this.view.hasPose && !this.isShown) {
      this.isShown = true;
      // For measurements: the robot is drawn in its pose for the first time.
      performance.mark("robot-shown");
      void registerOfflineShell();
    }
    this.held.poll();
    return this.view.step(dt);
  }

  private tapped(x: number, y: number): void {
    const {isJointsMode, robot} = this.store.get();
    if (this.image.isLarge) return this.image.swap();
    const group = isJointsMode ? this.view.ballAt(x, y) : this.stage.groupAt(x, y, robot?.jointGroups ?? []);
    if (!isJointsMode && this.perception.tapped(x, y)) return this.walkHere.clear();
    if (!group) return isJointsMode ? undefined : this.walkHere.tapped(x, y);
    vibrate(kTapPattern);
    if (!isJointsMode) this.setJointsMode(true);
    this.store.set({selectedGroup: group});
  }

  setJointsMode(isJointsMode: boolean): void {
    this.held.release();
    this.walkHere.clear();
    this.store.set({isJointsMode, selectedGroup: ""});
    // The balls are on the robot.
    if (isJointsMode && this.image.isLarge) this.image.swap();
    this.stage.orbit.setView(isJointsMode ? kJointsView : kDriveView);
    if (!isJointsMode) void this.teach.leave();
    else this.teach.explain();
  }

  /** Scales fractions of the controls' range by the limits of the robot's walk. */
  private sendWalk({x, y, theta}: Drive, isLocked: boolean): void {
    const {robot} = this.store.get();
    if (!robot) return;
    const vx = x * (x < 0 ? -robot.minVx : robot.maxVx);
    this.commander.stream({
      case: "walkTurn", value: {vx, vy: y * robot.maxVy, wz: theta * robot.maxWz, isHeld: isLocked}});
  }

  stop(): void {
    this.held.release();
    this.teach.cancel();
    vibrate(kTapPattern);
    void this.commander.stop();
  }

  private pressed(button: PadButton): void {
    switch (button) {
      case "stop": return this.stop();
      case "lock": return this.setJointsMode(!this.store.get().isJointsMode);
      case "ready": return this.goToPosture(this.store.get().robot?.readyPosture);
      case "stand": return this.goToPosture(this.store.get().robot?.standPosture);
      case "crouch": return this.goToPosture(this.store.get().robot?.restPosture);
      case "next-group": return this.selectNext(1);
      case "previous-group": return this.selectNext(-1);
      case "kick-left": return this.kick("left");
      case "kick-right": return this.kick("right");
    }
  }

  /** In joints mode the group after, or before, the chosen one. */
  private selectNext(step: number): void {
    const {isJointsMode, robot, selectedGroup} = this.store.get();
    const names = (robot?.jointGroups ?? []).map(({name}) => name);
    if (!isJointsMode || names.length === 0) return;
    const index = names.indexOf(selectedGroup);
    const next = index < 0 && step < 0 ? names.length - 1 : (index + step + names.length) % names.length;
    this.store.set({selectedGroup: names[next]!});
  }

  private goToPosture(posture: string | undefined): void {
    if (posture) void this.commander.command({case: "goToPosture", value: {posture}});
  }

  private kick(side: "left" | "right"): void {
    const roles = this.store.get().robot?.actionRoles ?? [];
    const action = roles.find((role) => role.kind === "kick" && role.side === side);
    if (action) void this.commander.command({case: "doAction", value: {action: action.name}});
  }

  /** Turns what carries the camera. */
  private turnCamera(yaw: number, pitch: number): void {
    const group = this.store.get().robot?.cameraGroup;
    if (group) this.commander.stream({case: "changeJoints", value: {group, yaw, pitch}});
  }

  changeRobot(): void {
    this.lobby.open();
  }

  openMenu(): void {
    this.held.release();
    const {state, robot, robots} = this.store.get();
    this.menu.open(bodyInWords(state?.body, robot), robots.length > 1);
  }

  openSpeech(): void {
    this.held.release();
    this.speech.sheet.element.showModal();
  }

  async setTilt(isOn: boolean): Promise<boolean> {
    const isTilting = isOn && (await this.tilt.switchOn());
    if (!isTilting) this.tilt.switchOff();
    this.store.set({isTilting});
    return isTilting;
  }

  keep(settings: Partial<Settings>): void {
    this.store.set({settings: {...this.settings, ...settings}});
    saveSettings(storage(), this.settings);
  }

  private get settings(): Settings {
    return this.store.get().settings;
  }

  private chooseScreen(): void {
    const {phase, problem, robot, loading, isChoosingRobot, isFormOpen} = this.store.get();
    const isLoaded = loading.total > 0 && loading.done === loading.total;
    // What was seen of a robot stays in sight; its cause bar says why nothing new comes.
    const hasRobot = robot !== null && !isFormOpen && (phase !== "idle" || problem !== null);
    const screen = phase !== "connected" && !hasRobot ? "connection" : isChoosingRobot ? "lobby" :
        isLoaded ? "controller" : "loading";
    if (this.root.dataset["screen"] === screen) return;
    this.root.dataset["screen"] = screen;
    if (screen === "controller") {
      this.stage.start();
    } else {
      this.held.release();
      this.stage.stop();
      this.teach.sheet.element.close();
    }
  }
}
