/*
 * page_state: what the files of the pages' modules share, for them alone.
 */
#ifndef PAGE_STATE_H
#define PAGE_STATE_H

#include "app/options.h"
#include "app/renderer.h"
#include "core/shader_files.h"

#include <stdio.h>

typedef struct PageState {
    Message message;
    const Example *example; /* open; NULL: none */
    Options options;
    char *lines; /* which the options point into */
    Canvas canvas;
    Renderer renderer;
    ShaderFiles files;
    char folder[64]; /* of the files that page_replace wrote; "": there are none */
    bool replaced;   /* since the last page_open */
    Image image;
    char *text; /* returned */
} PageState;
extern PageState page;

/* Replaces the text that was returned last by what is written. NULL, or the end's "": no memory. */
FILE *page_text_begin(void);
const char *page_text_end(FILE *file);

#endif
