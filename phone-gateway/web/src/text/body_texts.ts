/** Texts about the condition of the robot's body; the warnings' keys are "body." and the gateway's codes (PROTOCOL.md). */
import type {Row} from "./texts";

export const kBodyTexts = {
  "body.title": ["The robot's condition", "Estado do robô", "Zustand des Roboters"],
  "body.battery": ["Battery {percent} %", "Bateria {percent} %", "Akku {percent} %"],
  "body.charging": ["Battery {percent} %, charging", "Bateria {percent} %, a carregar", "Akku {percent} %, lädt"],
  "body.hottest": ["Hottest motor: {joint}, {temperature} °C", "Motor mais quente: {joint}, {temperature} °C",
                   "Wärmster Motor: {joint}, {temperature} °C"],
  "body.fine": ["No warnings.", "Sem avisos.", "Keine Warnungen."],
  "body.unknown": ["Nothing is known of it, as of a simulated robot's.", "Nada se sabe dele, como num robô simulado.",
                   "Darüber ist nichts bekannt, wie bei einem simulierten Roboter."],
  "body.battery-low": ["The battery is low: charge the robot.", "A bateria está fraca: carregue o robô.",
                       "Der Akku ist fast leer: lade den Roboter."],
  "body.battery-hot": ["The battery is hot: let it rest.", "A bateria está quente: deixe-a descansar.",
                       "Der Akku ist heiß: gönn ihm eine Pause."],
  "body.joint-hot": ["A motor is hot ({joints}): let the robot sit.", "Um motor está quente ({joints}): sente o robô.",
                     "Ein Motor ist heiß ({joints}): lass den Roboter sitzen."],
  "body.joint-dead": ["A motor does not answer ({joints}).", "Um motor não responde ({joints}).",
                      "Ein Motor antwortet nicht ({joints})."],
  "body.sensor-dead": ["A sensor does not answer.", "Um sensor não responde.", "Ein Sensor antwortet nicht."],
} as const satisfies Record<string, Row>;
