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

/* `folder`: of the earlier pictures, NAME.png; `output`: of the report. To be closed whatever it
 * returns. */
bool regression_open(Regression **regression, const char *folder, const char *output,
                     Message *message);
void regression_close(Regression *regression); /* NULL is fine */

/* Before the first judgement the driver is measured, for seconds, while no canvas is open. */
bool regression_needs_driver(const Regression *regression);
bool regression_measure(Regression *regression, const CanvasBackend *backend, Message *message);

/* Whether there is an earlier picture of that name. */
bool regression_has(const Regression *regression, const char *name);

/* A picture, and all that draws it. */
typedef struct RegressionPicture {
    const Picture *now;
    const Canvas *canvas;
    Capture capture;
    ShaderFiles files;
} RegressionPicture;

/* Reads the earlier picture. */
bool regression_compare(Regression *regression, const Picture *picture, bool *same,
                        Message *message);

/* Of a picture that is not the same: what has changed is a line on standard output and in the
 * report. `of->capture` is empty then. */
bool regression_judge(Regression *regression, RegressionPicture *of, Message *message);

/* Writes the report, if anything has changed. *code is 1 if something cannot be by rounding. */
bool regression_end(Regression *regression, int *code, Message *message);

/* Keeps the shader files of pictures, in FOLDER/shaders, for later runs. */
bool regression_keep(const char *folder, const ShaderFiles *files, Message *message);

#endif
