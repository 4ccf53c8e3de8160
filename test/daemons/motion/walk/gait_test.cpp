#include "daemons/motion/walk/gait.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "common/error.h"
#include "test/daemons/motion/nao_model.h"
#include "test/support/temporary_folder.h"

namespace nao::motion {
namespace {

std::string nao_gait() {
  std::ifstream file(nao_model().folder() / "gait.yaml");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Gait, ReadsEveryParameterWithItsRange) {
  std::vector<Gait::Parameter> parameters;
  const Gait gait = Gait::load(nao_model().folder() / "gait.yaml", &parameters);
  EXPECT_GT(parameters.size(), 40u);
  for (const Gait::Parameter& parameter : parameters) {
    EXPECT_LT(parameter.lower, parameter.upper) << parameter.key;
    EXPECT_GE(gait.*parameter.member, parameter.lower) << parameter.key;
    EXPECT_LE(gait.*parameter.member, parameter.upper) << parameter.key;
  }
}

TEST(Gait, RefusesWhatItDoesNotKnowAndWhatIsMissing) {
  const TemporaryFolder folder;
  const auto load = [&](const std::string& text) {
    std::ofstream(folder.path() / "gait.yaml") << text;
    return Gait::load(folder.path() / "gait.yaml");
  };
  EXPECT_NO_THROW(load(nao_gait()));
  EXPECT_THROW(load(nao_gait() + "stride_lenght: {value: 1, range: [0, 2]}\n"), ModelError);
  std::string without = nao_gait();
  const size_t at = without.find("\nhip_height:");
  without.erase(at, without.find('\n', at + 1) - at);
  EXPECT_THROW(load(without), ModelError);
}

}  // namespace
}  // namespace nao::motion
