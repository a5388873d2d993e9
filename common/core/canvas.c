/*
 * A window system's framebuffer has whatever size, bits and samples it has. So a canvas draws into
 * a framebuffer object of its own: colours of 8 bits or floats, a depth of 24, and, for
 * antialiasing, either renderbuffers of several samples and a second framebuffer that they are
 * resolved to, or a framebuffer K times as wide and high, whose K x K pixels are averaged when it
 * is read (canvas_read.c). The driver may give less than it was asked for, so its answers are
 * checked.
 */
#include "core/canvas.h"

#include "base/cache.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The function pointers of gl.h and EGL's display belong to one canvas. */
static bool is_open;

const CanvasBackend *canvas_backend(const CanvasBackend *const *backends, const char *name,
                                    Message *message)
{
    char known[128] = "";
    for (int i = 0; backends[i]; i++) {
        if (strcmp(name, backends[i]->name) == 0)
            return backends[i];
        const size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", backends[i]->name);
    }
    message_set(message, "%s: no such backend; there is %s", name, known);
    return NULL;
}

const CanvasBackend *canvas_default_backend(const CanvasBackend *const *backends, Message *message)
{
    const char *name = getenv("LIGHTING_BACKEND");
    Message why = {0};
    const CanvasBackend *found =
        name && name[0] ? canvas_backend(backends, name, &why) : backends[0];
    if (!found)
        message_set(message, "LIGHTING_BACKEND: %s", why.text);
    return found;
}

static GLenum color_format(const Canvas *canvas)
{
    return canvas->real ? GL_RGBA32F_EXT : GL_RGBA8_OES;
}

static bool check_size(const Canvas *canvas, Message *message)
{
    GLint max_buffer = 0, max[2] = {0, 0};
    char how[64] = "";
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &max_buffer);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, max);
    for (int i = 0; i < 2; i++)
        max[i] = (max_buffer < max[i] ? max_buffer : max[i]) / canvas->supersample;
    if (canvas->width >= 1 && canvas->width <= max[0] && canvas->height >= 1 &&
        canvas->height <= max[1])
        return true;
    if (canvas->supersample > 1)
        snprintf(how, sizeof how, " with %dx%d supersampling", canvas->supersample,
                 canvas->supersample);
    return message_set(message, "size %dx%d: %s%s draws 1x1 to %dx%d", canvas->width,
                       canvas->height, canvas->renderer, how, max[0], max[1]);
}

static const char *framebuffer_status(GLenum status)
{
    switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
        return "incomplete attachment, probably out of memory; ask for a smaller size or "
               "fewer samples";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
        return "missing attachment";
    case GL_FRAMEBUFFER_UNSUPPORTED:
        return "unsupported combination of formats";
    default:
        return "incomplete";
    }
}

static void renderbuffer(GLuint *name, int samples, GLenum format, int width, int height)
{
    glGenRenderbuffers(1, name);
    glBindRenderbuffer(GL_RENDERBUFFER, *name);
    if (samples > 0)
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
    else
        glRenderbufferStorage(GL_RENDERBUFFER, format, width, height);
}

static bool framebuffer(GLuint *name, GLuint color, GLuint depth, int width, int height,
                        Message *message)
{
    glGenFramebuffers(1, name);
    glBindFramebuffer(GL_FRAMEBUFFER, *name);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    if (depth)
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    const GLenum error = glGetError();
    if (error != GL_NO_ERROR)
        return message_set(message,
                           "canvas: a %dx%d framebuffer: %s from the driver; ask for a "
                           "smaller size or fewer samples",
                           width, height, gl_error_name(error));
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        return message_set(message, "canvas: a %dx%d framebuffer: %s", width, height,
                           framebuffer_status(status));
    return true;
}

enum { MAX_SUPERSAMPLE = 4 };

/* The most samples of the driver's own multisampling; 1: it has none. softpipe has the functions,
 * and one sample. */
