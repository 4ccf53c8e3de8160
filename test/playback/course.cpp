#include "test/playback/course.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>

#include "common/error.h"

namespace nao::playback {
namespace {

// See find_differences().
constexpr double kSlack = 1.0;          // s
constexpr double kPositionSlack = 0.1;  // m
constexpr double kHeadingSlack = 0.26;  // rad
constexpr double kHeightSlack = 0.015;  // m
constexpr double kShareOfTheWay = 0.2;

bool is_fall(const CourseRow& row) {
  return row.mode == "falling" || row.mode == "fallen" || row.mode == "getting-up";
}

/** Least of some deviation over the rows of a course that are near a time. */
double least(const Course& course, double time,
             const std::function<double(const CourseRow&)>& deviation) {
  double best = INFINITY;
  for (const CourseRow& row : course.rows) {
    if (std::abs(row.time - time) <= kSlack + 1e-9) best = std::min(best, deviation(row));
  }
  return best;
}

std::string sentence(double time, const std::string& what, double is, double may) {
  std::ostringstream text;
  text << "at " << time << " s the " << what << " is " << is << " off; " << may << " are allowed";
  return text.str();
}

void compare_rows(const Course& expected, const Course& course,
                  std::vector<std::string>& differences) {
  double way = 0;
  double turned = 0;
  const CourseRow* last = &expected.rows.front();
  for (const CourseRow& row : expected.rows) {
    way += std::hypot(row.x - last->x, row.y - last->y);
    turned += std::abs(row.heading - last->heading);
    last = &row;
    const auto check = [&](const std::string& what, double may,
                           const std::function<double(const CourseRow&)>& deviation) {
      const double is = least(course, row.time, deviation);
      if (!(is <= may)) differences.push_back(sentence(row.time, what, is, may));
    };
    check("position (m)", kPositionSlack + kShareOfTheWay * way,
          [&](const CourseRow& other) { return std::hypot(other.x - row.x, other.y - row.y); });
    check("heading (rad)", kHeadingSlack + kShareOfTheWay * turned,
          [&](const CourseRow& other) { return std::abs(other.heading - row.heading); });
    // The pose of a fallen robot is random.
    if (is_fall(row)) continue;
    check("height (m)", kHeightSlack,
          [&](const CourseRow& other) { return std::abs(other.height - row.height); });
  }
}

}  // namespace

std::string to_text(const Course& course) {
  std::ostringstream text;
  text.precision(3);
  text << std::fixed;
  for (const CourseRow& row : course.rows) {
    text << "row " << row.time << ' ' << row.x << ' ' << row.y << ' ' << row.heading << ' '
         << row.height << ' ' << row.mode << '\n';
  }
  for (const std::string& result : course.results) text << "result " << result << '\n';
  return text.str();
}

Course read_course(const std::filesystem::path& file) {
  std::ifstream stream(file);
  Course course;
  std::string line;
  while (std::getline(stream, line)) {
    std::istringstream words(line);
    std::string kind;
    words >> kind >> std::ws;
    if (kind == "result") {
      std::string result;
      std::getline(words, result);
      course.results.push_back(result);
      continue;
    }
    CourseRow row;
    words >> row.time >> row.x >> row.y >> row.heading >> row.height >> row.mode;
    if (kind != "row" || !words) {
      throw Error(file.string() + ": cannot read \"" + line +
                  "\"; write it again: test/playback/record --courses");
    }
    course.rows.push_back(row);
  }
  if (course.rows.empty()) {
    throw Error(file.string() + " holds no course; write it: test/playback/record --courses");
  }
  return course;
}

std::vector<std::string> find_differences(const Course& expected, const Course& course) {
  std::vector<std::string> differences;
  compare_rows(expected, course, differences);
  const bool falls = std::any_of(course.rows.begin(), course.rows.end(), is_fall);
  const bool shall_fall = std::any_of(expected.rows.begin(), expected.rows.end(), is_fall);
  if (falls != shall_fall) {
    differences.push_back(falls ? "the robot falls" : "the robot does not fall, as it should");
  }
  if (course.results != expected.results) {
    std::string text = "other results:";
    for (const std::string& result : course.results) text += " " + result + ";";
    text += " expected:";
    for (const std::string& result : expected.results) text += " " + result + ";";
    differences.push_back(text);
  }
  return differences;
}

}  // namespace nao::playback
