/*
 * compiler_dependence: whether a shader's text is another for another compiler. No GL.
 *
 * What a driver draws must be what others read and count. So a text may not use the version, the
 * macros of extensions or the limits of an implementation, and where it depends on GL_ES or
 * GL_FRAGMENT_PRECISION_HIGH, its branches may differ in precision only. Nor may it read
 * gl_PointCoord, which is undefined in triangles.
 */
#ifndef COMPILER_DEPENDENCE_H
#define COMPILER_DEPENDENCE_H

#include "base/message.h"

#include <stdbool.h>

/* False, with a message that says what to remove (without the file's name): it depends on it. */
bool compiler_dependence_check(const char *text, Message *message);

#endif
