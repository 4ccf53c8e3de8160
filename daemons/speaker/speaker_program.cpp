#include "daemons/speaker/speaker_program.h"

#include "common/bus.h"
#include "common/command_line.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/program.h"
#include "daemons/speaker/audio_output.h"
#include "daemons/speaker/espeak_synthesizer.h"
#include "daemons/speaker/isolated_synthesizer.h"
#include "daemons/speaker/speaker_daemon.h"
#include "robot_model/robot_lights.h"
#include "robot_model/robot_model.h"

int nao::speaker::run_speaker(int argc, char** argv) {
  nao::CommandLine app("Speaks texts: on this host's loudspeaker, and on phones that ask for it",
                       "nao-speaker");
  nao::CommonOptions common;
  nao::speaker::SpeakerOptions options;
  nao::add_common_options(app, common);
  std::string model_name = "nao";
  std::string output = "auto";
  nao::add_model_option(app, model_name);
  app.add_option("--output", output,
                 "Sound on this host: none, alsa, alsa:DEVICE, or auto: ALSA's default device if "
                 "there is one");
  app.add_option("--language", options.language, "Language of texts that state none, such as de")
      ->check([](const std::string& tag) {
        return nao::find_speech_language(tag).empty() ? "'" + tag + "' cannot be spoken"
                                                      : std::string();
      });
  return nao::run_program(app, common, argc, argv, [&] {
    options.robot = common.robot;
    options.language = nao::find_speech_language(options.language);
    const auto model = nao::RobotModel::find(model_name);
    for (const nao::RobotLight& light : nao::load_robot_lights(model)) {
      if (light.is_eye) options.eyes.push_back(light.name);
    }
    nao::EventLoop loop;
    nao::speaker::EspeakSynthesizer espeak;
    nao::speaker::IsolatedSynthesizer synthesizer(espeak);
    auto audio_output = nao::speaker::make_audio_output(output);
    nao::Bus bus(common.lcm_url);
    nao::logger::info("version {}, bus {}, robot {}, sound on this host: {}", nao::version(),
                      common.lcm_url, options.robot, audio_output ? output : "none");
    nao::speaker::SpeakerDaemon daemon(bus, synthesizer, std::move(audio_output), options);
    daemon.attach(loop);
    const std::string reason = loop.run();
    nao::logger::info("{}: {} texts spoken, {} messages in, {} out, {} dropped", reason,
                      daemon.num_spoken(), bus.counters().num_in, bus.counters().num_out,
                      bus.counters().num_dropped);
  });
}