static int driver_max_samples(void)
{
    GLint max = 1;
    if (glRenderbufferStorageMultisample && glBlitFramebuffer)
        glGetIntegerv(GL_MAX_SAMPLES_ANGLE, &max);
    return max;
}

/* The driver's multisampling, or else supersampling. */
static bool choose_samples(Canvas *canvas, int samples, Message *message)
{
    const int max = driver_max_samples();
    if (samples <= 1)
        return true;
    if (!canvas->supersampled && max > 1) {
        if (samples > max)
            return message_set(message, "%d samples: must be 0 to %d, the most that %s has",
                               samples, max, canvas->renderer);
        canvas->samples = samples;
        return true;
    }
    int side = 2;
    while (side <= MAX_SUPERSAMPLE && side * side < samples)
        side++;
    if (side > MAX_SUPERSAMPLE)
        return message_set(message, "%d samples: must be 0 to %d, the most %s", samples,
                           MAX_SUPERSAMPLE * MAX_SUPERSAMPLE,
                           canvas->supersampled ? "with shadows"
                                                : "with a driver that has none of its own");
    canvas->supersample *= side;
    return true;
}

static bool make_framebuffers(Canvas *canvas, Message *message)
{
    const int width = canvas->width * canvas->supersample;
    const int height = canvas->height * canvas->supersample;
    const bool es3 = gl_version() >= 30;
    const GLenum depth_format =
        es3 || gl_has("GL_OES_depth24") ? GL_DEPTH_COMPONENT24_OES : GL_DEPTH_COMPONENT16;
    if (!es3 && !gl_has("GL_OES_rgb8_rgba8"))
        return message_set(message, "canvas: %s cannot draw to 8-bit RGBA (GL_OES_rgb8_rgba8)",
                           canvas->renderer);
    if (canvas->samples > 0) {
        renderbuffer(&canvas->resolve_color, 0, color_format(canvas), width, height);
        if (!framebuffer(&canvas->resolve_framebuffer, canvas->resolve_color, 0, width, height,
                         message))
            return false;
    }
    renderbuffer(&canvas->color, canvas->samples, color_format(canvas), width, height);
    renderbuffer(&canvas->depth, canvas->samples, depth_format, width, height);
    if (!framebuffer(&canvas->framebuffer, canvas->color, canvas->depth, width, height, message))
        return false;
    if (canvas->samples > 0)
        glGetIntegerv(GL_SAMPLES, &canvas->samples);
    glGetIntegerv(GL_RED_BITS, &canvas->red_bits);
    glGetIntegerv(GL_GREEN_BITS, &canvas->green_bits);
    glGetIntegerv(GL_BLUE_BITS, &canvas->blue_bits);
    glGetIntegerv(GL_ALPHA_BITS, &canvas->alpha_bits);
    glGetIntegerv(GL_DEPTH_BITS, &canvas->depth_bits);
    const int bits = canvas->real ? 32 : 8;
    if (canvas->red_bits != bits || canvas->green_bits != bits || canvas->blue_bits != bits ||
        canvas->alpha_bits != bits || canvas->depth_bits < 24)
        return message_set(message,
                           "canvas: asked for RGBA %d %d %d %d and depth 24, the driver gave %d %d "
                           "%d %d and %d",
                           bits, bits, bits, bits, canvas->red_bits, canvas->green_bits,
                           canvas->blue_bits, canvas->alpha_bits, canvas->depth_bits);
    return true;
}

/* In the current context. */
static bool make_canvas(Canvas *canvas, const CanvasOptions *options, Message *message)
{
    canvas->width = options->width;
    canvas->height = options->height;
    canvas->supersample = options->supersample > 1 ? options->supersample : 1;
    canvas->supersampled = options->supersampled;
    canvas->real = options->real && gl_draws_floats();
    if (!choose_samples(canvas, options->samples, message) || !check_size(canvas, message) ||
        !make_framebuffers(canvas, message))
        return false;
    canvas_begin(canvas);
    return true;
}

