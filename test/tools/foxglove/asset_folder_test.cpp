#include "tools/foxglove/asset_folder.h"

#include <gtest/gtest.h>

#include "test/support/temporary_folder.h"

namespace nao::foxglove {
namespace {

class AssetFolderTest : public testing::Test {
 protected:
  AssetFolderTest() {
    std::filesystem::create_directories(folder_.path() / "robot/meshes");
    write("robot/some.urdf", "<robot/>");
    write("robot/meshes/Head.glb", "mesh");
    write("robot/.hidden", "secret");
    write("outside", "secret");
    std::filesystem::create_symlink(folder_.path() / "outside", folder_.path() / "robot/link");
  }
  void write(const std::string& name, const std::string& content) {
    write_text(folder_.path() / name, content);
  }
  std::string read(const std::string& path) {
    AssetFolder files(folder_.path() / "robot", folder_.path() / "robot/some.urdf");
    const auto content = files.read(path);
    return content ? *content : "none";
  }

  TemporaryFolder folder_;
};

TEST_F(AssetFolderTest, ReadsTheUrdfUnderOneNameAndTheFilesBesideIt) {
  EXPECT_EQ(read("robot.urdf"), "<robot/>");
  EXPECT_EQ(read("some.urdf"), "<robot/>");
  EXPECT_EQ(read("meshes/Head.glb"), "mesh");
  AssetFolder files(folder_.path() / "robot", folder_.path() / "robot/some.urdf");
  EXPECT_NE(files.read_uri("package://robot/meshes/Head.glb"), nullptr);
  EXPECT_EQ(files.read_uri("package://other/meshes/Head.glb"), nullptr);
  EXPECT_EQ(files.read_uri("meshes/Head.glb"), nullptr);
}

TEST_F(AssetFolderTest, ReadsNothingElse) {
  for (const char* path :
       {"", "/", ".", "..", "../outside", "meshes/../../outside", ".hidden", "meshes", "meshes/",
        "/etc/passwd", "//etc/passwd", "link", "meshes//Head.glb", "meshes/Head.glb?x",
        "meshes%2fHead.glb", "missing"}) {
    EXPECT_EQ(read(path), "none") << path;
  }
}

}  // namespace
}  // namespace nao::foxglove
