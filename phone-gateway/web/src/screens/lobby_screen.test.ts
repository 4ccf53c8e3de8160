import {create} from "@bufbuild/protobuf";
import {describe, expect, it} from "vitest";
import {RobotList_RobotSchema} from "../protocol/generated/remote_pb";
import {driverOf} from "./lobby_screen";
import {teamInWords} from "./robot_tag";

const robot = (fields: object) => create(RobotList_RobotSchema, {name: "NAO2", isAvailable: true, ...fields});

describe("driverOf", () => {
  it("says who drives a robot", () => {
    expect(driverOf(robot({}), 7)).toEqual({who: "free", text: "Free"});
    expect(driverOf(robot({driverId: 3, driverName: "Ben"}), 7)).toEqual({who: "other", text: "Ben drives"});
    expect(driverOf(robot({driverId: 7, driverName: "Ana"}), 7)).toEqual({who: "mine", text: "You drive"});
  });

  it("says that a robot does not answer only where nobody drives it", () => {
    expect(driverOf(robot({isAvailable: false}), 7).who).toBe("absent");
    expect(driverOf(robot({isAvailable: false, driverId: 3, driverName: "Ben"}), 7).who).toBe("other");
  });
});

describe("teamInWords", () => {
  it("says team and number as far as there are any", () => {
    expect(teamInWords(robot({}))).toBe("");
    expect(teamInWords(robot({team: 0}))).toBe("Blue team");
    expect(teamInWords(robot({team: 1, number: 3}))).toBe("Red team, number 3");
  });
});
