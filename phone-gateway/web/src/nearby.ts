/** Other robots in the network, as the gateway of this page has found them (its page "gateways"). */

import {timeLimit} from "./time_limit";

export interface Gateway {
  name: string;
  /** As a person types it: "192.168.1.20:8080". */
  address: string;
}

/** Entries without a name or an address are left out: any host can announce anything. */
export function parseGateways(data: unknown): Gateway[] {
  const list = (data as {gateways?: unknown} | null)?.gateways;
  if (!Array.isArray(list)) return [];
  return (list as unknown[]).flatMap((entry) => {
    const {name, address, http_port: port} = (entry ?? {}) as Record<string, unknown>;
    const isValid = typeof name === "string" && name !== "" && typeof address === "string" &&
        /^[0-9.]+$/.test(address) && typeof port === "number" && port > 0;
    return isValid ? [{name, address: `${address}:${port}`}] : [];
  });
}

/** @return none if the gateway does not answer. */
export async function findGateways(pageUrl: string): Promise<Gateway[]> {
  try {
    const answer = await fetch(new URL("gateways", pageUrl), {cache: "no-store", signal: timeLimit(2000)});
    return answer.ok ? parseGateways(await answer.json()) : [];
  } catch {
    return [];
  }
}
