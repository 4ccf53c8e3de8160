#include "daemons/motion-files/motion_store.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "common/error.h"
#include "test/daemons/motion-files/motions.h"
#include "test/support/temporary_folder.h"

namespace nao {
namespace {

class MotionStoreTest : public testing::Test {
 protected:
  motion::ActionScript named(const std::string& name) {
    motion::ActionScript script = make_motion(kWave);
    script.sequence.name = name;
    return script;
  }

  TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path() / "motions";
};

TEST_F(MotionStoreTest, KeepsMotionsBetweenRuns) {
  {
    MotionStore store(*test_model(), folder_);
    EXPECT_TRUE(store.names().empty());
    store.save(named("wave"));
    store.save(named("bow"));
    store.save(named("_try"));
    EXPECT_EQ(store.names(), (std::vector<std::string>{"_try", "bow", "wave"}));
    EXPECT_EQ(store.num_kept(), 2u);
  }
  MotionStore store(*test_model(), folder_);
  EXPECT_EQ(store.names(), (std::vector<std::string>{"bow", "wave"}));
  EXPECT_EQ(store.find("wave")->sequence.keyframes.size(), 3u);
  EXPECT_TRUE(store.erase("wave"));
  EXPECT_FALSE(store.erase("wave"));
  EXPECT_EQ(MotionStore(*test_model(), folder_).names(), (std::vector<std::string>{"bow"}));
}

TEST_F(MotionStoreTest, NeverLeavesItsFolder) {
  MotionStore store(*test_model(), folder_);
  EXPECT_THROW(store.save(named("../wave")), Error);
  EXPECT_THROW(store.save(named("/tmp/wave")), Error);
  EXPECT_FALSE(store.erase("../motion_store_test/wave"));
  EXPECT_FALSE(std::filesystem::exists(folder_.parent_path() / "wave.yaml"));
}

TEST_F(MotionStoreTest, LeavesOtherFilesAlone) {
  std::filesystem::create_directories(folder_);
  write_text(folder_ / "notes.txt", "x");
  write_text(folder_ / "broken.yaml", "actions: [");
  write_text(folder_ / "renamed.yaml", "actions: [{name: b, keyframes: [{duration: 1}]}]");
  MotionStore store(*test_model(), folder_);
  EXPECT_TRUE(store.names().empty());
  ASSERT_EQ(store.faults().size(), 2u);
  EXPECT_NE(store.faults()[0].find("broken.yaml"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "broken.yaml"));
}

TEST_F(MotionStoreTest, DropsTheOldestTemporaryMotion) {
  MotionStore store(*test_model(), folder_);
  for (int i = 0; i <= static_cast<int>(MotionStore::kMaxTemporary); ++i) {
    store.save(named("_" + std::to_string(i)));
  }
  EXPECT_EQ(store.names().size(), MotionStore::kMaxTemporary);
  EXPECT_EQ(store.find("_0"), nullptr);
  EXPECT_FALSE(std::filesystem::exists(folder_));
}

}  // namespace
}  // namespace nao
