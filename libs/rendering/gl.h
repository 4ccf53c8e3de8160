#pragma once

/** Functions and constants of OpenGL 3.3; for .cpp files, since the headers are long. */
#ifndef GL_GLEXT_PROTOTYPES
#define GL_GLEXT_PROTOTYPES
#endif
#include <GL/gl.h>
#include <GL/glext.h>
