#pragma once

#include <cstddef>

namespace nao {

/** Calls of operator new since the start of the program; link allocation_count.cpp. */
size_t allocation_count();

}  // namespace nao
