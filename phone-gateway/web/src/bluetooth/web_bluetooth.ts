/** The part of Web Bluetooth that the app uses (https://webbluetoothcg.github.io/web-bluetooth/), which TypeScript does not know. */

export const kServiceUuid = "b1e6a0f2-4a53-4c0e-9d38-2f6c7e5d1a90";
export const kMessagesUuid = "b1e6a0f3-4a53-4c0e-9d38-2f6c7e5d1a90";

export interface BluetoothCharacteristic extends EventTarget {
  readonly value?: DataView;
  readValue(): Promise<DataView>;
  writeValueWithoutResponse(value: Uint8Array<ArrayBuffer>): Promise<void>;
  startNotifications(): Promise<unknown>;
}

export interface BluetoothDevice extends EventTarget {
  readonly name?: string;
  readonly gatt?: {
    connect(): Promise<{
      getPrimaryService(uuid: string): Promise<{getCharacteristic(uuid: string): Promise<BluetoothCharacteristic>}>;
    }>;
    disconnect(): void;
  };
}

interface Bluetooth {
  requestDevice(options: {filters: {services: string[]}[]}): Promise<BluetoothDevice>;
}

/** Null: the browser has none, or not for a page without https. */
export function findBluetooth(): Bluetooth | null {
  return (navigator as {bluetooth?: Bluetooth}).bluetooth ?? null;
}

/** The person chooses a robot within reach; null: none. To be called while a tap is handled. */
export async function chooseRobot(bluetooth: Bluetooth): Promise<BluetoothDevice | null> {
  return bluetooth.requestDevice({filters: [{services: [kServiceUuid]}]}).catch(() => null);
}

/** No browser of these has it; an iPad calls itself a Mac. */
export function isApple(): boolean {
  return /iPhone|iPad|iPod/.test(navigator.userAgent) || (/Macintosh/.test(navigator.userAgent) && navigator.maxTouchPoints > 1);
}
