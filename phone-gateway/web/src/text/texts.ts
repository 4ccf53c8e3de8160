/** All texts of the app, in every language; one row per text. Placeholders are written {name}. */
import {kBodyTexts} from "./body_texts";
import {kLobbyTexts} from "./lobby_texts";
import {kMatchTexts} from "./match_texts";
import {kPlayTexts} from "./play_texts";
import {kSpeechTexts} from "./speech_texts";
import {kTeachTexts} from "./teach_texts";

export const kLanguages = ["en", "pt", "de"] as const;
export type Language = (typeof kLanguages)[number];
export type Row = readonly [en: string, pt: string, de: string];

const kTexts = {
  ...kBodyTexts,
  ...kLobbyTexts,
  ...kMatchTexts,
  ...kPlayTexts,
  ...kTeachTexts,
  // Loading.
  "loading.app": ["Starting", "A iniciar", "Startet"],
  "loading.robot": ["Getting the robot", "A carregar o robô", "Der Roboter wird geladen"],
  "loading.failed": ["The robot could not be loaded", "Não foi possível carregar o robô",
                     "Der Roboter konnte nicht geladen werden"],
  "loading.again": ["Try again", "Tentar de novo", "Nochmal versuchen"],
  "loading.damaged": ["Not drawn, for these files are missing or damaged: {files}",
                      "Não desenhado, pois estes ficheiros faltam ou estão danificados: {files}",
                      "Nicht gezeichnet, denn diese Dateien fehlen oder sind beschädigt: {files}"],
  "drive.lostContext": ["The browser has stopped drawing the robot. The controls go on.",
                        "O navegador deixou de desenhar o robô. Os comandos continuam.",
                        "Der Browser zeichnet den Roboter nicht mehr. Die Steuerung geht weiter."],
  "connection.typeCode": ["Type the code", "Escrever o código", "Code eintippen"],
  "connection.reload": ["Reload", "Recarregar", "Neu laden"],
  "loading.noDrawing": ["This browser cannot draw in 3D. A newer Chrome, Firefox or Safari can.",
                        "Este navegador não desenha em 3D. Um Chrome, Firefox ou Safari mais recente consegue.",
                        "Dieser Browser kann nicht in 3D zeichnen. Ein neuerer Chrome, Firefox oder Safari kann es."],
  // Connection.
  "connection.title": ["Drive the robot", "Conduzir o robô", "Den Roboter steuern"],
  "connection.subtitle": ["Phone and robot must be in the same Wi-Fi.",
                          "O telefone e o robô têm de estar na mesma rede Wi-Fi.",
                          "Telefon und Roboter müssen im selben WLAN sein."],
  "connection.address": ["Robot's address", "Endereço do robô", "Adresse des Roboters"],
  "connection.token": ["Pairing code", "Código de ligação", "Kopplungscode"],
  "connection.tokenHelp": ["It stands below the robot's QR code, such as k7mq-3xpa. Or paste the robot's whole address.",
                           "Está por baixo do código QR do robô, por exemplo k7mq-3xpa. Ou cole o endereço completo.",
                           "Er steht unter dem QR-Code des Roboters, etwa k7mq-3xpa. Oder füge die ganze Adresse ein."],
  "connection.name": ["Your name", "O seu nome", "Dein Name"],
  "connection.namePlaceholder": ["What others see", "O que os outros veem", "Was andere sehen"],
  "connection.connect": ["Connect", "Ligar", "Verbinden"],
  "connection.connecting": ["Connecting …", "A ligar …", "Verbindet …"],
  "connection.cancel": ["Cancel", "Cancelar", "Abbrechen"],
  "connection.now": ["Try now", "Tentar agora", "Jetzt versuchen"],
  "connection.retry": ["Trying again in {seconds} s", "Nova tentativa em {seconds} s",
                       "Nächster Versuch in {seconds} s"],
  "connection.bluetooth": ["Connect by Bluetooth", "Ligar por Bluetooth", "Mit Bluetooth verbinden"],
  "connection.noBluetooth": ["Bluetooth is not offered: no browser on iPhones and iPads lets pages use it.",
                             "Sem Bluetooth: em iPhones e iPads, nenhum navegador deixa uma página usá-lo.",
                             "Kein Bluetooth: Auf iPhones und iPads lässt kein Browser eine Seite es benutzen."],
  "connection.nearby": ["Other robots in this Wi-Fi", "Outros robôs nesta rede Wi-Fi", "Andere Roboter in diesem WLAN"],
  "connection.recent": ["Used before", "Usados antes", "Früher benutzt"],
  "problem.unreachable": ["Nothing answers at this address.", "Nada responde neste endereço.",
                          "Unter dieser Adresse antwortet nichts."],
  "advice.unreachable": ["Is the robot on, and is this phone in its Wi-Fi?",
                         "O robô está ligado e o telefone na mesma rede Wi-Fi?",
                         "Ist der Roboter an und dieses Telefon in seinem WLAN?"],
  "problem.no-bluetooth": ["The robot does not answer by Bluetooth.", "O robô não responde por Bluetooth.",
                           "Der Roboter antwortet nicht über Bluetooth."],
  "advice.no-bluetooth": ["Is it near, and no other phone connected to it by Bluetooth?",
                          "Está perto, sem outro telefone ligado a ele por Bluetooth?",
                          "Ist er nah, und ist kein anderes Telefon über Bluetooth mit ihm verbunden?"],
  "problem.not-a-robot": ["Something answers there, but the robot does not let us in.",
                          "Algo responde, mas o robô não nos deixa entrar.",
                          "Dort antwortet etwas, aber der Roboter lässt uns nicht herein."],
  "advice.not-a-robot": ["Scan the QR code beside the robot again.",
                         "Leia de novo o código QR ao lado do robô.",
                         "Scanne den QR-Code neben dem Roboter noch einmal."],
  "problem.wrong-token": ["The pairing code is not the right one.",
                          "O código de ligação não está certo.",
                          "Der Kopplungscode stimmt nicht."],
  "advice.wrong-token": ["The robot makes a new code at each start. Type the one below its QR code, or scan that again.",
                         "O robô cria um código novo em cada arranque. Escreva o que está por baixo do código QR, ou leia-o outra vez.",
                         "Der Roboter macht bei jedem Start einen neuen. Tippe den unter dem QR-Code, oder scanne ihn noch einmal."],
  "problem.wrong-version": ["This page is of another version than the robot.",
                            "Esta página é de outra versão que não a do robô.",
                            "Diese Seite hat eine andere Version als der Roboter."],
  "advice.wrong-version": ["Reload the page.", "Recarregue a página.", "Lade die Seite neu."],
  "problem.too-many": ["Too many phones are connected.", "Há demasiados telefones ligados.",
                       "Es sind zu viele Telefone verbunden."],
  "advice.too-many": ["A place will be free when another phone leaves.",
                      "Haverá lugar quando outro telefone sair.",
                      "Ein Platz wird frei, wenn ein anderes Telefon geht."],
  "problem.silent": ["The robot has gone quiet.", "O robô deixou de responder.",
                     "Der Roboter ist verstummt."],
  "advice.silent": ["Weak Wi-Fi? Go closer to the access point.",
                    "Wi-Fi fraco? Aproxime-se do ponto de acesso.",
                    "Schwaches WLAN? Geh näher an den Zugangspunkt."],
  "problem.closed": ["The connection was cut.", "A ligação foi interrompida.",
                     "Die Verbindung wurde getrennt."],
  "advice.closed": ["The app comes back as soon as the robot does.",
                    "A aplicação volta assim que o robô voltar.",
                    "Die App ist wieder da, sobald der Roboter es ist."],
  // Who drives.
  "control.mine": ["You drive", "Você conduz", "Du steuerst"],
  "control.free": ["Touch a control to drive", "Toque num comando para conduzir",
                   "Zum Steuern einfach losfahren"],
  "control.other": ["{name} drives", "{name} conduz", "{name} steuert"],
  "control.ask": ["Ask to drive", "Pedir para conduzir", "Um Steuern bitten"],
  "control.asked": ["{name} sees that you would like to drive.", "{name} vê que gostaria de conduzir.",
                    "{name} sieht, dass du steuern möchtest."],
  "control.next": ["{name} is next", "a seguir {name}", "danach {name}"],
  "control.youNext": ["you are next", "a seguir é você", "danach du"],
  "control.withdraw": ["Do not wait", "Não esperar", "Nicht warten"],
  "control.asks": ["{name} would like to drive.", "{name} gostaria de conduzir.", "{name} möchte steuern."],
  "control.handOverTo": ["Hand over to {name}", "Passar a vez a {name}", "An {name} abgeben"],
  "control.release": ["Hand over", "Passar a vez", "Abgeben"],
  "control.taken": ["You drive now.", "Agora é você que conduz.", "Du steuerst jetzt."],
  "control.muted": ["You may only watch", "Só pode ver", "Du darfst nur zusehen"],
  "control.lost": ["{name} drives now.", "Agora conduz {name}.", "Jetzt steuert {name}."],
  // What the robot does.
  "mode.relaxed": ["Relaxed", "Relaxado", "Entspannt"],
  "mode.holding": ["Standing by", "A postos", "Bereit"],
  "mode.playing": ["Playing by itself", "A jogar sozinho", "Spielt von allein"],
  "mode.moving": ["Moving", "Em movimento", "Bewegt sich"],
  "mode.walking": ["Walking", "A andar", "Geht"],
  "mode.acting": ["In action", "Em ação", "In Aktion"],
  "mode.falling": ["Falling", "A cair", "Fällt"],
  "mode.fallen": ["Lying after a fall", "Caído", "Liegt nach einem Sturz"],
  "mode.getting-up": ["Getting up", "A levantar-se", "Steht auf"],
  "mode.no-robot": ["No robot", "Sem robô", "Kein Roboter"],
  "mode.stale": ["Nothing new for {seconds} s", "Sem novidades há {seconds} s", "Seit {seconds} s nichts Neues"],
  "mode.waiting": ["Waiting for the robot", "À espera do robô", "Wartet auf den Roboter"],
  "activity.moveTo": ["to the marked spot", "até ao ponto marcado", "zur markierten Stelle"],
  "activity.joints": ["single joints", "articulações", "einzelne Gelenke"],
  "activity.needsHelp": ["please put it on its feet", "por favor, ponha-o de pé", "bitte stell ihn auf die Füße"],
  "component.motion": ["The robot's motion program does not answer.", "O programa de movimento não responde.",
                  "Das Bewegungsprogramm antwortet nicht."],
  "component.motion.back": ["The robot's motion program is back.", "O programa de movimento está de volta.",
                       "Das Bewegungsprogramm ist wieder da."],
  "component.robot": ["The robot does not answer.", "O robô não responde.", "Der Roboter antwortet nicht."],
  "component.robot.back": ["The robot is back.", "O robô está de volta.", "Der Roboter ist wieder da."],
  "component.camera": ["The head camera sends no pictures.", "A câmara da cabeça não envia imagens.",
                  "Die Kopfkamera schickt keine Bilder."],
  "component.camera.back": ["The head camera is back.", "A câmara da cabeça está de volta.",
                       "Die Kopfkamera ist wieder da."],
  // Refusals that the gateway tells by code.
  "refusal.stopped": ["Stopped: let go of the pad, then walk on.", "Parado: solte o comando e depois continue.",
                      "Gestoppt: erst loslassen, dann weitergehen."],
  // Controller.
  "drive.stop": ["Stop", "Parar", "Stopp"],
  "drive.walk": ["Walk", "Andar", "Gehen"],
  "drive.turn": ["Turn", "Virar", "Drehen"],
  "drive.postures": ["Postures", "Posturas", "Haltungen"],
  "drive.actions": ["Actions", "Ações", "Aktionen"],
  "drive.image": ["Picture from the robot's head", "Imagem da cabeça do robô",
                    "Bild aus dem Kopf des Roboters"],
  "drive.imageWaiting": ["No picture yet", "Ainda sem imagem", "Noch kein Bild"],
  "drive.enlarge": ["Camera large, robot small", "Câmara grande, robô pequeno", "Kamera groß, Roboter klein"],
  "drive.shrink": ["Robot large, camera small", "Robô grande, câmara pequena", "Roboter groß, Kamera klein"],
  "drive.camera": ["Other camera", "Outra câmara", "Andere Kamera"],
  "drive.link": ["Delay {latency} ms, picture {image} ms old",
                 "Atraso {latency} ms, imagem com {image} ms",
                 "Verzögerung {latency} ms, Bild {image} ms alt"],
  "drive.imageAge": ["{seconds} s old", "há {seconds} s", "{seconds} s alt"],
  "drive.stage": ["The robot, seen from outside. Drag to look around.",
                  "O robô visto de fora. Arraste para rodar a vista.",
                  "Der Roboter von außen. Ziehen, um herumzuschauen."],
  "drive.leave": ["Disconnect", "Desligar", "Trennen"],
  "drive.linkPoor": ["The link is slow: drive gently.", "Ligação lenta: conduza devagar.",
                     "Die Verbindung ist langsam: fahr behutsam."],
  "drive.joints": ["Joints", "Juntas", "Gelenke"],
  "drive.drive": ["Drive", "Conduzir", "Steuern"],
  "drive.more": ["More", "Mais", "Mehr"],
  "drive.less": ["Less", "Menos", "Weniger"],
  "drive.speak": ["Speak", "Falar", "Sprechen"],
  "drive.stopKey": ["Space", "Espaço", "Leertaste"],
  "hint.walk": ["Stop ends everything, always. Hold “Walk” and push: the robot walks; let go, and it stands.",
                "Parar termina tudo, sempre. Segure “Andar” e empurre: o robô anda; solte, e ele para.",
                "Stopp beendet alles, immer. „Gehen“ halten und schieben: der Roboter geht; loslassen, und er steht."],
  "hint.keys": ["Space stops everything, always. W A S D walk, Q E turn; let go, and the robot stands.",
                "Espaço para tudo, sempre. W A S D andam, Q E viram; solte, e o robô para.",
                "Die Leertaste stoppt alles, immer. W A S D gehen, Q E drehen; loslassen, und der Roboter steht."],
  "drive.menu": ["Menu", "Menu", "Menü"],
  "drive.walkHere": ["Walk here", "Andar até aqui", "Hierher gehen"],
  "drive.holdTilt": ["Hold and tilt", "Segure e incline", "Halten und neigen"],
  "drive.released": ["The stick was released for this. Touch it again to walk.",
                     "O comando foi solto para isto. Toque-o de novo para andar.",
                     "Der Stick wurde dafür losgelassen. Zum Gehen neu anfassen."],
  "drive.linkLost": ["Stopped by the link: nothing new comes from the robot.",
                     "Parado pela ligação: nada de novo chega do robô.",
                     "Von der Verbindung gestoppt: Vom Roboter kommt nichts Neues."],
  "pad.silent": ["The gamepad sends nothing new: is it out of range? Move its stick to drive on.",
                 "O gamepad não envia nada de novo: está fora de alcance? Mova o manípulo para continuar.",
                 "Das Gamepad sendet nichts Neues: außer Reichweite? Zum Weiterfahren den Stick bewegen."],
  "pad.unknown": ["The browser does not know the layout of this gamepad, so it cannot drive: {name}",
                  "O navegador não conhece a disposição deste gamepad, por isso não conduz: {name}",
                  "Der Browser kennt die Belegung dieses Gamepads nicht, es kann nicht steuern: {name}"],
  "drive.progress": ["Progress", "Progresso", "Fortschritt"],
  "fall.calm": ["The robot fell. It gets up by itself.", "O robô caiu. Levanta-se sozinho.",
                "Der Roboter ist gefallen. Er steht von selbst auf."],
  // Joints mode.
  "joints.choose": ["Tap a ball on the robot", "Toque numa esfera no robô",
                    "Tippe auf eine Kugel am Roboter"],
  "joints.groups": ["Joints", "Articulações", "Gelenke"],
  "joints.pad": ["Turn the joint", "Rodar a articulação", "Gelenk drehen"],
  "joints.move": ["Move", "Mover", "Bewegen"],
  "joints.roll": ["Roll", "Rolamento", "Rollen"],
  "joints.yaw": ["Yaw", "Guinada", "Gieren"],
  "joints.pitch": ["Pitch", "Inclinação", "Nicken"],
  "joints.opening": ["Open", "Aberta", "Offen"],
  "joints.both": ["Both sides", "Ambos os lados", "Beide Seiten"],
  "joints.reset": ["Reset pose", "Repor pose", "Grund\u00adhaltung"],
  "joints.limit": ["End of its range", "Fim do curso", "Anschlag"],
  // Menu.
  "menu.title": ["Settings and help", "Definições e ajuda", "Einstellungen und Hilfe"],
  "menu.close": ["Close", "Fechar", "Schließen"],
  "menu.tilt": ["Walk by tilting the phone", "Andar inclinando o telefone",
                "Gehen durch Neigen des Telefons"],
  "menu.tiltHelp": ["Hold the walk pad and tilt: away from you to walk, sideways to turn.",
                    "Segure o comando e incline: para a frente anda, para o lado vira.",
                    "Das Geh-Feld halten und neigen: nach vorn gehen, zur Seite drehen."],
  "menu.tiltMissing": ["Needs https: only secure pages get the sensors, and keep the screen on.",
                       "Precisa de https: só páginas seguras recebem os sensores e mantêm o ecrã ligado.",
                       "Braucht https: Nur sichere Seiten bekommen die Sensoren und halten den Bildschirm an."],
  "menu.tiltRefused": ["The phone gives this page no motion sensors. Close all its tabs, allow motion in the browser's " +
                       "settings of this page, and open it again.",
                       "O telefone não dá sensores de movimento a esta página. Feche os separadores dela, permita o " +
                       "movimento nas definições do navegador para esta página e abra-a de novo.",
                       "Das Telefon gibt dieser Seite keine Bewegungssensoren. Schließe ihre Tabs, erlaube Bewegung in den " +
                       "Einstellungen des Browsers für diese Seite, und öffne sie neu."],
  "menu.swap": ["Swap the two pads", "Trocar os dois comandos", "Beide Felder tauschen"],
  "menu.language": ["Language", "Idioma", "Sprache"],
  "menu.help": ["How it works", "Como funciona", "So geht es"],
  "menu.helpWalk": ["Left pad walks, right pad turns; let go and the robot stands.",
                    "O comando esquerdo anda, o direito vira; ao soltar, o robô para.",
                    "Linkes Feld geht, rechtes dreht; loslassen, und der Roboter steht."],
  "menu.helpView": ["Drag the robot to look around, pinch to come nearer, double tap to go back.",
                    "Arraste para rodar a vista, aperte para aproximar, toque duas vezes para repor.",
                    "Ziehen schaut herum, zwei Finger holen näher, Doppeltippen stellt zurück."],
  "menu.helpImage": ["Tap the small picture and the two change places; drag on the camera's to turn the head.",
                       "Toque na imagem pequena para as trocar; arraste na da câmara para virar a cabeça.",
                       "Das kleine Bild antippen tauscht beide; auf dem der Kamera ziehen dreht den Kopf."],
  "menu.helpGround": ["Tap the ground to send the robot there, its arm or head to move that.",
                      "Toque no chão para o robô andar até lá, num braço ou na cabeça para os mover.",
                      "Auf den Boden tippen schickt den Roboter dorthin, auf Arm oder Kopf bewegt diese."],
  "menu.helpKeys": ["Keyboard: W A S D walk, Q E or arrows turn, Shift slowly, space stops, 1 2 kick, R ready, C crouch, L joints, " +
                    "comma and point choose one.",
                    "Teclado: W A S D anda, Q E ou setas viram, Shift devagar, espaço para, 1 2 chutam, R pronto, C agacha, " +
                    "L juntas, vírgula e ponto escolhem uma.",
                    "Tastatur: W A S D geht, Q E oder Pfeile drehen, Umschalt langsam, Leertaste stoppt, 1 2 schießen, R startklar, " +
                    "C hockt, L Gelenke, Komma und Punkt wählen eines."],
  "menu.helpPad": ["Gamepad: sticks walk and turn, A ready, B stop, X crouch, Y stand, shoulders kick.",
                   "Gamepad: manípulos andam e viram, A pronto, B parar, X agachar, Y de pé, L/R chutam.",
                   "Gamepad: Sticks gehen und drehen, A startklar, B Stopp, X hocken, Y stehen, Schultertasten schießen."],
  ...kSpeechTexts,
  "result.failed": ["That did not work.", "Não resultou.", "Das hat nicht geklappt."],
} as const satisfies Record<string, Row>;

