#include <functional>
#include <map>
#include <string>
#include <utility>

#include "inspection/foxglove_converter.h"
#include "inspection/foxglove_schemas.h"
#include "inspection/message_json.h"
#include "robot_model/robot_model.h"
#include "tools/nao-tools/log_input.h"
#include "tools/nao-tools/mcap_writer.h"

namespace nao {
namespace {

/** Channels of an MCAP file, which begin at their first message. */
class McapChannels {
 public:
  explicit McapChannels(McapWriter& mcap) : mcap_(mcap) {}

  /** @param schema  Makes the JSON Schema, where the file does not have it yet. */
  uint16_t find(const std::string& topic, const std::string& schema_name,
                const std::function<std::string()>& schema) {
    // A channel whose type changed during the recording becomes two channels of the file.
    const auto [channel, is_new] = channels_.try_emplace({topic, schema_name});
    if (is_new) {
      const auto [number, is_new_schema] = schemas_.try_emplace(schema_name);
      if (is_new_schema) number->second = mcap_.add_schema(schema_name, schema());
      channel->second = mcap_.add_channel(topic, number->second);
    }
    return channel->second;
  }

 private:
  McapWriter& mcap_;
  std::map<std::string, uint16_t> schemas_;
  std::map<std::pair<std::string, std::string>, uint16_t> channels_;
};

}  // namespace

Undecodable convert_to_mcap(LogInput& log, const ChannelPattern& selected, const std::string& file,
                            const std::string& model, const std::string& robot) {
  const RobotModel robot_model = RobotModel::find(model);
  FoxgloveConverter converter(robot_model, robot);
  McapWriter mcap(file);
  McapChannels channels(mcap);
  const auto write = [&](const LogEvent& event, const MessageLayout& layout,
                         const std::string& message) {
    const uint16_t channel = channels.find(event.channel, "naolcm." + layout.name,
                                           [&] { return json_schema_of(layout); });
    mcap.add_message(channel, event.wall_utime, message);
    converter.convert(
        event.channel, event.data, [](size_t) { return true; },
        [&](size_t output, const std::string& json) {
          const FoxgloveConverter::Output& known = converter.outputs()[output];
          mcap.add_message(channels.find(known.topic, known.schema,
                                         [&] { return foxglove_schema(known.schema); }),
                           event.wall_utime, json);
        });
  };
  Undecodable undecodable = read_as_json(log, selected, write);
  mcap.finish();
  return undecodable;
}

}  // namespace nao
