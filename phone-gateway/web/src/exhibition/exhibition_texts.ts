/** Words of an exhibition: of its visitors' phones, the big display and the operator's page. */
import {getLanguage, kLanguages} from "../text/texts";
import type {Row} from "../text/texts";

export const kExhibitionTexts = {
  // The visitor's phone.
  "you": ["You are {name}", "O seu nome é {name}", "Du bist {name}"],
  "next": ["You are next", "É a seguir", "Du bist als Nächstes dran"],
  "place": ["{place} in the queue", "{place}.º na fila", "Platz {place} in der Reihe"],
  "soon": ["in less than a minute", "em menos de um minuto", "in weniger als einer Minute"],
  "minutes": ["in about {minutes} min", "em cerca de {minutes} min", "in etwa {minutes} min"],
  "keep": ["Keep this page open. Your place stays yours if the phone is away for a short time.",
           "Mantenha esta página aberta. O lugar continua seu se o telefone falhar por pouco tempo.",
           "Lass diese Seite offen. Dein Platz bleibt dir, auch wenn das Telefon kurz weg ist."],
  "drives": ["{name} drives", "{name} conduz", "{name} steuert"],
  "leave": ["Leave the queue", "Sair da fila", "Reihe verlassen"],
  "end": ["End my turn", "Terminar a vez", "Fertig"],
  "join": ["Stand in the queue", "Entrar na fila", "In die Reihe stellen"],
  "left": ["You are not in the queue.", "Não está na fila.", "Du stehst nicht in der Reihe."],
  "go": ["Your turn: drive!", "É a sua vez: conduza!", "Du bist dran: fahr los!"],
  "warned": ["{time} left", "faltam {time}", "noch {time}"],
  "thanks": ["Thank you for driving!", "Obrigado por conduzir!", "Danke fürs Fahren!"],
  "again": ["Once more", "Outra vez", "Noch einmal"],
  "full": ["The queue is full. Try again in some minutes.", "A fila está cheia. Tente daqui a uns minutos.",
           "Die Reihe ist voll. Versuch es in einigen Minuten wieder."],
  "paused": ["A short pause", "Uma pausa curta", "Kurze Pause"],
  "away": ["The robot is away for a moment", "O robô não está por um momento", "Der Roboter ist kurz nicht da"],
  "resting": ["The robot rests", "O robô descansa", "Der Roboter ruht sich aus"],
  // The big display.
  "scan": ["Scan and drive", "Leia e conduza", "Scannen und steuern"],
  "free": ["Who drives next?", "Quem conduz a seguir?", "Wer fährt als Nächstes?"],
  "queue": ["Next", "A seguir", "Als Nächste"],
  "nobody": ["Nobody waits: it is your turn.", "Ninguém espera: é a sua vez.", "Niemand wartet: du bist dran."],
  "more": ["and {number} more", "e mais {number}", "und {number} weitere"],
  "challenge": ["Walk through the gate", "Passe pelo portão", "Geh durch das Tor"],
  "goal": ["Kick the ball into the goal", "Chute a bola para a baliza", "Schieß den Ball ins Tor"],
  "time": ["{time} s", "{time} s", "{time} s"],
  "best": ["Best today: {time} s, {name}", "O melhor de hoje: {time} s, {name}", "Beste Zeit heute: {time} s, {name}"],
  "turns": ["Turns until now: {number}", "Vezes até agora: {number}", "Fahrten bisher: {number}"],
  "waiting": ["Waiting: {number}", "À espera: {number}", "In der Reihe: {number}"],
  "noLink": ["The robot's host does not answer.", "O computador do robô não responde.",
             "Der Rechner des Roboters antwortet nicht."],
  // The operator's page.
  "operator": ["Exhibition", "Exposição", "Ausstellung"],
  "secret": ["Open the operator's address that scripts/start has printed.",
             "Abra o endereço do operador que scripts/start mostrou.",
             "Öffne die Adresse für den Bediener, die scripts/start gezeigt hat."],
  "pause": ["Pause", "Pausa", "Pause"],
  "resume": ["Go on", "Continuar", "Weiter"],
  "skip": ["End this turn", "Terminar esta vez", "Fahrt beenden"],
  "moreTime": ["30 s more", "Mais 30 s", "30 s mehr"],
  "rest": ["Rest the robot", "Descansar o robô", "Roboter ausruhen"],
  "wake": ["Wake the robot", "Acordar o robô", "Roboter wecken"],
  "stop": ["Stop", "Parar", "Stopp"],
  "kicks": ["Kicks", "Chutos", "Schüsse"],
  "falls": ["Blocks and dives", "Defesas e mergulhos", "Blocks und Hechte"],
  "allowed": ["allowed", "permitidos", "erlaubt"],
  "forbidden": ["forbidden", "proibidos", "verboten"],
  "speed": ["Speed", "Velocidade", "Tempo"],
  "volume": ["Volume", "Volume", "Lautstärke"],
  "lights": ["Lights", "Luzes", "Lichter"],
} as const satisfies Record<string, Row>;

export type ExhibitionKey = keyof typeof kExhibitionTexts;

/** What to say, in the page's language. */
export function tell(key: ExhibitionKey, values: Record<string, string | number> = {}): string {
  const text: string = kExhibitionTexts[key][kLanguages.indexOf(getLanguage())] ?? kExhibitionTexts[key][0];
  return text.replace(/\{(\w+)\}/g, (place, name: string) => String(values[name] ?? place));
}
