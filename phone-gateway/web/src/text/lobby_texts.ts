/** Words of the list of robots, where there are several. */
export const kLobbyTexts = {
  "lobby.title": ["Choose a robot", "Escolha um robô", "Wähle einen Roboter"],
  "lobby.subtitle": ["Drive one that is free, or watch any.", "Conduza um que esteja livre, ou veja qualquer um.",
                     "Steuere einen freien oder sieh einem zu."],
  "lobby.free": ["Free", "Livre", "Frei"],
  "lobby.absent": ["Does not answer", "Não responde", "Antwortet nicht"],
  "lobby.drive": ["Drive", "Conduzir", "Steuern"],
  "lobby.watch": ["Watch", "Ver", "Zusehen"],
  "lobby.driveNamed": ["Drive {name}", "Conduzir {name}", "{name} steuern"],
  "lobby.watchNamed": ["Watch {name}", "Ver {name}", "{name} zusehen"],
  "lobby.team0": ["Blue team", "Equipa azul", "Blaues Team"],
  "lobby.team1": ["Red team", "Equipa vermelha", "Rotes Team"],
  "lobby.number": ["number {number}", "número {number}", "Nummer {number}"],
  "lobby.open": ["Change robot", "Mudar de robô", "Roboter wechseln"],
  "lobby.changed": ["You see {name} now.", "Agora vê {name}.", "Du siehst jetzt {name}."],
} as const;
