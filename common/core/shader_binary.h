/*
 * shader_binary: linked programs kept between runs, for shader.c alone.
 */
#ifndef SHADER_BINARY_H
#define SHADER_BINARY_H

#include "base/cache.h"
#include "core/gl.h"
#include "core/shader_source.h"

/* What a program's binary depends on: its sources, the driver, and our version. */
CacheKey shader_binary_key(const ShaderSource sources[2]);

/* The program that was kept under the key, linked; 0: there is none, or the driver refuses it. */
GLuint shader_binary_open(const CacheKey *key);

/* Keeps a linked program, if the driver gives its binary. */
void shader_binary_keep(const CacheKey *key, GLuint program);

#endif
