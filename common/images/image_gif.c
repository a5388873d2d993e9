/*
 * Animated GIF files (GIF89a specification, sections 17 to 27): 256 colors per picture, compressed
 * by LZW (Welch, 1984).
 *
 * Up to 256 colors are kept. Of more, beginning with one box of all, a box is split where that
 * lessens the sum of squared errors most (Wu, Efficient statistical computations for optimal color
 * quantization, 1991); then the means of the boxes are moved to the means of the colors that are
 * nearest to each (Lloyd, 1982). Thousands of colors are counted in cells, of 2 or 4 steps a side.
 * An ordered dither, as strong as the colors are apart, hides bands and does not flicker.
 *
 * A picture is shown for a whole number of hundredths of a second, and at 30 per second no number
 * is right: 3 makes 33 per second. So delays differ: picture i begins at the hundredth nearest to
 * i / fps, and is shown until the next begins, which keeps the error below half a hundredth however
 * long the animation is.
 */
#include "base/memory.h"
#include "images/image_options.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    COLORS = 256,
    LEVELS = 256, /* of a channel */
    COARSEST = 2, /* cells have up to 1 << 2 steps a side: there are up to 1 << 18 */
    MANY = 8192,  /* cells, if they can be coarser */
    PLACE_BITS = 19,
    NEAREST_BITS = 16,
    CODES = 4096, /* of LZW */
    STRING_BITS = 14
};

/* The sums of its pixels' channels, and how many. */
typedef struct Cell {
    double sums[4];
    int color; /* red << 16 | green << 8 | blue, without the bits that it leaves out */
} Cell;

/* Cells of one color; the split that lessens the error most is by levels of an axis up to a cut. */
typedef struct Box {
    int first, end;
    double all[4]; /* their sums */
    int axis, cut;
    double gain;
} Box;

struct ImageGif {
    FILE *file;
    double fps;
    int added;
    size_t pixels; /* of a picture */
    unsigned char *indices;
    Cell *cells;
    int cell_count, room, coarse; /* the bits that they leave out of a channel */
    int places[1 << PLACE_BITS];  /* a hash table of cells: 1 + its number, or 0 */
    int asked[1 << NEAREST_BITS]; /* 1 + the color whose nearest was found last; 0: none */
    unsigned char nearest[1 << NEAREST_BITS];
    short palette[3][COLORS];
    int color_count;
    int strings[1 << STRING_BITS]; /* a hash table of LZW: 1 + prefix << 8 | byte, or 0 */
    short codes[1 << STRING_BITS];
    unsigned char block[256]; /* a length, and so many bytes */
    unsigned bits, bit_count; /* that are not in it yet */
};

static bool gif_failed(int error, Message *message)
{
    return message_set(message, "GIF: %s", strerror(error));
}

static void put_16(ImageGif *gif, long value)
{
    putc((int)(value & 255), gif->file);
    putc((int)(value >> 8 & 255), gif->file);
}

bool image_gif_open(ImageGif **opened, FILE *file, int width, int height, double fps,
                    Message *message)
{
    ImageGif *gif = *opened = memory_new(1, sizeof *gif);
    gif->file = file;
    gif->fps = fps;
    if (!file)
        return gif_failed(errno, message);
    gif->pixels = (size_t)width * (size_t)height;
    gif->indices = malloc(gif->pixels);
    if (!gif->indices)
        return gif_failed(ENOMEM, message);
    fputs("GIF89a", gif->file);
    put_16(gif, width);
    put_16(gif, height);
    fwrite("\0\0\0!\xff\x0bNETSCAPE2.0\x03\x01\0\0", 1, 22, gif->file); /* loops forever */
    return true;
}

/* Multiplicative. (Knuth, The art of computer programming, volume 3, section 6.4) */
static unsigned hash(int key, int bits)
{
    return (unsigned)key * 0x9E3779B1u >> (32 - bits);
}

static int coarse_color(const ImageGif *gif, const unsigned char pixel[3])
{
    return (pixel[0] << 16 | pixel[1] << 8 | pixel[2]) &
           (0xFF >> gif->coarse << gif->coarse) * 0x10101;
}

/* False: there are too many, and cells can be coarser. */
static bool count_cells(ImageGif *gif, const Image *image)
{
    const unsigned char *pixel = image->pixels, *end = pixel + 4 * gif->pixels;
    memset(gif->places, 0, sizeof gif->places);
    for (gif->cell_count = 0; pixel < end; pixel += 4) {
        const int color = coarse_color(gif, pixel);
        unsigned at = hash(color, PLACE_BITS);
        while (gif->places[at] && gif->cells[gif->places[at] - 1].color != color)
            at = (at + 1) % (1 << PLACE_BITS);
        if (!gif->places[at]) {
            if (gif->cell_count == MANY && gif->coarse < COARSEST)
                return false;
            *(Cell *)memory_add(&gif->cells, &gif->cell_count, &gif->room, sizeof *gif->cells) =
                (Cell){.color = color};
            gif->places[at] = gif->cell_count;
        }
        double *sums = gif->cells[gif->places[at] - 1].sums;
        for (int c = 0; c < 3; c++)
            sums[c] += pixel[c];
        sums[3]++;
    }
    return true;
}

