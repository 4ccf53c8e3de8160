// Input of libFuzzer: a URDF, or elements of one. It is refused with a reason, or repaired.
#include <cstdint>
#include <string>

#include "common/error.h"
#include "robot_import/urdf_repair.h"
#include "test/support/test_biped.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const nao::TemporaryFolder folder;
  static const std::string whole = nao::make_biped_urdf(nao::TestBiped{});
  std::string urdf(reinterpret_cast<const char*>(data), size);
  // In a robot, most bytes reach what follows the XML parser.
  if (size > 0 && data[0] < 0x80) urdf = std::string(whole).insert(whole.find("<link"), urdf);
  nao::write_text(folder.path() / "robot.urdf", urdf);
  try {
    (void)nao::repair_urdf(folder.path() / "robot.urdf", folder.path());
  } catch (const nao::Error&) {
    return 0;
  }
  return 0;
}
