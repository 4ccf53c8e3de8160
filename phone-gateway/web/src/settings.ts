/** What the phone remembers, and what the link that opened the page says. */
import {keep, recall} from "./storage";

const kKey = "nao-remote";
const kMaxRecent = 4;

export interface Recent {
  /** Host and port: "192.168.1.20:8080". */
  address: string;
  token: string;
}

export interface Settings {
  clientName: string;
  /** Tag of the language chosen; empty: the phone's. */
  language: string;
  /** True: walk on the right, turn on the left. */
  isSwapped: boolean;
  /** The person has walked a robot. */
  hasWalked: boolean;
  /** Boxes are drawn over the image around what the robot sees. */
  hasBoxes: boolean;
  /** Newest first. */
  recent: Recent[];
}

export const kDefaultSettings: Settings = {
  clientName: "", language: "", isSwapped: false, hasWalked: false, hasBoxes: true, recent: [],
};

/** Reads the settings; those that another version wrote badly count as not there. */
export function loadSettings(storage: Storage | null): Settings {
  const found = recall<Settings>(storage, kKey) ?? {};
  return {...kDefaultSettings, ...found, recent: Array.isArray(found.recent) ? found.recent.filter(isRecent) : []};
}

export function saveSettings(storage: Storage | null, settings: Settings): void {
  keep(storage, kKey, settings);
}

/** Puts an address in front of the list of those used. */
export function remember(settings: Settings, address: string, token: string): Settings {
  const others = settings.recent.filter((recent) => recent.address !== address);
  return {...settings, recent: [{address, token}, ...others].slice(0, kMaxRecent)};
}

/** Token in a link, "#token=..." (not sent to any server) or "?token=..."; empty if there is none. */
export function tokenFromUrl(url: URL): string {
  return new URLSearchParams(url.hash.slice(1)).get("token") ?? url.searchParams.get("token") ?? "";
}

/** The page of the gateway at an address as a person types it: "192.168.1.20", "nao.local:8080",
 * "https://...". Null if it is none. Without a port: the gateway's usual one. */
export function pageUrl(address: string, token: string): URL | null {
  const url = parseAddress(address);
  if (!url) return null;
  url.pathname = "/";
  url.search = "";
  url.hash = token ? `token=${encodeURIComponent(token)}` : "";
  return url;
}

/** What stands in the fields of the connection form. An address that was pasted with its token counts in whichever field it
 * stands. */
export function readForm<Form extends Record<"address" | "token" | "clientName", string>>(fields: Form): Form {
  const form = {...fields, address: fields.address.trim(), token: fields.token.trim(), clientName: fields.clientName.trim()};
  for (const name of ["clientName", "token", "address"] as const) {
    const url = /[#?&]token=|^https?:\/\//i.test(form[name]) ? parseAddress(form[name]) : null;
    if (!url) continue;
    form[name] = "";
    form.address = url.protocol === "http:" && url.port ? url.host : url.origin;
    form.token = tokenFromUrl(url) || form.token;
  }
  return form;
}

function parseAddress(address: string): URL | null {
  const text = address.trim();
  if (!text) return null;
  const hasScheme = /^https?:\/\//i.test(text);
  try {
    const url = new URL(hasScheme ? text : `http://${text}`);
    if (!hasScheme && !url.port) url.port = "8080";
    return url;
  } catch {
    return null;
  }
}

function isRecent(value: unknown): value is Recent {
  const {address, token} = (value ?? {}) as Partial<Recent>;
  return typeof address === "string" && typeof token === "string";
}
