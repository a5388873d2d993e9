/*
 * model_ply: whether a PLY file was cut.
 */
#ifndef MODEL_PLY_H
#define MODEL_PLY_H

#include <stdbool.h>
#include <stddef.h>

/* False, with the reason, if the file ends before the rows that its header names; true of anything
 * that is no PLY file. */
bool model_ply_is_whole(const char *path, char *reason, size_t reason_size);

#endif
