/*
 * Colours for values. A scalar has a place on a scale from the least to the largest; a vector is a
 * direction if all have about length 1, else a place if most have a negative component, else a
 * colour. What is out of order has a colour that no direction and no place of the scale has.
 */
#include "probe/show.h"

#include "base/memory.h"
#include "probe/origin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const double SHOW_LEAST = 0.01;

static const unsigned char NEGATIVE[3] = {0, 128, 255}, CLIPPED[3] = {255, 0, 255},
                           UNDEFINED[3] = {255, 128, 0}, SMALL[3] = {64, 64, 64},
                           OTHER[3] = {160, 160, 160};

/* Lengths of directions: interpolated normals of a coarse mesh are shorter than 1. */
static const double DIRECTION = 0.125;

/* What there is of a value. */
typedef struct Range {
    long shown, negative, clipped, undefined; /* pixels */
    double least, most;                       /* of numbers that are not negative */
    double largest;                           /* component, without its sign */
    int count;                                /* of components */
    bool directions;
} Range;

static double length_of(const ShowPixel *pixel)
{
    double sum = 0;
    for (int i = 0; i < pixel->count; i++)
        sum += (double)pixel->values[i] * (double)pixel->values[i];
    return sqrt(sum);
}

static bool has(const ShowPixel *pixel, bool (*kind)(double value))
{
    for (int i = 0; i < pixel->count; i++)
        if (kind((double)pixel->values[i]))
            return true;
    return false;
}

static bool is_undefined(double value)
{
    return !isfinite(value);
}

static bool is_negative(double value)
{
    return value < 0;
}

static bool is_clipped(double value)
{
    return value > 1;
}

static Range range_of(const Show *show)
{
    Range range = {.least = INFINITY, .directions = true};
    const size_t count = (size_t)show->width * (size_t)show->height;
    for (size_t i = 0; i < count; i++) {
        const ShowPixel *pixel = &show->pixels[i];
        if (!pixel->count)
            continue;
        range.shown++;
        range.count = pixel->count > range.count ? pixel->count : range.count;
        if (has(pixel, is_undefined)) {
            range.undefined++;
            continue;
        }
        range.negative += has(pixel, is_negative);
        range.clipped += has(pixel, is_clipped);
        range.directions &= pixel->count == 3 && fabs(length_of(pixel) - 1) <= DIRECTION;
        for (int k = 0; k < pixel->count; k++) {
            const double value = (double)pixel->values[k];
            range.least = value >= 0 ? fmin(range.least, value) : range.least;
            range.most = fmax(range.most, value);
            range.largest = fmax(range.largest, fabs(value));
        }
    }
    range.directions &= range.shown > range.undefined;
    return range;
}

static void set(unsigned char color[4], const unsigned char value[3])
{
    memcpy(color, value, 3);
}

static unsigned char byte(double value)
{
    return (unsigned char)(origin_step(value) + 0.5);
}

static void put_count(FILE *legend, long count, const char *what)
{
    if (count)
        fprintf(legend, "; %s: %ld pixels", what, count);
}

/* One number. */
static void paint_scalars(const Show *show, const Range *range, Image *picture, FILE *legend)
{
    const double least = range->least <= range->most ? range->least : 0;
    const double width = range->most - least;
    for (int i = 0; i < show->width * show->height; i++) {
        const ShowPixel *pixel = &show->pixels[i];
        const double value = (double)pixel->values[0];
        unsigned char *color = (unsigned char *)picture->pixels + 4 * (size_t)i;
        if (!pixel->count)
            continue;
        if (is_undefined(value))
            set(color, UNDEFINED);
        else if (is_negative(value))
            set(color, NEGATIVE);
        else
            image_viridis(width > 0 ? (value - least) / width : 1, color);
    }
    fprintf(legend, "%s: from %.6g, dark violet, to %.6g, yellow", show->what, least, range->most);
    put_count(legend, range->negative, "negative, in azure");
}

/* Two to four. */
static void paint_vectors(const Show *show, const Range *range, Image *picture, FILE *legend)
{
    const bool colors = !range->directions && 2 * range->negative <= range->shown;
    const double scale = range->directions ? 1 : range->largest;
    for (int i = 0; i < show->width * show->height; i++) {
        const ShowPixel *pixel = &show->pixels[i];
        unsigned char *color = (unsigned char *)picture->pixels + 4 * (size_t)i;
        if (!pixel->count)
            continue;
        for (int k = 0; k < 3 && k < pixel->count; k++) {
            const double value = (double)pixel->values[k];
            color[k] = byte(colors ? value : 0.5 + 0.5 * value / scale);
        }
        if (has(pixel, is_undefined))
            set(color, UNDEFINED);
        else if (colors && has(pixel, is_negative))
            set(color, NEGATIVE);
        else if (colors && has(pixel, is_clipped))
            set(color, CLIPPED);
    }
    if (colors) {
        fprintf(legend, "%s: as a colour, from %.6g to %.6g", show->what,
                range->least <= range->most ? range->least : 0, range->most);
        put_count(legend, range->negative, "negative, in azure");
        put_count(legend, range->clipped, "over 1, in magenta");
    } else if (range->directions) {
        fprintf(legend, "%s: directions, each component c as 0.5 + 0.5 c", show->what);
    } else {
        fprintf(legend, "%s: each component c as 0.5 + 0.5 c / %.6g", show->what, scale);
    }
}

static double error_of(const ShowPixel *pixel)
{
    double error = 0;
    for (int k = 0; k < pixel->count; k++)
        error = fmax(error, fabs((double)pixel->values[k]));
    return error;
}

