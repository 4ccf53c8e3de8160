/** What the screens ask of the app. */
import type {BluetoothDevice} from "../bluetooth/web_bluetooth";
import type {Settings} from "../settings";

/** What stands in the form for a connection. */
export interface ConnectionForm {
  address: string;
  token: string;
  clientName: string;
}

export interface Actions {
  /** @param device  by Bluetooth; none: over the network. */
  connect(form: ConnectionForm, device?: BluetoothDevice): void;
  /** Connects at once. */
  retry(): void;
  leave(): void;
  /** Ends all driving and joints mode. */
  letGo(): void;
  /** What is streamed depends on what is seen. */
  subscribe(): void;
  /** Shows the robots to choose from. */
  changeRobot(): void;
  openMenu(): void;
  openSpeech(): void;
  setJointsMode(isOn: boolean): void;
  stop(): void;
  /** @return whether tilting is on now. */
  setTilt(isOn: boolean): Promise<boolean>;
  /** The phone remembers settings. */
  keep(settings: Partial<Settings>): void;
}
