// Holds the precompiled headers, see ../precompiled_headers.cmake.