/* On a logarithmic scale, because errors of neighbours may differ a thousandfold. */
static void paint_errors(const Show *show, const Range *range, Image *picture, FILE *legend)
{
    const double decades = log(fmax(range->largest, 2 * SHOW_LEAST) / SHOW_LEAST);
    long half = 0;
    for (int i = 0; i < show->width * show->height; i++) {
        const ShowPixel *pixel = &show->pixels[i];
        unsigned char *color = (unsigned char *)picture->pixels + 4 * (size_t)i;
        const double error = error_of(pixel);
        if (!pixel->count)
            continue;
        half += error > 0.5;
        if (has(pixel, is_undefined))
            set(color, UNDEFINED);
        else if (error < SHOW_LEAST)
            set(color, SMALL);
        else
            image_viridis(log(error / SHOW_LEAST) / decades, color);
    }
    fprintf(legend,
            "%s: from %g, dark violet, to %.3g steps of 1/255, yellow, on a logarithmic scale; "
            "less, in dark grey; over half a step: %ld of %ld pixels",
            show->what, SHOW_LEAST, range->largest, half, range->shown);
}

/* Blame */

/* A line, the same in all programs that have it. */
typedef struct Line {
    char name[PLACE_TEXT], text[PLACE_TEXT];
    int draw; /* that blames it first */
    GlslPlace place;
    long pixels;
} Line;

static void describe(const Show *show, const ShowPixel *pixel, Line *line)
{
    const char *source = show->capture->draws[pixel->draw].sources[1];
    *line = (Line){.draw = pixel->draw, .place = pixel->place};
    if (pixel->place.line > 0) {
        place_name(source, pixel->place, line->name);
        place_line(source, pixel->place, line->text);
    } else {
        snprintf(line->name, sizeof line->name, "the vertex shader");
    }
}

/* The number of the line that a pixel blames, which is added if it is new. */
static int line_of(const Show *show, const ShowPixel *pixel, Line **lines, int *count, int *room)
{
    Line line;
    const char *source = show->capture->draws[pixel->draw].sources[1];
    for (int i = 0; i < *count; i++) {
        const Line *known = &(*lines)[i];
        if (known->place.line == pixel->place.line && known->place.file == pixel->place.file &&
            show->capture->draws[known->draw].sources[1] == source)
            return i;
    }
    describe(show, pixel, &line);
    for (int i = 0; i < *count; i++)
        if (strcmp((*lines)[i].name, line.name) == 0 && strcmp((*lines)[i].text, line.text) == 0)
            return i;
    *(Line *)memory_add(lines, count, room, sizeof line) = line;
    return *count - 1;
}

static int more_pixels(const void *a, const void *b)
{
    const long x = ((const Line *)a)->pixels, y = ((const Line *)b)->pixels;
    return (x < y) - (x > y);
}

/* Colours that those who see fewer can tell apart, too (Okabe and Ito, Color universal design,
 * 2008). */
static const struct {
    const char *name;
    unsigned char color[3];
} PALETTE[] = {{"orange", {230, 159, 0}},
               {"sky blue", {86, 180, 233}},
               {"bluish green", {0, 158, 115}},
               {"yellow", {240, 228, 66}},
               {"blue", {0, 114, 178}},
               {"vermilion", {213, 94, 0}},
               {"reddish purple", {204, 121, 167}}};
enum { COLORS = sizeof PALETTE / sizeof PALETTE[0] };

static void paint_blame(const Show *show, Image *picture, FILE *legend)
{
    Line *lines = NULL;
    int count = 0, room = 0;
    long small = 0;
    const int pixels = show->width * show->height;
    for (int i = 0; i < pixels; i++) {
        if (show->pixels[i].count && show->pixels[i].place.line < 0)
            small++;
        else if (show->pixels[i].count) {
            const int line = line_of(show, &show->pixels[i], &lines, &count, &room);
            lines[line].pixels++;
        }
    }
    if (count)
        qsort(lines, (size_t)count, sizeof *lines, more_pixels);
    for (int i = 0; i < pixels; i++) {
        const ShowPixel *pixel = &show->pixels[i];
        unsigned char *color = (unsigned char *)picture->pixels + 4 * (size_t)i;
        if (pixel->count && pixel->place.line < 0)
            set(color, SMALL);
        else if (pixel->count) {
            const int line = line_of(show, pixel, &lines, &count, &room);
            set(color, line < COLORS ? PALETTE[line].color : OTHER);
        }
    }
    fprintf(legend, "blame: the line in which most of a pixel's error by rounding is born\n");
    for (int i = 0; i < count; i++)
        fprintf(legend, "%8ld pixels, %s: %s%s%s\n", lines[i].pixels,
                i < COLORS ? PALETTE[i].name : "light grey", lines[i].name,
                lines[i].text[0] ? ": " : "", lines[i].text);
    fprintf(legend, "%8ld pixels, dark grey: off by less than a hundredth of a step\n", small);
    free(lines);
}

void show_paint(const Show *show, Image *picture, FILE *legend)
{
    const Range range = range_of(show);
    unsigned char *bytes = picture->pixels;
    for (size_t i = 0; i < (size_t)show->width * (size_t)show->height; i++)
        memcpy(bytes + 4 * i, (unsigned char[4]){0, 0, 0, 255}, 4);
    if (show->kind == SHOW_BLAME) {
        paint_blame(show, picture, legend);
        return;
    }
    if (show->kind == SHOW_ERROR)
        paint_errors(show, &range, picture, legend);
    else if (range.count > 1)
        paint_vectors(show, &range, picture, legend);
    else
        paint_scalars(show, &range, picture, legend);
    put_count(legend, range.undefined, "no number, in orange");
    fprintf(legend, "; black: no triangle%s\n", range.shown ? "" : ": nothing here computes it");
}
