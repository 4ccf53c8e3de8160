#include "tools/tuning/trial_conditions.h"

#include <gtest/gtest.h>

#include <set>

#include "common/error.h"

namespace nao {
namespace {

TEST(TrialConditions, AreEveryEngineWithEverySetOfDisturbances) {
  const TrialConditions conditions({"fast", "simbody"}, {"none", "real", "backlash+floor_slope"});
  ASSERT_EQ(conditions.count(), 6);
  std::set<std::string> found;
  for (int i = 0; i < conditions.count(); ++i) {
    ClosedLoopOptions options;
    conditions.apply(i, options);
    found.insert(options.engine + " " + options.disturbances->name());
  }
  EXPECT_EQ(found, (std::set<std::string>{"fast none", "fast real", "fast backlash,floor_slope",
                                          "simbody none", "simbody real",
                                          "simbody backlash,floor_slope"}));
}

TEST(TrialConditions, NamesWhatDoesNotExist) {
  for (const auto& [engine, disturbances] :
       {std::pair("steam", "real"), std::pair("fast", "earthquake")}) {
    try {
      const TrialConditions conditions({engine}, {disturbances});
      FAIL();
    } catch (const ConfigError& error) {
      const std::string text = error.what();
      EXPECT_TRUE(text.find("steam") != std::string::npos ||
                  text.find("earthquake") != std::string::npos)
          << text;
    }
  }
}

}  // namespace
}  // namespace nao
