#include "daemons/motion/walk/gait.h"

#include <gtest/gtest.h>

#include <string>

#include "common/error.h"
#include "test/daemons/motion/nao_model.h"
#include "test/support/temporary_folder.h"

namespace nao::motion {
namespace {

class GaitTest : public testing::Test {
 protected:
  /** Loads a text. @return What is wrong with it, or "". */
  std::string load(const std::string& text) {
    write_text(folder_.path() / "gait.yaml", text);
    try {
      Gait::load(folder_.path() / "gait.yaml");
      return "";
    } catch (const ModelError& error) {
      return error.what();
    }
  }
  /** The NAO's gait with the line of a key replaced. */
  std::string with_line(const std::string& key, const std::string& line) {
    std::string text = text_;
    const size_t at = text.find("\n  " + key + ":");
    EXPECT_NE(at, std::string::npos) << key;
    text.replace(at + 1, text.find('\n', at + 1) - at, line);
    return text;
  }

  const std::string text_ = read_text(nao_model().folder() / "gait.yaml");
  TemporaryFolder folder_;
};

TEST_F(GaitTest, ReadsEveryParameterWithItsRange) {
  std::vector<Gait::Parameter> parameters;
  const Gait gait = Gait::load(nao_model().folder() / "gait.yaml", &parameters);
  EXPECT_GT(parameters.size(), 40u);
  for (const Gait::Parameter& parameter : parameters) {
    EXPECT_LT(parameter.lower, parameter.upper) << parameter.name;
    EXPECT_GE(parameter.value(gait), parameter.lower) << parameter.name;
    EXPECT_LE(parameter.value(gait), parameter.upper) << parameter.name;
  }
}

TEST_F(GaitTest, AParameterGivesAccessToItsValue) {
  std::vector<Gait::Parameter> parameters;
  Gait gait = Gait::load(nao_model().folder() / "gait.yaml", &parameters);
  for (const Gait::Parameter& parameter : parameters) {
    if (parameter.name == "stance.hip_height") parameter.in(gait) = 0.123;
  }
  EXPECT_DOUBLE_EQ(gait.stance.hip_height, 0.123);
}

TEST_F(GaitTest, RejectsAFileWithUnknownMissingOrContradictoryParameters) {
  EXPECT_EQ(load(text_), "");
  EXPECT_NE(load(with_line("hip_height", "  hip_hight: {value: 1, range: [0, 2]}\n"))
                .find("hip_hight is unknown"),
            std::string::npos);
  EXPECT_NE(load(with_line("hip_height", "")).find("hip_height"), std::string::npos);
  EXPECT_NE(load(with_line("hip_height", "  hip_height: {value: 3, range: [0, 2]}\n"))
                .find("outside its range"),
            std::string::npos);
  EXPECT_NE(load(with_line("step_duration", "  step_duration: {value: 2, range: [0, 2]}\n"))
                .find("min_step_duration"),
            std::string::npos);
  // Its feet would never stand side by side.
  EXPECT_NE(
      load(with_line("min_foot_separation", "  min_foot_separation: {value: 0.2, range: [0, 2]}\n"))
          .find("must not be above stance.foot_separation"),
      std::string::npos);
}

}  // namespace
}  // namespace nao::motion
