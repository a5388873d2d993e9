/*
 * Between vertices and pixels: a triangle is drawn whose varyings are known exactly at every
 * pixel's centre, read back as floats, and compared. Triangles of many sizes and depths tell errors
 * of interpolation with and without perspective; two that share an edge tell whether each pixel on
 * it is drawn once; planes moved towards the eye step by step tell the bits of depth. Nothing that
 * the driver says of itself is used.
 */
#include "study/arithmetic/arithmetic.h"

#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>

/* A corner: clip coordinates and a varying. */
typedef struct Corner {
    float position[4], value[4];
} Corner;

enum { CORNERS = 4 }; /* at most, of a strip */

static void draw_strip(GLuint program, GLenum mode, const Corner *corners, int count)
{
    const GLuint position = (GLuint)glGetAttribLocation(program, "a_Position");
    const GLuint value = (GLuint)glGetAttribLocation(program, "a_A");
    glUseProgram(program);
    glUniform1fv(glGetUniformLocation(program, "u_One"), 1, (const float[]){1});
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glVertexAttribPointer(position, 4, GL_FLOAT, GL_FALSE, sizeof(Corner), corners->position);
    glVertexAttribPointer(value, 4, GL_FLOAT, GL_FALSE, sizeof(Corner), corners->value);
    glEnableVertexAttribArray(position);
    glEnableVertexAttribArray(value);
    glDrawArrays(mode, 0, count);
    glDisableVertexAttribArray(position);
    glDisableVertexAttribArray(value);
}

/* The window coordinates of a corner; row 0 is the lowest, as OpenGL has it. */
static void window_of(const Canvas *canvas, const Corner *corner, double at[2])
{
    const double w = (double)corner->position[3];
    at[0] = ((double)corner->position[0] / w + 1) * canvas->width / 2;
    at[1] = ((double)corner->position[1] / w + 1) * canvas->height / 2;
}

