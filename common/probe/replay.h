/*
 * replay: draws a capture again, from its data alone, with other shaders where asked.
 *
 * What a shader computes on its way becomes visible so: in the driver's own arithmetic.
 */
#ifndef REPLAY_H
#define REPLAY_H

#include "probe/capture.h"

/* The texts of both stages of a draw, for free(); one that stays NULL is the draw's own. False: the
 * draw is left out. */
typedef bool ReplaySources(const CaptureDraw *draw, char *sources[2], void *context);

/* Draws into the canvas, in the context that was captured. `sources` may be NULL; it is asked once
 * for each two texts. Textures that could not be read must still be there. */
bool replay_draw(const Capture *capture, const Canvas *canvas, ReplaySources *sources,
                 void *context, Message *message);

#endif