static int level_of(const Cell *cell, int axis)
{
    return cell->color >> (16 - 8 * axis) & 255;
}

/* The squared length of a sum over its weight: what a mean in its place takes off the error. */
static double taken(const double sums[4])
{
    return sums[3] > 0 ? (sums[0] * sums[0] + sums[1] * sums[1] + sums[2] * sums[2]) / sums[3] : 0;
}

static Box box_of(const ImageGif *gif, int first, int end)
{
    Box box = {.first = first, .end = end};
    for (int i = first; i < end; i++)
        for (int c = 0; c < 4; c++)
            box.all[c] += gif->cells[i].sums[c];
    for (int axis = 0; axis < 3; axis++) {
        double levels[LEVELS][4] = {{0}}, below[4] = {0}, above[4];
        for (int i = first; i < end; i++)
            for (int c = 0; c < 4; c++)
                levels[level_of(&gif->cells[i], axis)][c] += gif->cells[i].sums[c];
        for (int level = 0; level < LEVELS - 1; level++) {
            if (levels[level][3] == 0)
                continue;
            for (int c = 0; c < 4; c++) {
                below[c] += levels[level][c];
                above[c] = box.all[c] - below[c];
            }
            const double gain = above[3] > 0 ? taken(below) + taken(above) - taken(box.all) : 0;
            if (gain > box.gain) {
                box.gain = gain;
                box.axis = axis;
                box.cut = level;
            }
        }
    }
    return box;
}

/* The loop has a fixed length, so that it is compiled to vector operations: there are COLORS. */
static int nearest_color(const ImageGif *gif, const short color[3])
{
    const short red = color[0], green = color[1], blue = color[2];
    int least = 1 << 30;
    for (int i = 0; i < COLORS; i++) {
        const short r = (short)(red - gif->palette[0][i]);
        const short g = (short)(green - gif->palette[1][i]);
        const short b = (short)(blue - gif->palette[2][i]);
        const int distance = (r * r + g * g + b * b) << 8 | i;
        least = distance < least ? distance : least;
    }
    return least & 255;
}

/* Moves colors to the means of the cells whose nearest they are. Returns how far these were, as
 * root mean square of those that were apart, in steps. */
static double move_colors(ImageGif *gif)
{
    double sums[COLORS][4] = {{0}}, error = 0, pixels = 1e-9;
    for (int i = 0; i < gif->cell_count; i++) {
        const double *own = gif->cells[i].sums;
        short mean[3];
        int apart = 0;
        for (int c = 0; c < 3; c++)
            mean[c] = (short)lrint(own[c] / own[3]);
        const int color = nearest_color(gif, mean);
        for (int c = 0; c < 3; c++)
            apart += (mean[c] - gif->palette[c][color]) * (mean[c] - gif->palette[c][color]);
        for (int c = 0; c < 4; c++)
            sums[color][c] += own[c];
        error += apart * own[3];
        pixels += apart ? own[3] : 0;
    }
    for (int i = 0; i < COLORS; i++)
        for (int c = 0; c < 3 && sums[i][3] > 0; c++)
            gif->palette[c][i] = (short)lrint(sums[i][c] / sums[i][3]);
    return sqrt(error / pixels);
}

/* Cells of the box with the most to gain go to a new one. False: there is none to split. */
static bool split_box(const ImageGif *gif, Box boxes[], int count)
{
    Box *best = boxes;
    for (int i = 1; i < count; i++)
        if (boxes[i].gain > best->gain)
            best = &boxes[i];
    int middle = best->first;
    for (int i = best->first; i < best->end && best->gain > 0; i++)
        if (level_of(&gif->cells[i], best->axis) <= best->cut) {
            const Cell cell = gif->cells[i];
            gif->cells[i] = gif->cells[middle];
            gif->cells[middle++] = cell;
        }
    if (middle == best->first)
        return false;
    boxes[count] = box_of(gif, middle, best->end);
    *best = box_of(gif, best->first, middle);
    return true;
}

/* Returns move_colors. */
static double choose_colors(ImageGif *gif)
{
    Box boxes[COLORS];
    boxes[0] = box_of(gif, 0, gif->cell_count);
    gif->color_count = 1;
    while (gif->color_count < COLORS && split_box(gif, boxes, gif->color_count))
        gif->color_count++;
    for (int i = 0; i < COLORS; i++)
        for (int c = 0; c < 3; c++) {
            const double *all = boxes[i < gif->color_count ? i : 0].all;
            gif->palette[c][i] = (short)lrint(all[c] / all[3]);
        }
    move_colors(gif);
    return move_colors(gif);
}

