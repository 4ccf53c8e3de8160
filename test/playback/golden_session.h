#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "test/playback/golden_trace.h"

namespace nao::playback {

/** A file of a golden session: sessions/golden/NAME.EXTENSION. */
inline std::filesystem::path golden_file(const std::string& name, const std::string& extension) {
  return std::filesystem::path(NAO_PLAYBACK_SESSIONS) / "golden" / (name + "." + extension);
}

/** Fails for each difference of a trace from the session's expected one. Writes the expected one in
 * place of that if the environment variable NAO_WRITE_GOLDEN is set (test/playback/record --golden
 * sets it). Skips where the mathematical functions give other bits than where it was written.
 * @param hint  Ends the message of a failure. */
void expect_golden_trace(const std::string& name, const GoldenTrace& trace,
                         const std::string& hint = "");

}  // namespace nao::playback
