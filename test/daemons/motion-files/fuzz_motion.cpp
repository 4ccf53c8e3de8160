// Input of libFuzzer: the text of a taught motion. What was read, written again, must be readable
// and the same.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "common/error.h"
#include "daemons/motion-files/motion_text.h"
#include "daemons/motion/actions/taught_script.h"
#include "messages/motion_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const nao::RobotModel model =
      nao::RobotModel::load(std::filesystem::path(NAO_TEST_DATA) / "robots" / "nao");
  const std::string text(reinterpret_cast<const char*>(data), size);
  nao::motion::ActionScript script;
  try {
    script = nao::parse_motion(model, text, "input");
  } catch (const nao::Error&) {
    return 0;
  }
  if (!nao::is_motion_name(script.sequence.name)) std::abort();
  if (nao::motion::find_form_fault(script)) return 0;
  const std::string written = nao::to_yaml(model, script);
  if (nao::to_yaml(model, nao::parse_motion(model, written, "written")) != written) std::abort();
  const auto named = nao::from_message(nao::to_message(nao::motion::to_named(model, script)));
  if (!named || named->keyframes.size() != script.sequence.keyframes.size()) std::abort();
  return 0;
}