/* Twice the signed area of a triangle. */
static double area_of(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* The exact values of a varying at a point (OpenGL ES 2.0 specification, section 3.5.1): weights
 * a / w, whose sum makes them 1. `at`: the corners' window coordinates. */
static void values_at(const Corner corners[3], double at[3][2], const double point[2],
                      double values[4])
{
    double sums[4] = {0}, weights = 0;
    for (int i = 0; i < 3; i++) {
        const double weight =
            area_of(at[(i + 1) % 3], at[(i + 2) % 3], point) / (double)corners[i].position[3];
        for (int c = 0; c < 4; c++)
            sums[c] += weight * (double)corners[i].value[c];
        weights += weight;
    }
    for (int c = 0; c < 4; c++)
        values[c] = sums[c] / weights;
}

static Corner random_corner(Random *random, const Canvas *canvas, double x, double y, double w)
{
    Corner corner;
    corner.position[0] = (float)((2 * x / canvas->width - 1) * w);
    corner.position[1] = (float)((2 * y / canvas->height - 1) * w);
    corner.position[2] = 0;
    corner.position[3] = (float)w;
    for (int i = 0; i < 4; i++)
        corner.value[i] = (float)random_between(random, -1, 1);
    corner.value[3] = (float)random_between(random, 0.5, 1); /* what is drawn is not 0 */
    return corner;
}

/* A pixel of floats, of what was read. */
static const float *pixel_of(const Canvas *canvas, const float *pixels, int x, int y)
{
    return pixels + 4 * ((size_t)y * (size_t)canvas->width + (size_t)x);
}

static void read_floats(const Canvas *canvas, float *pixels)
{
    glReadPixels(0, 0, canvas->width, canvas->height, GL_RGBA, GL_FLOAT, pixels);
}

/* A square of pixels with a triangle: of about so many pixels, and a part of that; what the
 * corners' values differ by; w is from 1 to so much. */
typedef struct Cell {
    int x, y, size;
    double side, height, share, depth;
    Corner corners[3];
} Cell;

/* The largest error in what was drawn, in raster_units. */
static double error_of(const Canvas *canvas, const Cell *cell, int bits, const float *pixels)
{
    double largest = 0, at[3][2], units[4], exact[4];
    RasterNumber numbers[8]; /* x, y, z, w, and what it hands over */
    RasterTriangle triangle;
    for (int k = 0; k < 8; k++)
        for (int i = 0; i < 3; i++) {
            const Corner *of = &cell->corners[i];
            const double number =
                (double)(k < 4 ? of->position[k] : of->value[k - 4]) - (i ? numbers[k][0].low : 0);
            numbers[k][i] = (GlslRange){number, number};
        }
    for (int k = 0; k < 3; k++)
        memcpy(triangle.place[k], numbers[k + k / 2], sizeof *numbers);
    raster_triangle(&triangle, (double[]){canvas->width / 2., canvas->height / 2.}, bits);
    for (int i = 0; i < 3; i++)
        window_of(canvas, &cell->corners[i], at[i]);
    for (int c = 0; c < 4; c++)
        units[c] = raster_units(&triangle, numbers[4 + c]);
    for (int i = 0; i < cell->size * cell->size; i++) {
        const int x = cell->x + i % cell->size, y = cell->y + i / cell->size;
        const float *pixel = pixel_of(canvas, pixels, x, y);
        if (pixel[3] == 0)
            continue;
        values_at(cell->corners, at, (double[]){x + 0.5, y + 0.5}, exact);
        for (int c = 0; c < 4; c++)
            largest = fmax(largest, fabs((double)pixel[c] - exact[c]) * 0x1p24 / units[c]);
    }
    return largest;
}

/* Its angles are not very small, but for its height. */
static void random_triangle(const Canvas *canvas, Random *random, Cell *cell)
{
    const double half = cell->side / 2, room = cell->size - cell->side;
    const double x = cell->x + half + random_between(random, 0, room);
    const double y = cell->y + half + random_between(random, 0, room);
    const double turn = random_between(random, 0, 6.28), lies = random_between(random, 0, 6.28);
    for (int i = 0; i < 3; i++) {
        Corner *made = &cell->corners[i];
        const double angle = turn + 2.1 * i + random_between(random, -0.5, 0.5);
        const double along = half * cos(angle), across = half * sin(angle) * cell->height;
        *made = random_corner(random, canvas, x + along * cos(lies) - across * sin(lies),
                              y + along * sin(lies) + across * cos(lies),
                              random_between(random, 1, cell->depth));
        for (int c = 0; c < 4 && i; c++)
            made->value[c] -=
                (1 - (float)cell->share) * (made->value[c] - cell->corners[0].value[c]);
    }
}

static void varyings(const Canvas *canvas, GLuint program, Raster *raster, float *pixels)
{
    enum { PICTURES = 6, CELLS = 32 };
    static const double SIZES[] = {240, 60, 20, 6, 3}, DEPTHS[] = {1, 1.2, 8};
    Random random = {240};
    Cell cells[CELLS];
    for (int n = 0; n < 5 * 3 * 2 * 2 * PICTURES; n++) {
        const double side = SIZES[n / PICTURES / 12];
        const int size = side > 64 ? 256 : 64, columns = canvas->width / size;
        const int count = side > 64 ? 2 : CELLS; /* the canvas has 512x256 pixels */
        canvas_clear(canvas, (Vec3){0, 0, 0}, 0);
        for (int i = 0; i < count; i++) {
            cells[i] = (Cell){
                size * (i % columns), size * (i / columns), size,        side, n % 2 ? .1 : 1,
                n / 2 % 2 ? .01 : 1,  DEPTHS[n / 4 % 3],    {{{0}, {0}}}};
            random_triangle(canvas, &random, &cells[i]);
            draw_strip(program, GL_TRIANGLES, cells[i].corners, 3);
        }
        read_floats(canvas, pixels);
        for (int i = 0; i < count; i++)
            raster->units =
                fmax(raster->units, error_of(canvas, &cells[i], raster->subpixel_bits, pixels));
    }
}

/* The distance of a pixel's center from a line, in pixels. */
static double distance_of(const double a[2], const double b[2], const double point[2])
{
    return fabs(area_of(a, b, point)) / hypot(b[0] - a[0], b[1] - a[1]);
}

/* Convex quadrilaterals of two triangles that share an edge. Each triangle adds 1 to a pixel. */
static void shared_edges(const Canvas *canvas, GLuint program, Raster *raster, float *pixels)
{
    Random random = {3};
    glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
    for (int n = 0; n < 40; n++) {
        Corner corners[CORNERS];
        double at[CORNERS][2];
        const double turn = random_between(&random, 0, 6.28);
        static const double angles[CORNERS] = {0, 1.6, -1.5, 3.1};
        for (int i = 0; i < CORNERS; i++) {
            const double angle = turn + angles[i] + random_between(&random, -0.3, 0.3);
            corners[i] =
                random_corner(&random, canvas, 256 + 120 * cos(angle), 128 + 120 * sin(angle), 1);
            corners[i].value[3] = 1;
            window_of(canvas, &corners[i], at[i]);
        }
        canvas_clear(canvas, (Vec3){0, 0, 0}, 0);
        glEnable(GL_BLEND);
        draw_strip(program, GL_TRIANGLE_STRIP, corners, 4);
        glDisable(GL_BLEND);
        read_floats(canvas, pixels);
        for (int y = 0; y < canvas->height; y++)
            for (int x = 0; x < canvas->width; x++) {
                const double point[2] = {x + 0.5, y + 0.5};
                const double along = (point[0] - at[1][0]) * (at[2][0] - at[1][0]) +
                                     (point[1] - at[1][1]) * (at[2][1] - at[1][1]);
                const double length = hypot(at[2][0] - at[1][0], at[2][1] - at[1][1]);
                /* Away from its ends, where the outline is. */
                if (distance_of(at[1], at[2], point) > 0.71 || along < 4 * length ||
                    along > (length - 4) * length)
                    continue;
                const float *pixel = pixel_of(canvas, pixels, x, y);
                raster->edge_pixels++;
                raster->edge_missed += pixel[3] == 0;
                raster->edge_twice += pixel[3] > 1.5f;
            }
    }
    glBlendFuncSeparate(GL_ONE, GL_ZERO, GL_ONE, GL_ZERO);
}

/* All kinds of values from 0 to 1, ties included, to bytes. */
static bool bytes(const Meter *meter, Raster *raster, Message *message)
{
    const Canvas *first = &meter->canvas;
    const CanvasOptions options = {.width = first->width, .height = first->height};
    const int count = first->width * first->height;
    float(*values)[4] = memory_new((size_t)count, sizeof *values);
    unsigned char(*drawn)[4] = memory_new((size_t)count, sizeof *drawn);
    Meter byte_meter = *meter;
    const GLuint program = meter_copy(METER_FRAGMENT, message);
    const bool done = program && canvas_open_beside(&byte_meter.canvas, first, &options, message);
    if (done) {
        for (int i = 0; i < 4 * count; i++)
            values[i / 4][i % 4] =
                i < 510 ? (float)((i + 0.5) / 510) : (float)i / (float)(4 * count - 1);
        meter_load(meter, (const float(*)[4])values, (const float(*)[4])values, count);
        meter_draw(&byte_meter, program, METER_FRAGMENT, count);
        glReadPixels(0, 0, first->width, first->height, GL_RGBA, GL_UNSIGNED_BYTE, drawn);
        double above = 0, below = 0;
        for (int i = 0; i < 4 * count; i++) {
            const double error = drawn[i / 4][i % 4] - 255 * (double)values[i / 4][i % 4];
            above = fmax(above, error);
            below = fmax(below, -error);
        }
        raster->bytes = fmax(above, below);
        /* Cut, it is up to 255 / 2^color_bits steps too small, and never too large. */
        raster->color_bits =
            below - 0.5 > 0.01 && above < 0.501 ? (int)lrint(log2(255 / (below - 0.5))) : 0;
        canvas_close(&byte_meter.canvas);
    }
    glDeleteProgram(program);
    free(values);
    free(drawn);
    return done;
}

/* An edge that moves one pixel to the right over ROWS rows: how many rows of a column it covers
 * tells its position to 1 / ROWS of a pixel. It is moved by steps of 1 / 1024, within a quarter of
 * a pixel, and as many positions as differ are resolved. */
enum { SUBPIXEL_ROWS = 4096, SUBPIXEL_STEPS = 1 << RASTER_SUBPIXELS };

static void draw_slope(const Canvas *canvas, GLuint program, int column, double offset)
{
    const double x[3] = {column - 2, column + offset, column + offset + 1};
    Corner corners[3];
    for (int i = 0; i < 3; i++) {
        corners[i] =
            (Corner){{(float)(2 * x[i] / canvas->width - 1), i == 2 ? 1 : -1, 0, 1}, {1, 1, 1, 1}};
    }
    draw_strip(program, GL_TRIANGLES, corners, 3);
}

static bool subpixels(const Canvas *first, GLuint program, Raster *raster, Message *message)
{
    enum { WIDTH = 256, APART = 4, QUARTER = SUBPIXEL_STEPS / 4 };
    const CanvasOptions options = {.width = WIDTH, .height = SUBPIXEL_ROWS};
    Canvas canvas;
    Image image = {.pixels = NULL};
    int covered[QUARTER], positions = 1;
    GLint claimed = 0;
    if (!canvas_open_beside(&canvas, first, &options, message))
        return false;
    bool done = image_open(&image, WIDTH, SUBPIXEL_ROWS, IMAGE_BYTE, message);
    for (int step = 0; step < QUARTER && done; step += WIDTH / APART) {
        canvas_clear(&canvas, (Vec3){0, 0, 0}, 0);
        for (int i = 0; i < WIDTH / APART - 1; i++) /* the first column has no room */
            draw_slope(&canvas, program, APART * (i + 1), (double)(step + i) / SUBPIXEL_STEPS);
        /* canvas_read would turn rows round from now on. */
        glReadPixels(0, 0, WIDTH, SUBPIXEL_ROWS, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels);
        for (int i = 0; i < WIDTH / APART - 1 && done; i++) {
            const unsigned char *pixels = image.pixels;
            covered[step + i] = 0;
            for (size_t y = 0; y < SUBPIXEL_ROWS; y++)
                covered[step + i] += pixels[4 * (y * WIDTH + (size_t)(APART * (i + 1)))] > 0;
        }
        covered[step + WIDTH / APART - 1] = covered[step + WIDTH / APART - 2];
    }
    for (int i = 1; i < QUARTER && done; i++)
        positions += covered[i] != covered[i - 1];
    raster->subpixel_bits = (int)lround(log2(4.0 * positions));
    glGetIntegerv(GL_SUBPIXEL_BITS, &claimed);
    raster->claimed_subpixel = claimed;
    image_close(&image);
    canvas_close(&canvas);
    return done;
}

/* Depth. */

static void draw_plane(GLuint program, const double plane[3], double nearer, bool turned,
                       float alpha)
{
    /* Both cover the picture; the corners are others. */
    static const double usual[4][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    static const double other[4][2] = {{-1.3, -1.1}, {-1.2, 1.4}, {1.4, -1.25}, {1.1, 1.3}};
    Corner corners[4];
    for (int i = 0; i < 4; i++) {
        const double *at = turned ? other[i] : usual[i];
        const float x = (float)at[0], y = (float)at[1];
        const double z = plane[0] + plane[1] * (double)x + plane[2] * (double)y - nearer;
        corners[i] = (Corner){{x, y, (float)z, 1}, {1, 1, 1, alpha}};
    }
    draw_strip(program, GL_TRIANGLE_STRIP, corners, 4);
}

/* What steps of depth are measured with. */
typedef struct DepthMeter {
    Canvas canvas;
    GLuint program;
    float *pixels; /* of the canvas */
} DepthMeter;

/* The smallest of these steps nearer to the eye, in clip coordinates, with which a plane is in
 * front of itself at every pixel. */
static int steps_in_front(const DepthMeter *meter, const double plane[3], double step, int max,
                          bool turned)
{
    const Canvas *canvas = &meter->canvas;
    const GLuint program = meter->program;
    float *pixels = meter->pixels;
    for (int n = 1; n <= max; n++) {
        bool all = true;
        canvas_clear(canvas, (Vec3){0, 0, 0}, 0);
        glEnable(GL_DEPTH_TEST);
        draw_plane(program, plane, 0, false, 0.25f);
        draw_plane(program, plane, n * step, turned, 1);
        glDisable(GL_DEPTH_TEST);
        read_floats(canvas, pixels);
        for (int i = 0; i < canvas->width * canvas->height && all; i++)
            all = pixels[4 * (size_t)i + 3] == 1;
        if (all)
            return n;
    }
    return max;
}

/* Planes that face the eye, in the middle of the range, each as far in front of the last as it
 * takes to be in front. What these steps are on average tells the bits; a driver that rounds twice
 * has larger and smaller ones. */
static void depth_steps(const DepthMeter *meter, Random *random, Raster *raster)
{
    enum { STARTS = 8, STEPS = 8, MAX = 64 };
    const double finest = 0x1p-26; /* of clip coordinates, whose range is 2 */
    int sum = 0, largest = 0;
    for (int i = 0; i < STARTS; i++) {
        double at = random_between(random, -1e-3, 1e-3);
        for (int k = 0; k <= STEPS; k++) {
            const int n = steps_in_front(meter, (double[]){at, 0, 0}, finest, MAX, false);
            at -= n * finest;
            if (k == 0) /* begins within a step */
                continue;
            sum += n;
            largest = n > largest ? n : largest;
        }
    }
    raster->depth_bits = (int)lround(-log2(sum * finest / 2 / (STARTS * STEPS)));
    raster->depth_step = ldexp(largest * finest / 2, raster->depth_bits);
}

static bool depths(const Canvas *first, GLuint program, Raster *raster, Message *message)
{
    enum { SIDE = 64, PLANES = 8, MAX_STEPS = 64 };
    const CanvasOptions options = {.width = SIDE, .height = SIDE, .real = true};
    Random random = {5};
    DepthMeter meter = {.program = program};
    if (!canvas_open_beside(&meter.canvas, first, &options, message))
        return false;
    meter.pixels = memory_new(4 * SIDE * SIDE, sizeof *meter.pixels);
    depth_steps(&meter, &random, raster);
    for (int i = 0; i < PLANES; i++) {
        const double plane[3] = {random_between(&random, -0.1, 0.1),
                                 random_between(&random, -0.3, 0.3),
                                 random_between(&random, -0.3, 0.3)};
        const double unit = ldexp(1, 1 - raster->depth_bits);
        const int steps = steps_in_front(&meter, plane, unit, MAX_STEPS, true);
        raster->depth_error = fmax(raster->depth_error, steps);
    }
    canvas_close(&meter.canvas);
    free(meter.pixels);
    return true;
}

bool raster_measure(const Meter *meter, Raster *raster, Message *message)
{
    const Canvas *canvas = &meter->canvas;
    float *pixels = memory_new(4 * (size_t)canvas->width * (size_t)canvas->height, sizeof *pixels);
    const GLuint program = meter_copy(METER_VERTEX, message);
    *raster = (Raster){.units = 0};
    bool done = program && subpixels(canvas, program, raster, message);
    if (done) {
        varyings(canvas, program, raster, pixels);
        shared_edges(canvas, program, raster, pixels);
        done = bytes(meter, raster, message) && depths(canvas, program, raster, message);
    }
    glDeleteProgram(program);
    free(pixels);
    return done;
}
