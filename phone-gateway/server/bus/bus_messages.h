#pragma once

#include <cstdint>
#include <deque>
#include <naolcm/body_state_t.hpp>
#include <naolcm/command_result_t.hpp>
#include <naolcm/image_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/play_state_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <naolcm/speech_audio_t.hpp>
#include <naolcm/vision_state_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "messages/command.h"
#include "messages/match_state.h"
#include "phone-gateway/server/core/image_cache.h"
#include "phone-gateway/server/core/robot_mirror.h"
#include "phone-gateway/server/core/robots.h"
#include "phone-gateway/server/core/streams.h"

namespace nao::gateway {

/** Converts robot_state_t to the state that clients receive, with the joints in the order of the
 * robot's description. */
class RobotStateReader {
 public:
  explicit RobotStateReader(const naoremote::RobotDescription& robot);

  /** @throws MessageError  if a joint is unknown, repeated or missing, the lists have unequal
   * lengths, or a number is not finite. */
  RobotSnapshot read(const naolcm::robot_state_t& message) const;

 private:
  std::vector<std::string> joint_names_;
};

/** @throws MessageError  if a number that must be finite is not, or an enumeration has an unknown
 * value.
 */
MotionSnapshot read_motion_state(const naolcm::motion_state_t& message);

/** @throws MessageError  if the image is no JPEG or has no size. */
CachedImage read_image(const naolcm::image_t& message);

/** Colors of body_state_t as 0xRRGGBB, in the order of the robot's description; a light that the
 * message does not have is black. @throws MessageError  if a color is not in range. */
std::vector<uint32_t> read_lights(const naolcm::body_state_t& message,
                                  const naoremote::RobotDescription& robot);

/** Condition of the robot's body; none if the message has none. Joints that the description does
 * not have are left out. */
std::optional<naoremote::Body> read_body(const naolcm::body_state_t& message,
                                         const naoremote::RobotDescription& robot);

/** @throws MessageError  if the samples are too many or of another format. */
SpeechPiece read_audio(const naolcm::speech_audio_t& message);

/** Size of the images that nao-vision has analysed: of several of one camera and time the widest.
 */
class ImageSizes {
 public:
  struct Size {
    double width = 640;
    double height = 480;
  };

  void add(const naolcm::image_t& image);
  /** @return The size of the image of this camera and time; if it was not received, of that
   * camera's last one, or the usual one. */
  Size find(const std::string& camera, int64_t utime) const;

 private:
  struct Entry {
    std::string camera;
    int64_t utime = 0;
    Size size;
  };
  /** Oldest first. */
  std::deque<Entry> entries_;
};

/** Boxes and lines become fractions of the image's size.
 * @throws MessageError  if a number that must be finite is not, or an enumeration has an unknown
 * value. */
naoremote::Vision read_vision(const naolcm::vision_state_t& message, const ImageSizes& sizes);

/** @throws MessageError  if an enumeration has an unknown value. */
naoremote::PlayState read_play_state(const naolcm::play_state_t& message);

/** Teams and numbers of the players. */
std::vector<PlayerLabel> read_players(const MatchState& state);

/** A match as clients see it, with whole seconds. */
naoremote::Match read_match(const MatchState& state);

/** @throws MessageError  if the kind or the status has an unknown value. */
CommandResult read_result(const naolcm::command_result_t& message);

}  // namespace nao::gateway
