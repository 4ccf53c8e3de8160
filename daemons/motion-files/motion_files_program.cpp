#include "daemons/motion-files/motion_files_program.h"

#include <sys/resource.h>

#include <memory>
#include <string>

#include "common/bus.h"
#include "common/command_line.h"
#include "common/data_path.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/program.h"
#include "daemons/motion-files/motion_files_daemon.h"
#include "robot_model/robot_model.h"

namespace {

// Niceness: simulating a motion must not delay the robot's other programs.
constexpr int kNiceness = 10;

}  // namespace

int nao::motion_files::run_motion_files(int argc, char** argv) {
  nao::CommandLine app(
      "Keeps the motions that people teach: checks them in a simulation, saves, lists and deletes "
      "them.",
      "nao-motion-files");
  nao::CommonOptions common;
  nao::add_common_options(app, common);
  std::string model_name = "nao";
  std::string folder;
  nao::add_model_option(app, model_name);
  app.add_option("--folder", folder,
                 "Folder of the motions; default: ~/.local/state/nao-remote/motions");
  return nao::run_program(app, common, argc, argv, [&] {
    setpriority(PRIO_PROCESS, 0, kNiceness);
    if (folder.empty()) folder = (nao::state_path() / "motions").string();
    const auto model = std::make_shared<const nao::RobotModel>(nao::RobotModel::find(model_name));
    nao::ClosedLoopOptions options;
    options.model = model;
    options.scene = nao::SceneFile::find("empty");
    nao::EventLoop loop;
    nao::Bus bus(common.lcm_url);
    const nao::motion_files::MotionFilesDaemon daemon(bus, loop, *model, options, folder,
                                                      common.robot);
    nao::logger::info("version {}, bus {}, channels {}_*, model {}, {} motions in {}",
                      nao::version(), common.lcm_url, common.robot, model->folder().string(),
                      daemon.core().store().names().size(), folder);
    const std::string reason = loop.run();
    nao::logger::info("stopped by {}; {} messages in, {} out, {} dropped", reason,
                      bus.counters().num_in, bus.counters().num_out, bus.counters().num_dropped);
  });
}