/* A window shows a copy of what was drawn. */
static bool check_presents(const Canvas *canvas, Message *message)
{
    return !canvas->backend->presents || glBlitFramebuffer ||
           message_set(message,
                       "window: %s cannot copy to it (OpenGL ES 3 or GL_ANGLE_framebuffer_blit)",
                       canvas->renderer);
}

static bool make_first(Canvas *canvas, const CanvasOptions *options, Message *message)
{
    enum { PROGRAM_POINT_SIZE = 0x8642 };
    if (!gl_load(canvas->backend->address, message))
        return false;
    canvas->renderer = (const char *)glGetString(GL_RENDERER);
    canvas->version = (const char *)glGetString(GL_VERSION);
    /* Desktop OpenGL ignores gl_PointSize unless this is enabled. */
    if (gl_desktop())
        glEnable(PROGRAM_POINT_SIZE);
    return check_presents(canvas, message) && make_canvas(canvas, options, message);
}

const CanvasBackend *canvas_backend_load(const CanvasBackend *backend)
{
    return backend && backend->load ? backend->load() : backend;
}

bool canvas_open(Canvas *canvas, const CanvasOptions *options, Message *message)
{
    const CanvasBackend *backend = canvas_backend_load(
        options->backend ? options->backend : canvas_default_backend(CANVAS_HEADLESS, message));
    Canvas opened = {.backend = backend};
    *canvas = (Canvas){0};
    if (!backend)
        return false;
    if (is_open)
        return message_set(message, "canvas: another one is open; close it first");
    cache_prepare_driver();
    if (!backend->open(&opened.context, options, &opened.platform, message))
        return false;
    is_open = true;
    *canvas = opened;
    if (make_first(canvas, options, message))
        return true;
    canvas_close(canvas);
    return false;
}

bool canvas_open_beside(Canvas *canvas, const Canvas *first, const CanvasOptions *options,
                        Message *message)
{
    *canvas = (Canvas){.backend = first->backend,
                       .context = first->context,
                       .beside = true,
                       .platform = first->platform,
                       .renderer = first->renderer,
                       .version = first->version};
    if (make_canvas(canvas, options, message))
        return true;
    canvas_close(canvas);
    return false;
}

void canvas_begin(const Canvas *canvas)
{
    glBindFramebuffer(GL_FRAMEBUFFER, canvas->framebuffer);
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, canvas->width * canvas->supersample, canvas->height * canvas->supersample);
}

