// nao-referee: referee of simulated matches. See README.md.
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/command_line.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/program.h"
#include "common/robot_option.h"
#include "daemons/referee/referee_daemon.h"

int main(int argc, char** argv) {
  nao::CommandLine app("Referees a match of simulated robots: kick-off, goals, time, penalties",
                       "nao-referee");
  nao::CommonOptions common;
  nao::referee::RefereeOptions options;
  nao::add_bus_options(app, common);
  std::vector<std::string> robots;
  std::string model = "nao";
  bool follows_game_controller = false;
  uint16_t game_controller_port = nao::referee::kGameControllerPort;
  std::vector<int> team_numbers;
  std::string state_file;
  std::string events_file;
  nao::add_robot_option(app, robots);
  app.add_option("--model", model, "Folder of robots/ that describes robots without a model");
  app.add_option("--scene", options.scene, "Scene with field, goals and ball");
  app.add_option("--half-duration", options.rules.half_duration, "Duration of a half, s")
      ->range(10.0, 3600.0);
  app.add_flag("--start", options.starts_by_itself,
               "Begin when all robots are there, without nao match start");
  app.add_flag("--game-controller", follows_game_controller,
               "The RoboCup GameController decides instead of nao-referee's own rules, which then "
               "only puts ball and robots in their places");
  app.add_option("--game-controller-port", game_controller_port,
                 "UDP port of the GameController's messages; 0: any free");
  app.add_option("--game-controller-return-port", options.return_port,
                 "UDP port at which the GameController receives the robots' messages");
  app.add_option("--team-numbers", team_numbers,
                 "The GameController's numbers of team 0 and team 1; messages about others are "
                 "ignored (default: of any two teams, in the order of the first message)")
      ->count(2);
  app.add_option("--state-file", state_file,
                 "File to save the match, from which another referee can continue (default: none)");
  app.add_option("--events-file", events_file,
                 "File to which every event is added, a line of JSON each (default: none)");
  return nao::run_program(app, common, argc, argv, [&] {
    options.robots = nao::parse_robot_options(robots, model);
    if (follows_game_controller) options.game_controller_port = game_controller_port;
    if (!team_numbers.empty()) options.team_numbers = {{team_numbers[0], team_numbers[1]}};
    options.state_file = state_file;
    options.events_file = events_file;
    nao::EventLoop loop;
    nao::Bus bus(common.lcm_url);
    nao::logger::info("version {}, bus {}, {} robots, scene {}", nao::version(), common.lcm_url,
                      options.robots.size(), options.scene);
    nao::referee::RefereeDaemon daemon(bus, options);
    daemon.attach(loop);
    const std::string reason = loop.run();
    nao::logger::info("{}: {} messages in, {} out, {} dropped", reason, bus.counters().num_in,
                      bus.counters().num_out, bus.counters().num_dropped);
  });
}
