/*
 * viewer_state: what the files of the viewer share, for them alone.
 */
#ifndef VIEWER_STATE_H
#define VIEWER_STATE_H

#include "app/options.h"
#include "app/panel_kind.h"
#include "app/probing.h"
#include "app/shader_reload.h"
#include "base/clock.h"
#include "images/picture_queue.h"
#include "window/panel_draw.h"

/* What a window shows over the picture: the example's parameters, their cost, the command that
 * draws the picture, help, errors.
 *
 * Without the panel's module the picture is shown alone, and help goes to standard error. */

enum { VIEWER_COMMAND_SIZE = 16384 };

/* A picture of which something was found. */
typedef struct PanelPicture {
    DrawRequest request;
    int width, height;
} PanelPicture;

PanelPicture viewer_panel_picture(const Renderer *renderer, const DrawRequest *request);

/* Whether it is not that of the request, in the renderer's canvas. */
bool viewer_panel_other(const PanelPicture *picture, const Renderer *renderer,
                        const DrawRequest *request);

typedef struct ViewerPanel {
    const Example *example;
    const PanelKind *kind; /* NULL: there is no more to show than parameters */
    Window *window;
    Panel *panel; /* NULL: there is none */
    PanelDraw draw;
    PanelView view;
    PanelResult result; /* of this frame */
    bool help;
    ParameterValue defaults[OPTIONS_MAX_PARAMETERS];
    Parameter options[9]; /* common ones that the panel changes; their values are the viewer's */
    ParameterValue option_defaults[8];
    /* Colors of the lights, diffuse and specular of each, by number. */
    Parameter lights[2 * SCENE_MAX_PLACED + 1];
    char light_names[2 * SCENE_MAX_PLACED][24];
    Vec3 light_values[2 * SCENE_MAX_PLACED];
    ParameterValue light_defaults[2 * SCENE_MAX_PLACED];
    Handle handles[HANDLES_MAX]; /* the lights of this frame's picture */
    int handle_count;
    double seconds; /* per frame, smoothed; 0: unknown */
    double rate;    /* frames per second; 0: unknown */
    struct ErrorWorker *worker;
    bool mapped; /* its map is shown in the picture's place */
    Image map;   /* of result number: */
    int map_number;
    double error_time; /* clock_now when it was last started */
    PanelPicture error_of;
    bool stale;   /* the parameters have changed since */
    int renewals; /* how often they have */
    char *effects;
    PanelObjects objects;
    double effects_time; /* clock_now when they were listed; 0: the parameters have changed */
    PanelPicture effects_of;
    char command[VIEWER_COMMAND_SIZE];
    char notice[PATH_MAX + 64];
    double notice_time;
    /* As in the last frame: */
    bool noticed, troubled, error_wanted, effects_wanted;
    bool computing;
    double text; /* the size of letters, as a factor */
} ViewerPanel;

/* `defaults`: of the example's parameters, before the command line was read. The panel changes the
 * options. Never fails: what is missing is reported on standard error. */
void viewer_panel_open(ViewerPanel *panel, const Example *example, const Canvas *canvas,
                       Options *options, const ParameterValue *defaults);

typedef struct ViewerPanelInput {
    const WindowInput *window;
    double seconds;         /* since the last frame */
    Renderer *renderer;     /* of the picture; NULL: there is none */
    const Options *options; /* that it was drawn with */
    const Message *trouble; /* shown as an error unless it is empty */
    const Handle *held;     /* that is dragged; NULL: none */
    PanelPixel pixel;
} ViewerPanelInput;

/* One frame of the panel; viewer_panel_draw draws it. */
bool viewer_panel_frame(ViewerPanel *panel, const ViewerPanelInput *input, Message *message);

/* The light's handle nearest to a point of the picture; NULL: there is none within `reach`. */
const Handle *viewer_panel_find_handle(const ViewerPanel *panel, double x, double y, double reach);

/* Sets the options to the colors of lights that were changed in this frame; false: none. */
bool viewer_panel_tint(const ViewerPanel *panel, LightTints *tints);

/* The panel's margins in the window, and the picture's place between them: see panel.h. */
void viewer_panel_margins(const ViewerPanel *panel, const WindowInput *input,
                          int margins[PANEL_MARGINS]);
void viewer_panel_place(const ViewerPanel *panel, const WindowInput *input, int place[4]);

/* Whether it has something new to show although nobody touched it: a result, the end of a notice.
 */
bool viewer_panel_due(ViewerPanel *panel);

/* What is shown instead of the picture: the map of its error, or of one before it; of this size.
 * NULL: nothing. */
const Image *viewer_panel_map(ViewerPanel *panel, int width, int height);

/* Draws it into the bound framebuffer, of the window's size. */
bool viewer_panel_draw(ViewerPanel *panel, int width, int height, Message *message);

/* The time a frame took to draw. */
void viewer_panel_measured(ViewerPanel *panel, double seconds);

/* The parameters, or what they draw, have changed. */
void viewer_panel_renew(ViewerPanel *panel);

/* Shows a line for a few seconds; NULL: removes it. */
void viewer_panel_notice(ViewerPanel *panel, const char *text);

