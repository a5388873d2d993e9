/*
 * A triangle is never clipped: with clip coordinates (x, y, w) of its corners as the columns of a
 * matrix M, M^-1 (X, Y, 1) gives the corners' weights over w at a place (X, Y) of the viewport,
 * also where a corner is behind the eye (Olano and Greer, Triangle scan conversion using 2D
 * homogeneous coordinates, 1997).
 */
#include "probe/raster.h"

#include "base/memory.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Both stages of a program, once for all its draws. */
typedef struct Stages {
    const char *sources[2];
    GlslTree *trees[2];
    GlslCode *codes[2];
    GlslRun *runs[2];
} Stages;

/* The vertices' clip coordinates, by number. */
typedef struct DrawState {
    int stages;
    double (*places)[4];
} DrawState;

struct Raster {
    const Capture *capture;
    Stages *stages;
    int count, room;
    DrawState *draws;
};

/* The shaders of a draw */

static const double *numbers(const GlslRun *run, const char *name, GlslVariable *found)
{
    return glsl_find(run->code, name, found) ? run->registers + found->first : NULL;
}

static void set(GlslRun *run, const char *name, const double *values, int count)
{
    GlslVariable found;
    if (!glsl_find(run->code, name, &found))
        return;
    for (int i = 0; i < count && i < found.count; i++)
        run->registers[found.first + i] = values[i];
}

/* Coordinates beyond an edge: repeated, or the edge's. */
static int texel(double at, int size, bool repeats)
{
    const double place = repeats ? at - floor(at) : at;
    return (int)fmin(fmax(floor(place * size), 0), size - 1);
}

/* The nearest texel; maps and masks have no other filter. */
static void look_up(void *context, int unit, int function, const double *coordinates, int count,
                    double color[4])
{
    const CaptureDraw *draw = context;
    const CaptureTexture *texture =
        unit >= 0 && unit < draw->texture_count ? draw->textures[unit] : NULL;
    const double divisor =
        function == GLSL_TEXTURE_2D_PROJ && count > 2 ? coordinates[count - 1] : 1;
    for (int i = 0; i < 4; i++)
        color[i] = i == 3;
    if (!texture || !texture->texels)
        return;
    const int x = texel(coordinates[0] / divisor, texture->width, texture->repeats[0]);
    const int y = texel(coordinates[1] / divisor, texture->height, texture->repeats[1]);
    for (int i = 0; i < 4; i++)
        color[i] = (double)texture->texels[4 * (y * texture->width + x) + i];
}

static void set_uniforms(GlslRun *run, const CaptureDraw *draw)
{
    for (int i = 0; i < draw->uniform_count; i++) {
        const CaptureUniform *uniform = &draw->uniforms[i];
        for (int k = 0; k < uniform->length; k++) {
            char *name = memory_format(uniform->length > 1 ? "%s[%d]" : "%s", uniform->name, k);
            double values[16];
            for (int j = 0; j < uniform->numbers; j++)
                values[j] = (double)uniform->values[k * uniform->numbers + j];
            set(run, name, values, uniform->numbers);
            free(name);
        }
    }
}

static GlslRun *begin(Raster *raster, int draw, int stage, const GlslArithmetic *arithmetic)
{
    GlslRun *run = raster->stages[raster->draws[draw].stages].runs[stage];
    run->arithmetic = arithmetic;
    run->exact_from = INT_MAX;
    run->texture = look_up;
    run->context = &raster->capture->draws[draw];
    set_uniforms(run, &raster->capture->draws[draw]);
    return run;
}

static void run_vertex(GlslRun *run, const CaptureDraw *draw, unsigned vertex)
{
    for (int i = 0; i < draw->attribute_count; i++) {
        float value[4];
        double wide[4];
        capture_attribute(&draw->attributes[i], vertex, value);
        for (int k = 0; k < 4; k++)
            wide[k] = (double)value[k];
        set(run, draw->attributes[i].name, wide, 4);
    }
    glsl_run(run);
}

/* Opening */

static bool compile(Stages *stages, const CaptureDraw *draw, Message *message)
{
    for (int i = 0; i < 2; i++) {
        if (!draw->sources[i])
            return message_set(message, "a program without its sources was drawn with");
        stages->sources[i] = draw->sources[i];
        stages->trees[i] = glsl_parse(draw->sources[i], i ? GLSL_FRAGMENT : GLSL_VERTEX, NULL);
        if (stages->trees[i]->message_count)
            return message_set(message, "%s shader: line %d: %s", i ? "fragment" : "vertex",
                               stages->trees[i]->messages[0].place.line,
                               stages->trees[i]->messages[0].text);
        if (!glsl_check_whole(stages->trees[i]))
            return message_set(message, "%s shader: %s", i ? "fragment" : "vertex",
                               stages->trees[i]->messages[0].text);
        stages->codes[i] = glsl_compile(stages->trees[i]);
        if (stages->codes[i]->message.text[0])
            return message_set(message, "%s shader: line %d: %s", i ? "fragment" : "vertex",
                               stages->codes[i]->message.place.line,
                               stages->codes[i]->message.text);
        stages->runs[i] = glsl_run_open(stages->codes[i]);
    }
    return true;
}

