/*
 * page_probe: page.h and what the shaders of the open program compute: a module of its own, which a
 * page loads when a pixel is asked for.
 */
#ifndef PAGE_PROBE_H
#define PAGE_PROBE_H

#include "web/page.h"

/* After page_open, which it replaces until the next: draws the picture of the options, time and
 * camera among them, and keeps its draws. `device`: as --arithmetic names it. 0 on failure. */
int page_capture(const char *device);

/* The pixel as `--probe --format json` has it; "" on failure. */
const char *page_probe(int column, int row);

/* The names that --show can show, one a line: the fragment shader's, an empty line, the vertex
 * shader's; "" on failure. */
const char *page_names(void);

/* page_pixels become what --show draws, or of "" --arithmetic, and what its colours mean is
 * returned; "" on failure. */
const char *page_show(const char *what);

#endif
