// Shapes that overlap by construction do not press against each other.

#include "test/libs/robot_import/imported_urdf.h"

namespace nao {
namespace {

bool may_touch(const RobotModel& model, const std::string& a, const std::string& b) {
  const std::pair<int, int> links = std::minmax(model.find_link(a), model.find_link(b));
  const auto& allowed = model.allowed_contacts();
  return std::find(allowed.begin(), allowed.end(), links) != allowed.end();
}

std::string box(const std::string& size) {
  return "<collision><geometry><box size=\"" + size + "\"/></geometry></collision>";
}

TEST_F(ImportedUrdf, LetsBodiesOffThatTouchInAPosture) {
  // The hip's first and third link overlap; trunk and forearm touch in some poses only.
  add_to_link("trunk", box("0.1 0.1 0.1"));
  add_to_link("left_hip_pitch_link", box("0.06 0.06 0.06"));
  add_to_link("left_forearm", box("0.02 0.02 0.1"));
  const RobotModel model = import();
  EXPECT_TRUE(may_touch(model, "trunk", "left_hip_pitch_link"));
  EXPECT_FALSE(may_touch(model, "trunk", "left_forearm"));
}

// The links of one joint may touch, also where a frame is between them.
TEST_F(ImportedUrdf, ComparesBodiesAndNotLinks) {
  replace("name=\"left_elbow\"", "parent link=\"left_upper_arm\"", "parent link=\"frame\"");
  replace("<link name=\"trunk\">", "<link name=\"trunk\">",
          "<link name=\"frame\"/><joint name=\"frame_mount\" type=\"fixed\"><parent "
          "link=\"left_upper_arm\"/><child link=\"frame\"/></joint><link name=\"trunk\">");
  const RobotModel model = import();
  EXPECT_TRUE(may_touch(model, "left_upper_arm", "left_forearm"));
  EXPECT_FALSE(may_touch(model, "left_upper_arm", "right_forearm"));
}

}  // namespace
}  // namespace nao
