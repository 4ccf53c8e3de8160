/** Makes the parts and joins them. */
import "./styles/app.css";
import "./styles/controller.css";
import "./styles/lobby.css";
import "./styles/speech.css";
import "./styles/teach.css";
import {App} from "./app";
import {el} from "./dom";
import {CannotDraw} from "./robot/drawing_context";
import {loadSettings} from "./settings";
import {storage} from "./storage";
import {chooseLanguage, say, setPageLanguage} from "./text/texts";

const settings = loadSettings(storage());
await setPageLanguage(chooseLanguage([settings.language, ...navigator.languages]));

const root = document.getElementById("app")!;
try {
  new App(root, settings).start();
} catch (error) {
  if (!(error instanceof CannotDraw)) throw error;
  root.replaceChildren(el("section", {class: "screen loading-screen"}, el("p", {role: "alert"}, say("loading.noDrawing"))));
}
