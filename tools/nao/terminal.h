#pragma once

#include <unistd.h>

#include <cstdio>

namespace nao {

/** Empties the screen before it is drawn anew; does nothing where stdout is no terminal. */
inline void clear_terminal() {
  if (isatty(STDOUT_FILENO) == 1) std::fputs("\033[H\033[J", stdout);
}

}  // namespace nao