static bool find_stages(Raster *raster, const CaptureDraw *draw, int *number, Message *message)
{
    for (*number = 0; *number < raster->count; ++*number) {
        const Stages *known = &raster->stages[*number];
        if (known->sources[0] == draw->sources[0] && known->sources[1] == draw->sources[1])
            return true;
    }
    Stages *made = memory_add(&raster->stages, &raster->count, &raster->room, sizeof *made);
    *made = (Stages){.sources = {NULL, NULL}};
    return compile(made, draw, message);
}

static bool is_filled(const CaptureDraw *draw)
{
    return draw->mode == GL_TRIANGLES || draw->mode == GL_TRIANGLE_STRIP ||
           draw->mode == GL_TRIANGLE_FAN;
}

/* Each vertex that is drawn, once. */
static void place_vertices(Raster *raster, int number)
{
    const CaptureDraw *draw = &raster->capture->draws[number];
    DrawState *state = &raster->draws[number];
    GlslRun *run = begin(raster, number, 0, &GLSL_LLVMPIPE);
    unsigned most = 0;
    for (int i = 0; i < draw->vertex_count; i++)
        most = draw->vertices[i] > most ? draw->vertices[i] : most;
    bool *done = memory_new((size_t)most + 1, sizeof *done);
    state->places = memory_new((size_t)most + 1, sizeof *state->places);
    run->trace = false;
    for (int i = 0; i < draw->vertex_count; i++) {
        const unsigned vertex = draw->vertices[i];
        GlslVariable found;
        if (done[vertex])
            continue;
        done[vertex] = true;
        run_vertex(run, draw, vertex);
        const double *place = numbers(run, "gl_Position", &found);
        if (place)
            memcpy(state->places[vertex], place, sizeof state->places[vertex]);
    }
    free(done);
}

bool raster_open(Raster **opened, const Capture *capture, Message *message)
{
    Raster *raster = *opened = memory_new(1, sizeof *raster);
    raster->capture = capture;
    raster->draws = memory_new((size_t)capture->draw_count + 1, sizeof *raster->draws);
    for (int i = 0; i < capture->draw_count; i++) {
        if (!is_filled(&capture->draws[i]))
            continue;
        if (!find_stages(raster, &capture->draws[i], &raster->draws[i].stages, message)) {
            raster_close(raster);
            *opened = NULL;
            return false;
        }
        place_vertices(raster, i);
    }
    return true;
}

void raster_close(Raster *raster)
{
    for (int i = 0; raster && i < raster->count; i++) {
        for (int k = 0; k < 2; k++) {
            if (raster->stages[i].runs[k])
                glsl_run_close(raster->stages[i].runs[k]);
            if (raster->stages[i].codes[k])
                glsl_code_free(raster->stages[i].codes[k]);
            if (raster->stages[i].trees[k])
                glsl_tree_free(raster->stages[i].trees[k]);
        }
    }
    for (int i = 0; raster && i < raster->capture->draw_count; i++)
        free(raster->draws[i].places);
    if (raster) {
        free(raster->draws);
        free(raster->stages);
    }
    free(raster);
}

/* Coverage */

/* x, y and w of three corners, and of a place. */
typedef struct Corners {
    double at[3][3];
} Corners;

