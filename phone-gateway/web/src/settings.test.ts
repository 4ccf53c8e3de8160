import {describe, expect, it} from "vitest";
import {pageUrl, readForm} from "./settings";

const kEmpty = {address: "", token: "", clientName: ""};

describe("the connection form", () => {
  it.each(["address", "token", "clientName"] as const)("takes an address with its token from the field %s", (name) => {
    const typed = {address: "10.0.0.1:8080", token: "old", clientName: "Ana",
                   [name]: " http://192.168.1.20:8080/#token=k7mq-3xpa\n"};
    expect(readForm(typed)).toEqual({address: "192.168.1.20:8080", token: "k7mq-3xpa",
                                     clientName: name === "clientName" ? "" : "Ana"});
  });
  it.each([
    ["192.168.1.20:8080/#token=a%20b", "192.168.1.20:8080", "a b"],
    ["nao.local/?token=k7", "nao.local:8080", "k7"],
    ["https://nao.local/#token=k7", "https://nao.local", "k7"],
    ["http://nao.local/#token=k7", "http://nao.local", "k7"],
    ["HTTP://[fd00::1]:8080/#token=k7", "[fd00::1]:8080", "k7"],
  ])("reads %s", (pasted, address, token) => {
    const form = readForm({...kEmpty, token: pasted});
    expect(form).toEqual({address, token, clientName: ""});
    // What it reads, it connects to.
    expect(pageUrl(form.address, "")!.origin).toBe(new URL(/^http/i.test(pasted) ? pasted : `http://${address}`).origin);
  });
  it("keeps a token beside an address without one, and what is not an address", () => {
    expect(readForm({address: "http://10.0.0.1:8080/", token: " K7MQ 3XPA ", clientName: "Ana"}))
        .toEqual({address: "10.0.0.1:8080", token: "K7MQ 3XPA", clientName: "Ana"});
    expect(readForm({address: "nao.local", token: "k7", clientName: "http://"}))
        .toEqual({address: "nao.local", token: "k7", clientName: "http://"});
  });
});