/* The threshold of an ordered dither of 8x8 pixels (Bayer, 1973), from 0 to 63. */
static int threshold(int x, int y)
{
    int found = 0;
    for (int bit = 0; bit < 3; bit++)
        found = found << 2 | ((x ^ y) >> bit & 1) << 1 | (y >> bit & 1);
    return found;
}

/* `strength`: in steps, from the least to the most that is added to a pixel. */
static void dither(ImageGif *gif, const Image *image, int strength)
{
    const unsigned char *pixel = image->pixels;
    memset(gif->asked, 0, sizeof gif->asked);
    for (size_t i = 0; i < gif->pixels; i++, pixel += 4) {
        const int x = (int)(i % (size_t)image->width), y = (int)(i / (size_t)image->width);
        const int more = threshold(x, y) * (strength + 1) / 64 - strength / 2;
        unsigned char color[3];
        for (int c = 0; c < 3; c++) { /* black stays */
            const int value = pixel[c] ? pixel[c] + more : 0;
            color[c] = (unsigned char)(value < 0 ? 0 : value > 255 ? 255 : value);
        }
        const int coarse = coarse_color(gif, color);
        const unsigned at = hash(coarse, NEAREST_BITS);
        if (gif->asked[at] != 1 + coarse) {
            gif->asked[at] = 1 + coarse;
            gif->nearest[at] =
                (unsigned char)nearest_color(gif, (short[]){color[0], color[1], color[2]});
        }
        gif->indices[i] = gif->nearest[at];
    }
}

static void put_code(ImageGif *gif, int code, int size)
{
    gif->bits |= (unsigned)code << gif->bit_count;
    for (gif->bit_count += (unsigned)size; gif->bit_count >= 8; gif->bit_count -= 8) {
        gif->block[++gif->block[0]] = (unsigned char)gif->bits;
        gif->bits >>= 8;
        if (gif->block[0] == 255) {
            fwrite(gif->block, 1, 256, gif->file);
            gif->block[0] = 0;
        }
    }
}

/* `depth`: the bits of an index, at least 2. */
static void put_indices(ImageGif *gif, int depth)
{
    const int clear = 1 << depth;
    int next = CODES, size = depth + 1, prefix = clear; /* as if the table was full */
    gif->block[0] = 0;
    gif->bits = gif->bit_count = 0;
    putc(depth, gif->file);
    for (size_t i = 0; i < gif->pixels; i++) {
        const int key = 1 + (prefix << 8 | gif->indices[i]);
        unsigned at = hash(key, STRING_BITS);
        while (gif->strings[at] && gif->strings[at] != key)
            at = (at + 1) % (1 << STRING_BITS);
        if (i > 0 && gif->strings[at]) {
            prefix = gif->codes[at];
            continue;
        }
        put_code(gif, prefix, size);
        prefix = gif->indices[i];
        if (next < CODES) {
            gif->strings[at] = key;
            gif->codes[at] = (short)next;
            size += next++ == 1 << size;
            continue;
        }
        if (i > 0)
            put_code(gif, clear, size);
        memset(gif->strings, 0, sizeof gif->strings);
        next = clear + 2;
        size = depth + 1;
    }
    put_code(gif, prefix, size);
    put_code(gif, clear + 1, size + (next == 1 << size && next < CODES));
    put_code(gif, 0, 7); /* fills a byte */
    fwrite(gif->block, 1, (size_t)gif->block[0] + 1, gif->file);
    if (gif->block[0])
        putc(0, gif->file);
}

/* In hundredths of a second, when picture `number` begins. */
static long moment(const ImageGif *gif, int number)
{
    return lround(100 * number / gif->fps);
}

bool image_gif_add(ImageGif *gif, const Image *image, Message *message)
{
    int depth = 2;
    errno = 0;
    for (gif->coarse = 0; !count_cells(gif, image);)
        gif->coarse++;
    const double apart = choose_colors(gif);
    dither(gif, image, (int)lrint(apart));
    while (1 << depth < gif->color_count)
        depth++;
    fwrite("!\xf9\x04\x04", 1, 4, gif->file);
    put_16(gif, moment(gif, gif->added + 1) - moment(gif, gif->added));
    fwrite("\0\0,\0\0\0\0", 1, 7, gif->file);
    put_16(gif, image->width);
    put_16(gif, image->height);
    putc(0x80 | (depth - 1), gif->file);
    for (int i = 0; i < 1 << depth; i++)
        for (int c = 0; c < 3; c++)
            putc(i < gif->color_count ? gif->palette[c][i] : 0, gif->file);
    put_indices(gif, depth);
    gif->added++;
    return (fflush(gif->file) == 0 && !ferror(gif->file)) ||
           gif_failed(errno ? errno : EIO, message);
}

bool image_gif_close(ImageGif *gif, Message *message)
{
    if (!gif)
        return true;
    bool done = true;
    if (gif->file) {
        putc(0x3B, gif->file);
        done = fclose(gif->file) == 0 || gif_failed(errno, message);
    }
    free(gif->indices);
    free(gif->cells);
    free(gif);
    return done;
}