export type TextKey = keyof typeof kTexts;

/** Language of the page; the phone's own if the app speaks it, else English. */
let language: Language = "en";

export function setLanguage(value: Language): void {
  language = value;
}

export function getLanguage(): Language {
  return language;
}

/** The first of the preferred languages ("pt-BR", "de") that the app speaks. */
export function chooseLanguage(preferred: readonly string[]): Language {
  for (const tag of preferred) {
    const found = kLanguages.find((known) => tag.toLowerCase().split("-")[0] === known);
    if (found) return found;
  }
  return "en";
}

/** What to say, in the page's language. */
export function say(key: TextKey, values: Record<string, string | number> = {}): string {
  const text: string = kTexts[key][kLanguages.indexOf(language)] ?? kTexts[key][0];
  return text.replace(/\{(\w+)\}/g, (place, name: string) => String(values[name] ?? place));
}

/** True for the key of a row. */
export function isText(key: string): key is TextKey {
  return key in kTexts;
}

/** What the connected robot calls its postures, actions, joint groups, cameras and lights: by "posture.Crouch",
 * then by language. */
let labels: ReadonlyMap<string, ReadonlyMap<string, string>> = new Map();

/** @param list  RobotDescription.labels of the connected robot. */
export function setLabels(list: readonly {kind: string; name: string; language: string; text: string}[]): void {
  const all = new Map<string, Map<string, string>>();
  for (const {kind, name, language: tag, text} of list) {
    const key = `${kind}.${name}`;
    all.set(key, (all.get(key) ?? new Map<string, string>()).set(tag, text));
  }
  labels = all;
}

/** A name from the robot ("posture", "Crouch") as a person says it; unknown names as they are. */
export function sayName(family: "posture" | "action" | "group" | "camera" | "light", name: string): string {
  const known = labels.get(`${family}.${name}`);
  return known?.get(language) ?? known?.get("en") ?? name.replace(/[-_]/g, " ");
}

/** For tests: every row. */
export const kAllTexts: Readonly<Record<string, Row>> = kTexts;
