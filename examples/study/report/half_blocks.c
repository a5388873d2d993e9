#include "study/report/half_blocks.h"

#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>

int half_blocks_columns(FILE *file)
{
    enum { LEAST = 60, USUAL = 80 };
    struct winsize window = {.ws_col = 0};
    if (!message_color(MESSAGE_PLAIN, fileno(file))[0])
        return 0;
    if (ioctl(fileno(file), TIOCGWINSZ, &window) != 0 || window.ws_col == 0)
        return USUAL; /* a serial line does not know its size */
    return window.ws_col < LEAST ? 0 : window.ws_col;
}

/* About the luminance: 0.2, 0.7, 0.1. */
static int lightness(const unsigned char *pixel)
{
    return 2 * pixel[0] + 7 * pixel[1] + pixel[2];
}

static const unsigned char *lightest(const Image *image, const int part[4], const int size[2],
                                     int x, int y)
{
    static const unsigned char black[4];
    const unsigned char *found = black;
    for (int v = y * part[3] / size[1]; v < (y + 1) * part[3] / size[1]; v++)
        for (int u = x * part[2] / size[0]; u < (x + 1) * part[2] / size[0]; u++) {
            const unsigned char *pixel = (const unsigned char *)image->pixels +
                                         4 * ((part[1] + v) * image->width + part[0] + u);
            found = lightness(pixel) > lightness(found) ? pixel : found;
        }
    return found;
}

/* Of xterm's 256 colours: a cube of 6 values, 0, 95, 135 to 255, or one of 24 greys, 8, 18 to 238.
 */
static int number_of(const unsigned char color[3])
{
    int number = 16;
    if (abs(color[0] - color[1]) + abs(color[1] - color[2]) < 10 && color[1] < 240)
        return 232 + (color[1] > 8 ? color[1] - 3 : 0) / 10;
    for (int c = 0, place = 36; c < 3; c++, place /= 6)
        number += place * (color[c] < 48 ? 0 : color[c] < 115 ? 1 : (color[c] - 35) / 40);
    return number;
}

static void put_color(const unsigned char color[3], int code, FILE *file)
{
    const char *depth = getenv("COLORTERM");
    if (depth && (strcmp(depth, "truecolor") == 0 || strcmp(depth, "24bit") == 0))
        fprintf(file, "\033[%d;2;%d;%d;%dm", code, color[0], color[1], color[2]);
    else
        fprintf(file, "\033[%d;5;%dm", code, number_of(color));
}

void half_blocks_put(const Image *image, const int part[4], const int size[2], int line, FILE *file)
{
    enum { FOREGROUND = 38, BACKGROUND = 48 };
    for (int x = 0, y = 2 * line; x < size[0]; x++) {
        if (y < size[1])
            put_color(lightest(image, part, size, x, y), FOREGROUND, file);
        if (y + 1 < size[1])
            put_color(lightest(image, part, size, x, y + 1), BACKGROUND, file);
        fputs(y < size[1] ? "\u2580\033[0m" : " ", file);
    }
}
