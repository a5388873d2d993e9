/*
 * panel_draw: draws the triangles of a panel into the framebuffer that is bound.
 */
#ifndef PANEL_DRAW_H
#define PANEL_DRAW_H

#include "core/shader.h"
#include "window/panel.h"

typedef struct PanelDraw {
    Shader shader;
    GLuint vertices, indices;       /* buffer objects, kept from frame to frame, and grown */
    size_t vertex_room, index_room; /* bytes in them */
    GLuint atlas;                   /* texture */
    unsigned generation;            /* of the atlas */
    GLint a_Position, a_TexCoord, a_Color, u_Size;
} PanelDraw;

/* Loads panel.vert and panel.frag; of the loader only its folder counts. */
bool panel_draw_open(PanelDraw *draw, const ShaderLoader *loader, Message *message);

/* Draws over a framebuffer of width x height pixels: those of the window that the panel was made
 * for. All GL state is afterwards as it was. */
bool panel_draw(PanelDraw *draw, const PanelDrawing *drawing, int width, int height,
                Message *message);

/* NULL or a zeroed one is fine. */
void panel_draw_close(PanelDraw *draw);

#endif