void viewer_panel_toggle(ViewerPanel *panel);
void viewer_panel_letters(ViewerPanel *panel, int larger);
void viewer_panel_toggle_help(ViewerPanel *panel);

void viewer_panel_close(ViewerPanel *panel);

/* The pixel under the pointer, and the one that was clicked. */
enum { PIXEL_LINE = 256, PIXEL_NAMES = 127 };
typedef struct ViewerPixel {
    char line[PIXEL_LINE]; /* of that under the pointer; empty: it is not over the picture */
    double line_time;      /* clock_now then */
    /* Of which pixel and picture it is: */
    int line_at[2], line_renewals;
    bool line_paused;
    PanelPicture line_of;
    Probing seen; /* that picture, if only running its shaders tells what is exact */
    bool sees;
    bool open;             /* one was clicked: */
    double at[2];          /* there, of the picture's width and height */
    char title[64], *text; /* what is said of it */
    char *all;             /* the names that can be drawn instead of the picture, a line each: */
    const char *names[PIXEL_NAMES + 1];
    char shown[CAPTURE_NAME]; /* the one that is; empty: none */
    char *legend;
    Image image; /* of it */
    PanelPicture of;
    int renewals; /* of the panel, then */
    double time;  /* clock_now then; 0: not yet */
} ViewerPixel;

typedef struct Viewer {
    const Example *example;
    Canvas *canvas;
    Window *window;
    Options first; /* at the start; restored by r */
    ParameterValue first_values[OPTIONS_MAX_PARAMETERS];
    Options options;       /* current */
    double seconds;        /* options.seconds before it was rounded */
    const char *precision; /* that are in use */
    int samples;
    bool paused, full_screen, left;
    WindowInput input;
    double last; /* when the last frame began */
    int due;     /* frames to draw although time stands still: something has changed */
    int drawn, drawn_paused;
    int margins[PANEL_MARGINS]; /* that the panel has in the window's size */
    int place[4];               /* the picture's in the window: x, y, width, height */
    int plain[2], asked[2]; /* the window's size without the panel, and the one asked for with it */
    /* Since the title was last updated: */
    double title_time;
    int frames;
    const char *state; /* in the title */
    bool title_paused;
    char title_line[PIXEL_LINE];
    ViewerPanel panel;
    bool panel_had_pointer; /* in the previous frame: a press may precede the pointer's current
                               position */
    bool pressed, holding;  /* in the previous frame: the left button; a light, by its handle */
    Handle held;            /* where it has been dragged */
    bool clicks;            /* the button that is down has not dragged anything */
    double dragged[2];      /* less than a drag, so far */
    ViewerPixel pixel;
    ShaderReload reload;
    DrawRequest request; /* of the options: see current */
    Message broken;      /* error of the shaders on disk */
    Message unmade;      /* why renderer_renew failed */
    Picture picture;     /* read back, to be saved or retouched */
    Message trouble;     /* why drawing failed */
    Image before;        /* as it was, to be compared; without pixels: nothing is */
    double division;     /* it is left of this, of the picture's width */
} Viewer;

/* Whether there is a picture to draw. */
bool viewer_is_made(const Viewer *viewer);

/* As the options are now. */
const DrawRequest *viewer_request(Viewer *viewer);

/* Draws the picture and reads it back. */
bool viewer_read_picture(Viewer *viewer, Message *message);

/* Rebuilds what the example made of its parameters. If that fails (a missing model file), reports
 * it once, and there is no picture until they change. */
void viewer_renew(Viewer *viewer);

/* Within the command line's limits, so that every time can be drawn again. */
void viewer_pass_time(Viewer *viewer, double seconds);

/* Starts again with the arguments of a try, which blanks separate. A given time is held. */
void viewer_try(Viewer *viewer, const char *arguments);

/* What was typed, and what the pointer did, since the last frame. */
void viewer_use_keys(Viewer *viewer);
void viewer_use_pointer(Viewer *viewer);

/* Opens the pixel at a point of the window, and pauses. */
void viewer_pixel_click(Viewer *viewer, double x, double y);

/* Whether what is said of the open pixel is of another picture, and it is time to say it anew;
 * viewer_pixel_update does. */
bool viewer_pixel_due(const Viewer *viewer);
void viewer_pixel_update(Viewer *viewer);

/* After drawing: the line of the pixel under the pointer. */
void viewer_pixel_point(Viewer *viewer);

/* For the panel; and what its click has changed. */
PanelPixel viewer_pixel_content(const Viewer *viewer);
void viewer_pixel_choose(Viewer *viewer, const PanelResult *result);

/* What is shown instead of the picture; NULL: nothing. */
const Image *viewer_pixel_image(const Viewer *viewer);

void viewer_pixel_close(ViewerPixel *pixel);

/* Keeps the picture that is shown, or forgets it. */
void viewer_before_toggle(Viewer *viewer);

/* Over the picture, whose place this is in framebuffer 0; nothing if none is kept. */
bool viewer_before_present(Viewer *viewer, const int place[4], Message *message);

#endif
