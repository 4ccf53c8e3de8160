#pragma once

namespace nao {

/** Gives the kernel back what only the start of this program needed: freed blocks of the heap, and
 * pages of program code, which come back from their files when they are used again. For a program
 * that has loaded a compiler, as Mesa's software renderer does. */
void release_unused_memory();

}  // namespace nao
