/*
 * lessons: the nine programs of the lecture, one page each.
 *
 * A page shows the program beside its predecessor, the difference of the two pictures, and which
 * lines of the shaders and of the program changed.
 *
 * Look at the third picture: it is black where the lesson changes nothing.
 */
#include "base/parse.h"
#include "base/paths.h"
#include "core/canvas.h"
#include "core/shader_files.h"
#include "lessons/changes.h"
#include "lessons/page.h"
#include "scene/scene_example.h"

#include <stdio.h>
#include <string.h>

enum { AROUND = 2 }; /* lines beside a change that are shown too */

/* A program and its predecessor, as README.md has them. */
#define LESSON_LIST(X)                                                                             \
    X(LightedCube, NULL)                                                                           \
    X(LightedCube_animation, &LightedCube)                                                         \
    X(LightedCube_ambient, &LightedCube)                                                           \
    X(LightedTranslatedRotatedCube, &LightedCube_ambient)                                          \
    X(PointLightedCube, &LightedTranslatedRotatedCube)                                             \
    X(PointLightedCube_animation, &PointLightedCube)                                               \
    X(PointLightedCube_perFragment, &PointLightedCube_animation)                                   \
    X(PointLightedSphere, &PointLightedCube)                                                       \
    X(PointLightedSphere_perFragment, &PointLightedSphere)

#define DECLARED(name, before) extern const Example name;
#define PAIR(name, before) {&name, before},
#define NAME(name, before) #name,
LESSON_LIST(DECLARED)
static const struct {
    const Example *example, *before;
} LESSONS[] = {LESSON_LIST(PAIR)};
enum { LESSON_COUNT = sizeof LESSONS / sizeof LESSONS[0] };
static const char *const NAMES[] = {LESSON_LIST(NAME) NULL};

static int lesson;
static bool light;

static bool read_lesson(const Parameter *parameter, const char *text, Message *message)
{
    Parameter by_name = *parameter;
    int number;
    by_name.codec = NULL;
    if (!parse_whole(text, 1, LESSON_COUNT, &number))
        return parameter_read(&by_name, text, message);
    *(int *)parameter->value = number - 1;
    return true;
}

static bool write_lesson(const Parameter *parameter, char *text, size_t size)
{
    return snprintf(text, size, "%s", NAMES[*(const int *)parameter->value]) < (int)size;
}

static const ParameterCodec LESSON = {NULL, read_lesson, write_lesson};

static const Parameter parameters[] = {
    {"lesson", "the program that is shown, by name or by number from 1", PARAMETER_CHOICE,
     .value = &lesson, .choices = NAMES, .codec = &LESSON},
    {"light", "dark letters on a white page", PARAMETER_SWITCH, .value = &light},
    {.name = NULL},
};

enum { MAX_ATTRIBUTES = 8 }; /* more than any of the programs has */

/* A program that is ready to draw, although another was opened after it: attributes and the buffer
 * of indices belong to the context. */
typedef struct Slot {
    const Example *example; /* NULL: none */
    CanvasAttribute attributes[MAX_ATTRIBUTES];
    GLint indices;
    Canvas canvas;
    Image picture;
} Slot;

static struct {
    Slot slots[2]; /* PAGE_BEFORE, PAGE_AFTER */
    Image difference;
    Changes changes;
    Image lines; /* the page without pictures; of its size */
} state;

static bool open_slot(Slot *slot, const Example *example, const ShaderLoader *loader,
                      Message *message)
{
    slot->example = example;
    if (!example->init(loader, message))
        return false;
    glGetIntegerv(GL_ELEMENT_ARRAY_BUFFER_BINDING, &slot->indices);
    for (GLuint i = 0; i < MAX_ATTRIBUTES; i++) {
        slot->attributes[i] = canvas_attribute(i);
        glDisableVertexAttribArray(i);
    }
    return true;
}

/* Text files. */

/* The text at a path, which is watched with the loader's files. */
static const char *text_at(const char *path, const ShaderLoader *loader, Message *message)
{
    const ShaderFile *file = shader_files_get(loader->files, path);
    if (file && file->text)
        return file->text;
    if (file)
        message_set(message, "%s: %s", path, file->problem ? file->problem : "no such file");
    return NULL;
}