void canvas_clear(const Canvas *canvas, Vec3 color, double alpha)
{
    canvas_begin(canvas);
    glClearColor((float)color.x, (float)color.y, (float)color.z, (float)alpha);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

CanvasAttribute canvas_attribute(GLuint location)
{
    CanvasAttribute attribute = {.location = location, .valued = location > 0 || !gl_desktop()};
    glGetVertexAttribiv(location, GL_VERTEX_ATTRIB_ARRAY_ENABLED, &attribute.enabled);
    glGetVertexAttribiv(location, GL_VERTEX_ATTRIB_ARRAY_SIZE, &attribute.size);
    glGetVertexAttribiv(location, GL_VERTEX_ATTRIB_ARRAY_TYPE, &attribute.type);
    glGetVertexAttribiv(location, GL_VERTEX_ATTRIB_ARRAY_NORMALIZED, &attribute.normalized);
    glGetVertexAttribiv(location, GL_VERTEX_ATTRIB_ARRAY_STRIDE, &attribute.stride);
    glGetVertexAttribiv(location, GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING, &attribute.buffer);
    glGetVertexAttribPointerv(location, GL_VERTEX_ATTRIB_ARRAY_POINTER, &attribute.pointer);
    if (attribute.valued)
        glGetVertexAttribfv(location, GL_CURRENT_VERTEX_ATTRIB, attribute.value);
    return attribute;
}

void canvas_set_attribute(const CanvasAttribute *attribute)
{
    glBindBuffer(GL_ARRAY_BUFFER, (GLuint)attribute->buffer);
    glVertexAttribPointer(attribute->location, attribute->size, (GLenum)attribute->type,
                          (GLboolean)attribute->normalized, attribute->stride, attribute->pointer);
    (attribute->enabled ? glEnableVertexAttribArray
                        : glDisableVertexAttribArray)(attribute->location);
    if (attribute->valued)
        glVertexAttrib4fv(attribute->location, attribute->value);
}

void canvas_view(const Canvas *canvas, int x, int y, int width, int height)
{
    const int side = canvas->supersample;
    const int bottom = (canvas->height - y - height) * side;
    glViewport(x * side, bottom, width * side, height * side);
    /* The viewport does not clip large points. */
    glEnable(GL_SCISSOR_TEST);
    glScissor(x * side, bottom, width * side, height * side);
}

static void delete_framebuffers(Canvas *canvas)
{
    const GLuint framebuffers[2] = {canvas->framebuffer, canvas->resolve_framebuffer};
    const GLuint buffers[3] = {canvas->color, canvas->depth, canvas->resolve_color};
    glDeleteFramebuffers(2, framebuffers); /* 0 is ignored */
    glDeleteRenderbuffers(3, buffers);
    canvas->framebuffer = canvas->resolve_framebuffer = 0;
    canvas->color = canvas->depth = canvas->resolve_color = 0;
}

static bool begin_anew(Canvas *canvas, Message *message)
{
    if (!check_size(canvas, message) || !make_framebuffers(canvas, message))
        return false;
    canvas_begin(canvas);
    return true;
}

bool canvas_resize(Canvas *canvas, int width, int height, Message *message)
{
    if (canvas->width == width && canvas->height == height)
        return true;
    delete_framebuffers(canvas);
    canvas->width = width;
    canvas->height = height;
    return begin_anew(canvas, message);
}

int canvas_max_samples(const Canvas *canvas)
{
    const int max = canvas->supersampled ? 0 : driver_max_samples();
    return max > 1 ? max : MAX_SUPERSAMPLE * MAX_SUPERSAMPLE;
}

bool canvas_set_samples(Canvas *canvas, int samples, bool supersampled, Message *message)
{
    Canvas wanted = *canvas;
    wanted.samples = 0;
    wanted.supersample = 1;
    wanted.supersampled = supersampled;
    if (!choose_samples(&wanted, samples, message))
        return false;
    delete_framebuffers(canvas);
    canvas->samples = wanted.samples;
    canvas->supersample = wanted.supersample;
    canvas->supersampled = supersampled;
    return begin_anew(canvas, message);
}

bool canvas_check(const Canvas *canvas, Message *message)
{
    if (!canvas->backend->current(canvas->context))
        return message_set(message,
                           "canvas: its context is no longer current; what was drawn is lost");
    const GLenum reset = glGetGraphicsResetStatus ? glGetGraphicsResetStatus() : GL_NO_ERROR;
    return reset == GL_NO_ERROR ||
           message_set(message, "canvas: %s was reset (%s), and what was drawn is lost; try again",
                       canvas->renderer,
                       reset == GL_GUILTY_CONTEXT_RESET_EXT     ? "by this program"
                       : reset == GL_INNOCENT_CONTEXT_RESET_EXT ? "by another program"
                                                                : "cause unknown");
}

void canvas_close(Canvas *canvas)
{
    if (!canvas)
        return;
    if (canvas->beside) {
        delete_framebuffers(canvas);
    } else if (canvas->context) {
        canvas->backend->close(canvas->context); /* its framebuffers too */
        is_open = false;
    }
    *canvas = (Canvas){0};
}

GLuint canvas_texture(GLenum format, GLenum type, int width, int height)
{
    GLuint texture;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, (GLint)format, width, height, 0, format, type, NULL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
    return texture;
}
