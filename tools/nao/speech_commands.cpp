#include <memory>
#include <string>
#include <vector>

#include "common/command_line.h"
#include "common/error.h"
#include "common/joined.h"
#include "messages/light_command.h"
#include "messages/speech_command.h"
#include "tools/nao/color_argument.h"
#include "tools/nao/conversation.h"
#include "tools/nao/subcommand.h"

namespace nao {
namespace {

using Operation = SpeechCommand::Operation;

void add_say(CommandLine& app, Invocation& invocation) {
  struct Options {
    SpeechCommand command;
    std::vector<std::string> words;
    bool follows = false;
    bool stops = false;
    WaitOptions wait;
  };
  auto options = std::make_shared<Options>();
  CommandLine* say = app.add_subcommand("say", "Speak a text; wait until it is spoken");
  say->add_option("text", options->words, "Text, at most 1000 bytes");
  say->add_option("--language", options->command.language,
                  "Language, such as de (default: nao-speaker's)");
  say->add_option("--volume", options->command.volume, "Loudness, 0 to 1");
  say->add_option("--rate", options->command.rate, "Speed relative to normal, 0.5 to 2");
  say->add_flag("--after", options->follows,
                "Speak it after what is being said, instead of replacing that");
  say->add_flag("--stop", options->stops, "End what is being said, and what waits");
  add_wait_options(*say, options->wait);
  say->on_parsed([&invocation, options] {
    if (options->words.empty() != options->stops) {
      throw UsageError("text", "give either a text or --stop");
    }
    options->command.text = joined(options->words, {}, " ");
    options->command.operation = options->stops     ? Operation::kStop
                                 : options->follows ? Operation::kSayAfter
                                                    : Operation::kSay;
    invocation.run = [&invocation, options] {
      Conversation conversation(invocation.common, "say", "nao-speaker");
      return conversation.run_command(conversation.channels().speech_command,
                                      to_message(options->command), options->wait);
    };
  });
}

void add_light(CommandLine& app, Invocation& invocation) {
  struct Options {
    std::vector<std::string> words;
    LightCommand command;
    WaitOptions wait;
  };
  auto options = std::make_shared<Options>();
  CommandLine* light =
      app.add_subcommand("light", "Set lights: \"left-eye right-eye red\", \"chest #ff8000\"");
  light
      ->add_option("lights", options->words,
                   "Names of lights, as in robots/nao/lights.yaml, and a color: red, green, blue, "
                   "..., off or such as #ff8000")
      ->required()
      ->count(2, 100);
  light
      ->add_option(
          "--for", options->command.duration,
          "Time, s, after which they show what they showed before (default: until replaced)")
      ->positive();
  add_wait_options(*light, options->wait);
  light->on_parsed([&invocation, options] {
    LightCommand& command = options->command;
    LightColor color;
    try {
      color = parse_color(options->words.back());
    } catch (const ConfigError& error) {
      throw UsageError("lights", error.what());
    }
    command.light_names.assign(options->words.begin(), options->words.end() - 1);
    command.light_rgb.assign(command.light_names.size(), color);
    invocation.run = [&invocation, options] {
      Conversation conversation(invocation.common, "light", "the robot");
      return conversation.run_command(conversation.channels().light_command,
                                      to_message(options->command), options->wait);
    };
  });
}

}  // namespace

void add_speech_commands(CommandLine& app, Invocation& invocation) {
  add_say(app, invocation);
  add_light(app, invocation);
}

}  // namespace nao