/* Of a program's shader, which is found as the program finds it, or of its C file. */
static const char *text_of(const Example *example, const char *extension,
                           const ShaderLoader *loader, Message *message)
{
    const ShaderLoader plain = {.folder = loader->folder, .files = loader->files};
    const bool fragment = strcmp(extension, "frag") == 0;
    char name[PATH_MAX], path[PATH_MAX];
    const char *text;
    ShaderSource source;
    snprintf(name, sizeof name, "lecture/%s.%s", example->name, extension);
    if (strcmp(extension, "c") == 0) {
        char in_source[PATH_MAX];
        snprintf(in_source, sizeof in_source, "examples/%.*s", PATH_MAX - 16, name);
        paths_find_data(in_source, name, path);
        return text_at(path, loader, message);
    }
    if (!shader_source_open(&source, &plain, name, fragment ? SHADER_FRAGMENT : SHADER_VERTEX,
                            message))
        return NULL;
    snprintf(path, sizeof path, "%s", source.files[0]);
    shader_source_close(&source);
    text = text_at(path, loader, message);
    /* Below what it is about. */
    const char *line = text && strncmp(text, "//", 2) == 0 ? strchr(text, '\n') : NULL;
    return line ? line + 1 + (line[1] == '\n') : text;
}

/* A title, and below it the changes; of the first program the whole text. */
static bool add_changes(const char *extension, const ShaderLoader *loader, Message *message)
{
    const Example *before = LESSONS[lesson].before, *after = LESSONS[lesson].example;
    Changes found = {.count = 0};
    char title[2 * CHANGE_TEXT_SIZE];
    const bool code = strcmp(extension, "c") == 0;
    ChangeText texts[2] = {{.code = code}, {.name = after->name, .code = code}};
    texts[1].text = text_of(after, extension, loader, message);
    if (before) {
        texts[0].name = before->name;
        texts[0].text = text_of(before, extension, loader, message);
    }
    if (!texts[1].text || (before && !texts[0].text))
        return false;
    int changed = 1;
    if (!before)
        changes_add_text(&found, texts[1].text);
    else if (!changes_between(&found, texts[0], texts[1], code ? 0 : AROUND, &changed, message))
        return false;
    snprintf(title, sizeof title, "%s.%s%s", after->name, extension, changed ? "" : ": as before");
    changes_add(&state.changes, CHANGE_TITLE, title, (int)strlen(title));
    for (int i = 0; i < found.count; i++)
        changes_add(&state.changes, found.lines[i].kind, found.lines[i].text,
                    (int)strlen(found.lines[i].text));
    changes_close(&found);
    return true;
}

static bool init(const ShaderLoader *loader, Message *message)
{
    ShaderFiles read = {.count = 0};
    ShaderLoader own = *loader;
    if (!own.files)
        own.files = &read;
    const Example *before = LESSONS[lesson].before;
    const bool done = (!before || open_slot(&state.slots[PAGE_BEFORE], before, &own, message)) &&
                      open_slot(&state.slots[PAGE_AFTER], LESSONS[lesson].example, &own, message) &&
                      add_changes("vert", &own, message) && add_changes("frag", &own, message) &&
                      (!LESSONS[lesson].before || add_changes("c", &own, message));
    shader_files_close(&read);
    return done;
}

/* The picture that the program draws, in a canvas beside that of the page; opaque where it draws.
 */
static bool draw_slot(Slot *slot, const Frame *frame, const Canvas *page, int side,
                      Message *message)
{
    const CanvasOptions options = {
        .width = side, .height = side, .samples = page->samples, .supersample = page->supersample};
    const Frame own = {.seconds = frame->seconds, .aspect = 1, .orbit = frame->orbit};
    if (slot->canvas.width != side) {
        canvas_close(&slot->canvas);
        image_close(&slot->picture);
        if (!canvas_open_beside(&slot->canvas, page, &options, message))
            return false;
        if (!image_open(&slot->picture, side, side, IMAGE_BYTE, message)) {
            canvas_close(&slot->canvas); /* so that the next frame tries again */
            return false;
        }
    }
    for (int i = 0; i < MAX_ATTRIBUTES; i++)
        canvas_set_attribute(&slot->attributes[i]);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, (GLuint)slot->indices);
    canvas_clear(&slot->canvas, vec3_from_float(slot->example->clear_color), 0);
    slot->example->draw(&own);
    return canvas_read(&slot->canvas, &slot->picture, message);
}

