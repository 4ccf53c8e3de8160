import {describe, expect, it} from "vitest";
import {parseGateways} from "./nearby";

describe("parseGateways", () => {
  it("takes name and address", () => {
    const list = [{name: "NAO on lab-3", address: "192.168.1.20", http_port: 8080, url: "http://192.168.1.20:8080"}];
    expect(parseGateways({gateways: list})).toEqual([{name: "NAO on lab-3", address: "192.168.1.20:8080"}]);
  });
  it("leaves out what is not a gateway", () => {
    for (const data of [null, 3, {}, {gateways: 1}, {gateways: [null, 1, {}, {name: "x", address: "javascript:1", http_port: 1},
                                                               {name: "", address: "10.0.0.1", http_port: 1},
                                                               {name: "x", address: "10.0.0.1", http_port: "1"}]}]) {
      expect(parseGateways(data)).toEqual([]);
    }
  });
});
