/*
 * setting_picture: draws a scene with a quality setting, times it and compares it with the exact
 * picture.
 *
 * One context for all settings, a canvas per kind of framebuffer; programs are kept.
 */
#ifndef SETTING_PICTURE_H
#define SETTING_PICTURE_H

#include "lighting/lighting.h"
#include "reference/reference.h"
#include "study/results/results.h"

/* Matrices composed in other ways than `lighting` does: in double precision, in single precision,
 * or in single precision with compensated dot products (Ogita, Rump and Oishi, Accurate sum and dot
 * product, SIAM J. Sci. Comput. 26(6), 2005: as exact as double precision rounded once). Either
 * relative to the eye, or in the lecture's order: (clip_from_eye * eye_from_world) *
 * world_from_object, with the eye's translation in eye_from_world. */

/* For the setting's choices of matrices and order. */
const LightingTransforms *transforms_of(const Quality *quality);

typedef struct SettingRenderer SettingRenderer;

/* Every picture has this width and height. `loader` says where shaders are. */
bool setting_renderer_open(SettingRenderer **renderer, const ShaderLoader *loader,
                           const CanvasBackend *backend, int width, int height, Message *message);
const char *
setting_renderer_name(const SettingRenderer *renderer); /* "llvmpipe (LLVM 15.0.6, 256 bits)" */
const char *
setting_renderer_version(const SettingRenderer *renderer); /* "OpenGL ES 3.2 Mesa 22.3.6" */

/* Drops the meshes of the drawings so far, all of which must be closed. */
void setting_renderer_forget(SettingRenderer *renderer);

/* A scene with a setting, ready to draw: meshes uploaded, programs compiled, one frame drawn. */
typedef struct SettingPicture {
    Quality quality;
    SceneCopy made;
    Lighting *lighting;   /* the renderer's */
    const Canvas *canvas; /* the renderer's */
    Image image;          /* the last frame */
} SettingPicture;
bool setting_picture_open(SettingPicture *drawing, SettingRenderer *renderer, const Scene *scene,
                          const Quality *quality, Message *message);

/* Draws one frame and reads it back, with glFinish before and after. *wall: seconds; *gpu: seconds
 * of drawing alone by the driver's timer, NAN if it has none. */
bool setting_picture_frame(SettingPicture *drawing, SettingRenderer *renderer, double *wall,
                           double *gpu, Message *message);

/* The same without the objects: clears, finishes, reads back. */
bool setting_picture_empty(SettingPicture *drawing, double *wall, Message *message);

/* Sets the row's errors: of the last frame against the exact picture. Interior: see
 * pixel_is_interior. */
void setting_picture_error(const SettingPicture *drawing, const Reference *exact, ResultRow *row);

/* Sets the row's counts: of the last frame; of operations -1 if no tool counts them. */
bool setting_picture_counts(const SettingPicture *drawing, SettingRenderer *renderer,
                            ResultRow *row, Message *message);

void setting_picture_close(SettingPicture *drawing);

/* NULL is fine. After every drawing has been closed. */
void setting_renderer_close(SettingRenderer *renderer);

#endif
