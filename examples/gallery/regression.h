/*
 * regression: pictures against those of an earlier run, pixel by pixel, without a tolerance.
 */
#ifndef REGRESSION_H
#define REGRESSION_H

#include "app/options.h"
#include "core/shader_files.h"
#include "gallery/moved.h"
#include "images/picture_queue.h"

typedef struct Regression Regression;

/* `folder`: of the earlier pictures, NAME.png; `output`: of the report. Measures the driver, so no
 * canvas is open. To be closed whatever it returns. */
bool regression_open(Regression **regression, const char *folder, const char *output,
                     const CanvasBackend *backend, Message *message);
void regression_close(Regression *regression); /* NULL is fine */

/* Whether there is an earlier picture of that name. */
bool regression_has(const Regression *regression, const char *name);

/* A picture, and all that draws it. */
typedef struct RegressionPicture {
    const Picture *now;
    const Canvas *canvas;
    Capture capture;
    ShaderFiles files;
} RegressionPicture;

/* Compares it with the earlier one; what has changed is a line on standard output and in the
 * report. `of->capture` is empty then. */
bool regression_judge(Regression *regression, RegressionPicture *of, Message *message);

/* Writes the report, if anything has changed. *code is 1 if something cannot be by rounding. */
bool regression_end(Regression *regression, int *code, Message *message);

/* Keeps the shader files of pictures, in FOLDER/shaders, for later runs. */
bool regression_keep(const char *folder, const ShaderFiles *files, Message *message);

#endif
