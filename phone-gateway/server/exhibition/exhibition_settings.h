#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "phone-gateway/server/exhibition/challenge.h"
#include "phone-gateway/server/exhibition/visitor_queue.h"

namespace nao::gateway {

/** Settings of an exhibition; data/exhibition/example.yaml describes every key. */
struct ExhibitionSettings {
  TurnRules rules;
  /** Fraction of the robot's highest velocities, (0, 1]. */
  double speed = 0.7;
  /** Names and kinds of actions that visitors may not command. */
  std::vector<std::string> forbidden;
  bool may_speak = false;
  bool may_play = false;
  /** Empty: none. In the field's frame (true), or where the robot's odometry began. */
  std::vector<Eigen::Vector2d> fence;
  bool is_fence_on_field = false;
  ChallengeSettings challenge;
  /** Between what the robot does while nobody is there, s; 0: nothing. */
  double attract_period = 0;
  std::vector<std::string> attract_actions;
  bool attracts_with_motions = false;
  bool looks_at_ball = false;
  /** Spoken in turn, by BCP 47 tag. */
  std::vector<std::pair<std::string, std::string>> greetings;
  /** Language of the big display and the operator's page: "en", "pt", "de" or "ar". */
  std::string language = "en";
  std::vector<std::string> nicknames;
};

/** @param name       Of the text, for errors.
 * @param nicknames  Of visitors.
 * @throws ConfigError  with file, line and key. */
ExhibitionSettings parse_exhibition(const std::string& text, const std::string& name,
                                    std::vector<std::string> nicknames);

/** Reads the file, and the nicknames of the data folder. @throws ConfigError */
ExhibitionSettings load_exhibition(const std::filesystem::path& file,
                                   const std::filesystem::path& data);

}  // namespace nao::gateway