static double determinant(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* The weights, which add up to 1, if the place is in the triangle. `area` has its sign. */
static bool weigh(const Corners *p, const double at[3], double weights[3], double *area)
{
    *area = determinant(p->at[0], p->at[1], p->at[2]);
    weights[0] = determinant(at, p->at[1], p->at[2]) / *area;
    weights[1] = determinant(p->at[0], at, p->at[2]) / *area;
    weights[2] = determinant(p->at[0], p->at[1], at) / *area;
    const bool inside = weights[0] >= 0 && weights[1] >= 0 && weights[2] >= 0;
    const double sum = weights[0] + weights[1] + weights[2];
    for (int i = 0; i < 3; i++)
        weights[i] /= sum;
    return inside && sum > 0;
}

static Corners snapped(const Corners *p, const int viewport[4])
{
    static const double GRID = 256;
    Corners moved = *p;
    for (int i = 0; i < 3; i++) {
        const double w = p->at[i][2];
        for (int k = 0; k < 2 && w > 0; k++) {
            const double half = viewport[2 + k] / 2.0;
            moved.at[i][k] = w * rint((p->at[i][k] / w) * half * GRID) / (half * GRID);
        }
    }
    return moved;
}

static bool passes(GLenum function, double depth, double before)
{
    return function == GL_ALWAYS || (function == GL_LESS && depth < before) ||
           (function == GL_LEQUAL && depth <= before) || (function == GL_EQUAL && depth == before);
}

/* Tries a triangle of a draw; `depth` is that of what the pixel shows so far. */
static void try_triangle(const Raster *raster, RasterPixel *pixel, const RasterPixel *tried,
                         double *depth)
{
    const CaptureDraw *draw = &raster->capture->draws[tried->draw];
    const int *v = draw->viewport;
    const double at[3] = {2 * (tried->coord[0] - v[0]) / v[2] - 1,
                          2 * (tried->coord[1] - v[1]) / v[3] - 1, 1};
    RasterPixel found = *tried;
    Corners corners;
    double area, z = 0, w = 0;
    for (int i = 0; i < 3; i++) {
        const double *place = raster->draws[tried->draw].places[tried->corners[i]];
        memcpy(corners.at[i], (double[3]){place[0], place[1], place[3]}, sizeof corners.at[i]);
    }
    const Corners grid = snapped(&corners, v);
    if (!weigh(&grid, at, found.weights, &area))
        return;
    weigh(&corners, at, found.weights, &area);
    for (int i = 0; i < 3; i++) {
        z += found.weights[i] * raster->draws[tried->draw].places[tried->corners[i]][2];
        w += found.weights[i] * corners.at[i][2];
    }
    found.front = (area > 0) == (draw->front_face == GL_CCW);
    found.coord[2] = (z / w + 1) / 2;
    found.coord[3] = 1 / w;
    if (fabs(z) > w || (draw->culls && (draw->cull_face == GL_FRONT_AND_BACK ||
                                        found.front == (draw->cull_face == GL_FRONT))))
        return;
    if (draw->tests_depth && !passes(draw->depth_func, found.coord[2], *depth))
        return;
    if (draw->tests_depth && draw->writes_depth)
        *depth = found.coord[2];
    *pixel = found;
}

static bool is_within(const int box[4], int column, int row)
{
    return column >= box[0] && column < box[0] + box[2] && row >= box[1] && row < box[1] + box[3];
}

void raster_find(Raster *raster, int column, int row, RasterPixel *pixel)
{
    double depth = 1;
    *pixel = (RasterPixel){.draw = -1};
    for (int d = 0; d < raster->capture->draw_count; d++) {
        const CaptureDraw *draw = &raster->capture->draws[d];
        RasterPixel tried = {.draw = d, .coord = {column + 0.5, row + 0.5}};
        const int step = draw->mode == GL_TRIANGLES ? 3 : 1;
        if (!is_filled(draw) || !is_within(draw->viewport, column, row) ||
            (draw->scissors && !is_within(draw->scissor, column, row)) || !draw->colors[0])
            continue;
        for (int i = 0; i + 2 < draw->vertex_count; i += step) {
            const bool odd = draw->mode == GL_TRIANGLE_STRIP && i % 2;
            tried.corners[0] = draw->vertices[draw->mode == GL_TRIANGLE_FAN ? 0 : i + odd];
            tried.corners[1] = draw->vertices[i + 1 - odd];
            tried.corners[2] = draw->vertices[i + 2];
            try_triangle(raster, pixel, &tried, &depth);
        }
    }
}

/* Running */

const GlslRun *raster_corner(Raster *raster, const RasterPixel *pixel, int corner,
                             const GlslArithmetic *arithmetic)
{
    GlslRun *run = begin(raster, pixel->draw, 0, arithmetic);
    run->trace = true;
    run_vertex(run, &raster->capture->draws[pixel->draw], pixel->corners[corner]);
    return run;
}

/* What the fragment gets of the corners: each varying, weighted. */
static void interpolate(Raster *raster, const RasterPixel *pixel, GlslRun *fragment,
                        const GlslArithmetic *arithmetic)
{
    const GlslCode *code = fragment->code;
    for (int k = 0; k < code->variable_count; k++)
        if (code->variables[k].storage == GLSL_VARYING)
            for (int i = 0; i < code->variables[k].count; i++)
                fragment->registers[code->variables[k].first + i] = 0;
    for (int c = 0; c < 3; c++) {
        const GlslRun *corner = raster_corner(raster, pixel, c, arithmetic);
        for (int k = 0; k < code->variable_count; k++) {
            const GlslVariable *varying = &code->variables[k];
            GlslVariable found;
            const double *values =
                varying->storage == GLSL_VARYING ? numbers(corner, varying->name, &found) : NULL;
            for (int i = 0; values && i < varying->count && i < found.count; i++)
                fragment->registers[varying->first + i] += pixel->weights[c] * values[i];
        }
    }
}

const GlslRun *raster_run(Raster *raster, const RasterPixel *pixel,
                          const GlslArithmetic *arithmetic, int exact_from, double color[4])
{
    GlslRun *run = begin(raster, pixel->draw, 1, arithmetic);
    const double front = pixel->front;
    GlslVariable found;
    interpolate(raster, pixel, run, arithmetic);
    set(run, "gl_FragCoord", pixel->coord, 4);
    set(run, "gl_FrontFacing", &front, 1);
    run->exact_from = exact_from;
    run->trace = true;
    glsl_run(run);
    const double *written = numbers(run, "gl_FragColor", &found);
    if (!written || !run->code->tree->symbols[found.symbol].written)
        written = numbers(run, "gl_FragData[0]", &found);
    for (int i = 0; i < 4; i++)
        color[i] = written ? written[i] : 0;
    return run;
}

const GlslTree *raster_tree(const Raster *raster, int draw, int stage)
{
    return raster->stages[raster->draws[draw].stages].trees[stage];
}
