#pragma once

#include <unistd.h>

#include <cstdio>

namespace nao {

/** Clears the screen before it is redrawn; no effect if stdout is not a terminal. */
inline void clear_terminal() {
  if (isatty(STDOUT_FILENO) == 1) std::fputs("\033[H\033[J", stdout);
}

}  // namespace nao
