#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nao::playback {

/** Where the robot truly was at one time. */
struct CourseRow {
  /** Robot time, s. */
  double time = 0;
  /** Torso in the world: m, m, rad (continuous), m. */
  double x = 0;
  double y = 0;
  double heading = 0;
  double height = 0;
  /** Mode in NAO_MOTION_STATE. */
  std::string mode;
};

/** The behavior of a robot at the resolution that a person would notice. */
struct Course {
  /** Twice a second. */
  std::vector<CourseRow> rows;
  /** Result of each command other than walk commands, in order: "posture done". */
  std::vector<std::string> results;
  /** Over all joint commands, bit by bit; not part of the file, for it differs with every change.
   */
  std::size_t fingerprint = 0;
};

/** Text that read_course() reads. */
std::string to_text(const Course& course);

/** @throws Error  if the file is not a course. */
Course read_course(const std::filesystem::path& file);

/** Finds where a course differs from the expected one by more than a slightly better or worse walk
 * would: within a second of the expected time it must have been within 0.1 m and a fifth of the way
 * walked so far, 15 degrees and a fifth of the angle turned so far, and 15 mm of height; it must
 * fall where expected and only there; the results must be the same.
 * @return A sentence each; empty if it does not. */
std::vector<std::string> find_differences(const Course& expected, const Course& course);

}  // namespace nao::playback
