/** Serves the app with the fake gateway: `npm run fake -- DATA_DIR [PORT]`, DATA_DIR as build/dev/share/nao-remote.
 * A JPEG named by NAO_IMAGE, if any, is sent as the head's image; with NAO_PLAYS the robot sees a ball and plays,
 * with NAO_MATCH it is one of several. */
import {readFileSync} from "node:fs";
import {join} from "node:path";
import {FakeGateway} from "./fake_gateway";
import {readActionRoles, readJointGroups, readJoints, readLabels, readPostures} from "./nao_files";

const [dataDir, port] = process.argv.slice(2);
if (!dataDir) throw new Error("usage: npm run fake -- DATA_DIR [PORT]");
const robot = join(dataDir, "robots/nao");
const imageFile = process.env["NAO_IMAGE"];
const image = imageFile ? readFileSync(imageFile) : null;
const gateway = new FakeGateway({
  dataDir, token: "fake", joints: readJoints(robot), jointGroups: readJointGroups(robot),
  postures: readPostures(robot), actionRoles: readActionRoles(robot), labels: readLabels(robot),
  ...(image ? {image: () => image} : {}), plays: Boolean(process.env["NAO_PLAYS"]),
  hasMatch: Boolean(process.env["NAO_MATCH"]),
});
console.log(await gateway.start(Number(port ?? 0)));
