/** Makes the parts and joins them. */
import "./styles/app.css";
import "./styles/controller.css";
import {App} from "./app";
import {loadSettings} from "./settings";
import {storage} from "./storage";
import {chooseLanguage, setLanguage} from "./text/texts";

const settings = loadSettings(storage());
const language = chooseLanguage([settings.language, ...navigator.languages]);
setLanguage(language);
document.documentElement.lang = language;

new App(document.getElementById("app")!, settings).start();