static bool paint_lines(Image *page, Message *message)
{
    Image *lines = &state.lines;
    if (lines->width != page->width || lines->height != page->height) {
        image_close(lines);
        if (!image_open(lines, page->width, page->height, IMAGE_BYTE, message) ||
            !page_paint_lines(lines, &state.changes, light, message)) {
            image_close(lines); /* so that the next frame tries again */
            return false;
        }
    }
    memcpy(page->pixels, lines->pixels, (size_t)page->height * image_row_size(page));
    return true;
}

/* `text` says what differs. */
static bool paint_difference(Image *page, const Frame *frame, char *text, size_t size,
                             Message *message)
{
    const Image *before = &state.slots[PAGE_BEFORE].picture;
    const Image *after = &state.slots[PAGE_AFTER].picture;
    Image *difference = &state.difference;
    char name[40] = "the difference";
    if (difference->width != after->width) {
        image_close(difference);
        if (!image_open(difference, after->width, after->height, IMAGE_BYTE, message))
            return false;
    }
    const PageDifference found = page_difference(before, after, difference);
    if (found.pixels && found.factor > 1)
        snprintf(name, sizeof name, "%d × the difference", found.factor);
    if (found.inside && found.inside < found.largest)
        snprintf(text, size,
                 "at %.2f s: %d pixels differ, by at most %d steps of 255 inside both objects, "
                 "%d elsewhere",
                 frame->seconds, found.pixels, found.inside, found.largest);
    else if (found.pixels)
        snprintf(text, size, "at %.2f s: %d pixels differ, by at most %d steps of 255",
                 frame->seconds, found.pixels, found.largest);
    else
        snprintf(text, size, "at %.2f s: no pixel differs", frame->seconds);
    return page_paint_picture(page, PAGE_DIFFERENCE, difference, name, light, message);
}

static bool paint(const Frame *frame, const Canvas *canvas, Image *page, Message *message)
{
    const int side = page_layout(page->width, page->height).side;
    char title[160], below[120];
    snprintf(title, sizeof title, "lesson %d of %d: %s", lesson + 1, LESSON_COUNT,
             LESSONS[lesson].example->summary);
    snprintf(below, sizeof below, "at %.2f s", frame->seconds);
    if (!paint_lines(page, message))
        return false;
    for (int i = 0; i < 2; i++) {
        Slot *slot = &state.slots[i];
        if (slot->example &&
            (!draw_slot(slot, frame, canvas, side, message) ||
             !page_paint_picture(page, i, &slot->picture, slot->example->name, light, message)))
            return false;
    }
    return (!state.slots[PAGE_BEFORE].example ||
            paint_difference(page, frame, below, sizeof below, message)) &&
           page_paint_captions(page, title, below, light, message);
}

static void finish(void)
{
    for (int i = 0; i < 2; i++) {
        Slot *slot = &state.slots[i];
        if (slot->example)
            slot->example->finish();
        canvas_close(&slot->canvas);
        image_close(&slot->picture);
        slot->example = NULL;
    }
    image_close(&state.difference);
    image_close(&state.lines);
    changes_close(&state.changes);
}

const Example lessons = {
    .name = "lessons",
    .summary = "the nine lecture programs, each beside its predecessor, with what changed",
    .width = 1280,
    .height = 960,
    .tries = {"--lesson 3", "--lesson LightedCube_animation -t 3", "--window"},
    .looks = {"each face is lighter by the same amount", "the light stays, so the faces change",
              "page down and page up step through the nine"},
    .init = init,
    .finish = finish,
    .kind = &PAGES_KIND,
    .content = &(const PageExample){.paint = paint, .seconds = 1},
    .parameters = parameters,
};
