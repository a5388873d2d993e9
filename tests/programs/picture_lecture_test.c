/*
 * The pictures of the lecture's nine programs against their closed form: for every pixel, the
 * colour that geometry and the lighting equation give at its centre, in double precision.
 *
 * Only the pictures come from the programs: shapes, numbers and the projection are written again
 * here, from the lecture; the equation is that of support/oracle. Of core/matrix only the vectors
 * are used.
 *
 * Columns and rows are in pixels from the upper left corner of a picture; a pixel's centre is at
 * its number plus one half. Colours are in steps, 0 to 255.
 */
#include "app/options.h"
#include "app/renderer.h"
#include "images/picture_queue.h"
#include "core/matrix.h"
#include "support/oracle.h"
#include "support/picture_check.h"
#include "support/testing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The nine scenes. */

typedef struct Lesson {
    const Example *example;
    double half_side; /* of the cube; 0: the unit sphere */
    Vec3 color;       /* of the object */
    Vec3 eye;         /* looks at the origin, y up */
    bool point;       /* the light has a position, else a direction */
    Vec3 light;
    double light_color, ambient; /* grey */
    double turn;                 /* degrees, at time 0 */
    double turn_per_second;
    char axis;   /* of the rotation: 'y' or 'z' */
    Vec3 offset; /* after the rotation */
    bool per_fragment;
} Lesson;

#define PROGRAMS(X)                                                                                \
    X(LightedCube)                                                                                 \
    X(LightedCube_animation)                                                                       \
    X(LightedCube_ambient)                                                                         \
    X(LightedTranslatedRotatedCube)                                                                \
    X(PointLightedCube)                                                                            \
    X(PointLightedCube_animation)                                                                  \
    X(PointLightedCube_perFragment)                                                                \
    X(PointLightedSphere)                                                                          \
    X(PointLightedSphere_perFragment)

#define DECLARE(NAME) extern const Example NAME;
PROGRAMS(DECLARE)
#undef DECLARE

/* Cubes of half side 1 in directional light, of half side 2 in point light. */
#define SMALL_CUBE                                                                                 \
    .half_side = 1, .color = {1, 0, 0}, .eye = {3, 3, 7}, .light = {0.5, 3, 4}, .light_color = 1
#define LARGE_CUBE                                                                                 \
    .half_side = 2, .color = {1, 0, 0}, .eye = {6, 6, 14}, .point = true, .light = {2.3, 4, 3.5},  \
    .light_color = 1, .ambient = 0.2, .axis = 'y'
#define SPHERE                                                                                     \
    .color = {1, 1, 1}, .eye = {0, 0, 6}, .point = true, .light = {5, 8, 7}, .light_color = 0.8,   \
    .ambient = 0.2, .axis = 'y'

static const Lesson SCENES[] = {
    {.example = &LightedCube, SMALL_CUBE, .axis = 'y'},
    {.example = &LightedCube_animation, SMALL_CUBE, .axis = 'y', .turn_per_second = 30},
    {.example = &LightedCube_ambient, SMALL_CUBE, .axis = 'y', .ambient = 0.2},
    {.example = &LightedTranslatedRotatedCube,
     .half_side = 1,
     .color = {1, 0, 0},
     .eye = {3, 3, 7},
     .light = {0, 3, 4},
     .light_color = 1,
     .ambient = 0.2,
     .axis = 'z',
     .turn = 90,
     .offset = {0, 0.9, 0}},
    {.example = &PointLightedCube, LARGE_CUBE, .turn = 90},
    {.example = &PointLightedCube_animation, LARGE_CUBE, .turn_per_second = 30},
    {.example = &PointLightedCube_perFragment,
     LARGE_CUBE,
     .turn_per_second = 30,
     .per_fragment = true},
    {.example = &PointLightedSphere, SPHERE},
    {.example = &PointLightedSphere_perFragment, SPHERE, .turn = 90, .per_fragment = true},
};

enum { SCENE_COUNT = sizeof SCENES / sizeof SCENES[0] };

static const double FOVY = 30; /* degrees */

typedef struct Size {
    int width, height;
} Size;

/* The lecture's size; odd numbers; portrait; so narrow that every object exceeds both sides. */
static const Size SIZES[] = {{400, 400}, {257, 193}, {64, 128}, {31, 400}};

enum { SIZE_COUNT = sizeof SIZES / sizeof SIZES[0], TIME_COUNT = 4 };

/* The start, two times of the first turn, one of the second. */
static const double TIMES[TIME_COUNT] = {0, 0.4, 1.7, 13.3};

/* Shapes. Both are convex, so exactly the faces towards the eye are visible. */

enum { DIVISIONS = 13, MAX_CORNERS = 2 + DIVISIONS * (DIVISIONS - 1), MAX_TRIANGLES = 338 };

typedef struct Shape {
    Vec3 positions[MAX_CORNERS], normals[MAX_CORNERS];
    int triangles[MAX_TRIANGLES][3]; /* counter-clockwise from outside */
    int corner_count, triangle_count;
} Shape;

static void add_triangle(Shape *shape, int a, int b, int c)
{
    int *triangle = shape->triangles[shape->triangle_count++];
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
}

static void cube(Shape *shape, double half_side)
{
    static const signed char faces[6][4][3] = {
        {{+1, +1, +1}, {-1, +1, +1}, {-1, -1, +1}, {+1, -1, +1}}, /* front */
        {{+1, +1, +1}, {+1, -1, +1}, {+1, -1, -1}, {+1, +1, -1}}, /* right */
        {{+1, +1, +1}, {+1, +1, -1}, {-1, +1, -1}, {-1, +1, +1}}, /* up */
        {{-1, +1, +1}, {-1, +1, -1}, {-1, -1, -1}, {-1, -1, +1}}, /* left */
        {{-1, -1, -1}, {+1, -1, -1}, {+1, -1, +1}, {-1, -1, +1}}, /* down */
        {{+1, -1, -1}, {-1, -1, -1}, {-1, +1, -1}, {+1, +1, -1}}, /* back */
    };
    for (int f = 0; f < 6; f++) {
        const int first = shape->corner_count;
        Vec3 middle = {0, 0, 0};
        for (int c = 0; c < 4; c++) {
            const signed char *sign = faces[f][c];
            const Vec3 corner = {sign[0], sign[1], sign[2]};
            shape->positions[shape->corner_count++] = vec3_scale(corner, half_side);
            middle = vec3_add(middle, vec3_scale(corner, 0.25));
        }
        for (int c = 0; c < 4; c++)
            shape->normals[first + c] = middle;
        add_triangle(shape, first, first + 1, first + 2);
        add_triangle(shape, first, first + 2, first + 3);
    }
}

/* The corner (i, j) of the sphere's mesh: one for each pole, and the last column is the first. */
static int sphere_corner(int i, int j)
{
    if (j == 0 || j == DIVISIONS)
        return j == 0 ? 0 : 1;
    return 2 + (j - 1) * DIVISIONS + i % DIVISIONS;
}

static void sphere(Shape *shape)
{
    shape->corner_count = MAX_CORNERS;
    for (int j = 0; j <= DIVISIONS; j++) {
        for (int i = 0; i < DIVISIONS; i++) {
            const double a = 2 * M_PI * i / DIVISIONS, b = M_PI * j / DIVISIONS;
            const Vec3 place = {sin(a) * sin(b), cos(b), cos(a) * sin(b)};
            shape->positions[sphere_corner(i, j)] = place;
            shape->normals[sphere_corner(i, j)] = place;
        }
    }
    for (int j = 0; j < DIVISIONS; j++) {
        for (int i = 0; i < DIVISIONS; i++) {
            const int here = sphere_corner(i, j), next = sphere_corner(i + 1, j);
            const int below = sphere_corner(i, j + 1), last = sphere_corner(i + 1, j + 1);
            if (here != next)
                add_triangle(shape, here, below, next);
            if (below != last)
                add_triangle(shape, next, below, last);
        }
    }
}

static Vec3 turned(Vec3 v, double degrees, char axis)
{
    const double c = cos(degrees * M_PI / 180), s = sin(degrees * M_PI / 180);
    if (axis == 'y')
        return (Vec3){c * v.x + s * v.z, v.y, c * v.z - s * v.x};
    return (Vec3){c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

/* The scene's shape at a time, in world coordinates. */
static void place_shape(const Lesson *scene, double seconds, Shape *shape)
{
    const double degrees = scene->turn + scene->turn_per_second * seconds;
    memset(shape, 0, sizeof *shape);
    if (scene->half_side > 0)
        cube(shape, scene->half_side);
    else
        sphere(shape);
    for (int i = 0; i < shape->corner_count; i++) {
        const Vec3 place = turned(shape->positions[i], degrees, scene->axis);
        shape->positions[i] = vec3_add(place, scene->offset);
        shape->normals[i] = turned(shape->normals[i], degrees, scene->axis);
    }
}

/* Light. */

static Vec3 towards_light(const Lesson *scene, Vec3 position)
{
    return scene->point ? vec3_subtract(scene->light, position) : scene->light;
}

static Vec3 grey(double value)
{
    return (Vec3){value, value, value};
}

/* The factor of the object's colour, before clamping to 1. */
static double shade(const Lesson *scene, Vec3 position, Vec3 normal)
{
    static const Object white = {.front = {.ambient = {1, 1, 1}, .diffuse = {1, 1, 1}}};
    const Light light = {.kind = scene->point ? LIGHT_POINT : LIGHT_DIRECTIONAL,
                         .position = scene->light,
                         .direction = scene->light,
                         .diffuse = grey(scene->light_color)};
    const Scene equation = {
        .global_ambient = grey(scene->ambient), .lights = &light, .light_count = 1};
    OraclePoint at = {.object = &white, .point = position, .normal = vec3_unit(normal)};
    return oracle_light(&equation, &at).x;
}

/* Of a fragment shader with 11 significant bits: numbers below this, the smallest with all its
 * bits, may become zero. */
static const double TINY = 1.0 / 16384;

/* v.v has 3 roundings, the root halves their effect; root, reciprocal and product one each: 4.5,
 * and half a one for two squares that become zero beside a third of at least 1/4 (normals are
 * handed over at any length from 1/2 to 1): 5; two components of the result may become zero: less
 * than 2 TINY. */
static double normalize_error(double error, double length)
{
    return oracle_mediump_normalized(error, length, 5) + 2 * TINY;
}

/* Per-vertex lighting: the fragment shader copies a positive shade, which is rounded when written
 * at the vertices and when read: 2. */
static double vertex_shade_error(double shaded)
{
    return oracle_mediump_gamma(2) * shaded + TINY;
}

/*
 * Per-fragment lighting, with L and A the colours of the light and the ambient light, p the
 * position, n the normal, l the light's position: p is rounded at the vertices, at most `radius`
 * from the origin, and where it is read: u each; l is rounded where it is read, l - p once; n as p,
 * at most 1 long, but TINY counts double for one handed over at half its length; cutting at 0 adds
 * none; (L * color) * dot + A * color: L, A and color are rounded, two products, one sum: at most 6
 * for each of the two terms, also when color or dot is taken out of the sum.
 */
static double fragment_shade_error(const Lesson *scene, Vec3 position, double normal_length,
                                   double radius, double shaded)
{
    const double u = ORACLE_MEDIUMP_UNIT, sum = oracle_mediump_gamma(6);
    const double distance = vec3_length(towards_light(scene, position));
    const double position_error = 2 * u * radius + 2 * TINY;
    const double light_error =
        position_error + u * vec3_length(scene->light) + u * (distance + position_error);
    const double dot_error = oracle_mediump_dot(normalize_error(light_error, distance),
                                                normalize_error(2 * u + 4 * TINY, normal_length)) +
                             3 * TINY;
    return (1 + sum) * scene->light_color * dot_error + sum * shaded + 2 * TINY;
}

/* The exact picture. */

typedef struct Pixel {
    bool covered;    /* the centre is inside the silhouette */
    bool left_out;   /* too near to an edge where the colour jumps */
    double level;    /* 255 * min(shade, 1) */
    double shift;    /* change of the level by snapping of vertices */
    double rounding; /* error of 11 bits in the fragment shader */
} Pixel;

/*
 * Rasterizers move vertices to a grid of 1/2^bits pixel, each way by half a step at most: by 0.71
 * steps in all. This is a whole step, in pixels; the rest is for the floats that a projection goes
 * through (24 bits for 400 pixels: a few of 2.4e-5 pixels, against 0.29 * 2^-8 = 1.1e-3).
 */
static double snap;

static int find_snap(void **state)
{
    const CanvasOptions options = {.width = 1, .height = 1};
    Canvas canvas;
    Message message = {0};
    GLint bits = 0;
    (void)state;
    if (!canvas_open(&canvas, &options, &message)) {
        printf("%s\n", message.text);
        return -1;
    }
    glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
    canvas_close(&canvas);
    snap = ldexp(1, -bits);
    printf("vertices are moved to %d bits of a pixel\n", (int)bits);
    return bits >= 4 ? 0 : -1; /* OpenGL ES 2.0.25, table 6.18 */
}

typedef struct Exact {
    const Lesson *scene;
    int width, height;
    Pixel *pixels;
} Exact;

/* A projected corner of the shape. */
typedef struct Seen {
    double x, y;     /* in pixels, y downwards */
    double nearness; /* 1 / depth */
    double shade;    /* per-vertex lighting */
    Vec3 world, normal;
} Seen;

static Seen seen(const Lesson *scene, Size size, Vec3 position, Vec3 normal)
{
    const Vec3 up = {0, 1, 0};
    const Vec3 forward = vec3_unit(vec3_scale(scene->eye, -1));
    const Vec3 right = vec3_unit(vec3_cross(forward, up));
    const Vec3 upward = vec3_cross(right, forward);
    const Vec3 from_eye = vec3_subtract(position, scene->eye);
    const double depth = vec3_dot(from_eye, forward);
    /* The same for both directions: pixels are square. */
    const double pixels = size.height / (2 * depth * tan(FOVY / 2 * M_PI / 180));
    return (Seen){
        .x = size.width / 2.0 + pixels * vec3_dot(from_eye, right),
        .y = size.height / 2.0 - pixels * vec3_dot(from_eye, upward),
        .nearness = 1 / depth,
        .shade = shade(scene, position, normal),
        .world = position,
        .normal = normal,
    };
}

/* Distance of (x, y) from the line from a to b, positive inside the triangle. */
static double inside(const Seen *a, const Seen *b, double x, double y)
{
    const double dx = b->x - a->x, dy = b->y - a->y;
    return ((x - a->x) * dy - (y - a->y) * dx) / hypot(dx, dy);
}

/* Distance from the segment. */
static double distance_to(const Seen *a, const Seen *b, double x, double y)
{
    const double dx = b->x - a->x, dy = b->y - a->y;
    const double along = ((x - a->x) * dx + (y - a->y) * dy) / (dx * dx + dy * dy);
    const double t = fmin(fmax(along, 0), 1);
    return hypot(x - a->x - t * dx, y - a->y - t * dy);
}

/* A triangle's surface at one point of the picture. */
typedef struct Surface {
    Vec3 world, normal;
    double shade;
} Surface;

/* Perspective-correct interpolation: screen-space barycentric coordinates divided by each corner's
 * depth, then scaled to a sum of 1. */
static Surface surface_at(const Lesson *scene, const Seen *const corners[3], double x, double y)
{
    double parts[3], sum = 0;
    for (int k = 0; k < 3; k++) {
        const Seen *a = corners[(k + 1) % 3], *b = corners[(k + 2) % 3];
        parts[k] = ((x - a->x) * (b->y - a->y) - (y - a->y) * (b->x - a->x)) * corners[k]->nearness;
        sum += parts[k];
    }
    Surface surface = {{0, 0, 0}, {0, 0, 0}, 0};
    for (int k = 0; k < 3; k++) {
        const double part = parts[k] / sum;
        surface.world = vec3_add(surface.world, vec3_scale(corners[k]->world, part));
        surface.normal = vec3_add(surface.normal, vec3_scale(corners[k]->normal, part));
        surface.shade += part * corners[k]->shade;
    }
    if (scene->per_fragment)
        surface.shade = shade(scene, surface.world, surface.normal);
    return surface;
}

static double level_of(double shaded)
{
    return 255 * fmin(shaded, 1);
}

static double min_of(double a, double b, double c)
{
    return fmin(fmin(a, b), c);
}

static double max_of(double a, double b, double c)
{
    return fmax(fmax(a, b), c);
}

/* The first and the last pixel, of `count`, whose centre lies between two places and one pixel
 * beyond. */
static int first_pixel(double from)
{
    return (int)fmax(floor(from - 1), 0);
}

static int last_pixel(double to, int count)
{
    return (int)fmin(ceil(to + 1), count - 1);
}

static void draw_triangle(Exact *exact, const Seen *const corners[3], double radius)
{
    const Lesson *scene = exact->scene;
    const Seen *a = corners[0], *b = corners[1], *c = corners[2];
    const int left = first_pixel(min_of(a->x, b->x, c->x));
    const int right = last_pixel(max_of(a->x, b->x, c->x), exact->width);
    const int top = first_pixel(min_of(a->y, b->y, c->y));
    const int bottom = last_pixel(max_of(a->y, b->y, c->y), exact->height);
    for (int row = top; row <= bottom; row++) {
        for (int column = left; column <= right; column++) {
            const double x = column + 0.5, y = row + 0.5;
            const double depth_inside =
                min_of(inside(a, b, x, y), inside(b, c, x, y), inside(c, a, x, y));
            if (depth_inside < -snap)
                continue;
            Pixel *pixel = &exact->pixels[row * exact->width + column];
            const Surface here = surface_at(scene, corners, x, y);
            const double level = level_of(here.shade);
            const double shift =
                fabs(level_of(surface_at(scene, corners, x + snap, y).shade) - level) +
                fabs(level_of(surface_at(scene, corners, x, y + snap).shade) - level);
            /* Twice: near a common edge the driver may take either triangle, and they have one
             * colour on the edge. */
            pixel->shift = fmax(pixel->shift, 2 * shift);
            /* Rounding must not leave a pixel on a common edge to neither triangle. */
            if (depth_inside < -1e-9)
                continue;
            pixel->covered = true;
            pixel->level = level;
            pixel->rounding =
                255 * (scene->per_fragment
                           ? fragment_shade_error(scene, here.world, vec3_length(here.normal),
                                                  radius, here.shade)
                           : vertex_shade_error(here.shade));
        }
    }
}

static void leave_out_edge(Exact *exact, const Seen *a, const Seen *b)
{
    for (int row = first_pixel(fmin(a->y, b->y));
         row <= last_pixel(fmax(a->y, b->y), exact->height); row++)
        for (int column = first_pixel(fmin(a->x, b->x));
             column <= last_pixel(fmax(a->x, b->x), exact->width); column++)
            if (distance_to(a, b, column + 0.5, row + 0.5) < snap)
                exact->pixels[row * exact->width + column].left_out = true;
}

/* Draws the exact picture into `exact`, whose pixels the caller frees. */
static void draw_exact(const Lesson *scene, Size size, double seconds, Exact *exact)
{
    static Shape shape;
    static Seen corners[MAX_CORNERS];
    static bool edges[MAX_CORNERS][MAX_CORNERS]; /* from, to: of triangles that face the eye */
    double radius = 0;
    *exact = (Exact){.scene = scene, .width = size.width, .height = size.height};
    exact->pixels = calloc((size_t)size.width * (size_t)size.height, sizeof *exact->pixels);
    assert_non_null(exact->pixels);
    memset(edges, 0, sizeof edges);
    place_shape(scene, seconds, &shape);
    for (int i = 0; i < shape.corner_count; i++) {
        corners[i] = seen(scene, size, shape.positions[i], shape.normals[i]);
        radius = fmax(radius, vec3_length(shape.positions[i]));
    }
    for (int t = 0; t < shape.triangle_count; t++) {
        const int *ends = shape.triangles[t];
        const Seen *const triangle[3] = {&corners[ends[0]], &corners[ends[1]], &corners[ends[2]]};
        if (inside(triangle[0], triangle[1], triangle[2]->x, triangle[2]->y) <= 0)
            continue;
        draw_triangle(exact, triangle, radius);
        for (int k = 0; k < 3; k++)
            edges[ends[k]][ends[(k + 1) % 3]] = true;
    }
    /* Two triangles of one surface meet in one edge, which each runs along in its own direction;
     * an outline has a triangle on one side only, and faces of a cube share no corners. */
    for (int i = 0; i < shape.corner_count; i++)
        for (int j = 0; j < shape.corner_count; j++)
            if (edges[i][j] && !edges[j][i])
                leave_out_edge(exact, &corners[i], &corners[j]);
}

/* The comparison. */

typedef struct Verdict {
    long compared, covered, left_out; /* pixels; covered: of those compared */
    long wrong;                       /* of those compared: colour or coverage */
    double worst, squares;            /* |picture - exact|, in steps */
    double worst_part;                /* the largest ratio of an error to its bound */
    int column, row;                  /* of the worst ratio */
} Verdict;

static const char *precision_of(bool half)
{
    return half ? NULL : "highp";
}

/*
 * How far a channel may be off, in steps: half a step for the byte's rounding, what the snapping
 * of vertices does at this pixel, 0.01 for the floats of 24 bits (20 operations: 255 * 20 * 2^-24
 * is 3e-4), and with 11 bits what the shader's rounding does. With highp never more than one step.
 */
static double allowed(const Pixel *pixel, double channel, bool half)
{
    const double rest = pixel->shift + 0.01;
    if (!pixel->covered)
        return 0;
    return 0.5 + channel * (half ? pixel->rounding + rest : fmin(rest, 0.5));
}

/* Counts one pixel that is not left out. Pictures are drawn with their alpha kept: 255 where the
 * shape is, else 0. */
static void compare_pixel(const unsigned char *bytes, const Pixel *pixel, Vec3 color, bool half,
                          Verdict *verdict)
{
    const double channels[3] = {color.x, color.y, color.z};
    /* Relative to its bound; infinite if nothing may be there. */
    double part = bytes[3] == (pixel->covered ? 255 : 0) ? 0 : INFINITY;
    for (int c = 0; c < 3; c++) {
        const double error = fabs(bytes[c] - channels[c] * pixel->level);
        if (error > 0)
            part = fmax(part, error / allowed(pixel, channels[c], half));
        verdict->worst = fmax(verdict->worst, error);
    }
    /* The first channel suffices: every object has red. */
    verdict->squares += pow(bytes[0] - channels[0] * pixel->level, 2);
    verdict->compared++;
    verdict->covered += pixel->covered;
    verdict->wrong += part > 1;
    verdict->worst_part = fmax(verdict->worst_part, part);
}

static Verdict compare(const Image *picture, const Exact *exact, bool half)
{
    const unsigned char *bytes = picture->pixels;
    Verdict verdict = {0};
    for (int i = 0; i < exact->width * exact->height; i++) {
        const double before = verdict.worst_part;
        if (exact->pixels[i].left_out)
            verdict.left_out++;
        else
            compare_pixel(bytes + 4 * i, &exact->pixels[i], exact->scene->color, half, &verdict);
        if (verdict.worst_part > before) {
            verdict.column = i % exact->width;
            verdict.row = i / exact->width;
        }
    }
    return verdict;
}

/* The exact picture as bytes, for inspection. */
static void exact_image(const Exact *exact, Image *image)
{
    const Vec3 color = exact->scene->color;
    assert_true(image_open(image, exact->width, exact->height, IMAGE_BYTE, NULL));
    for (int i = 0; i < exact->width * exact->height; i++) {
        const Pixel *pixel = &exact->pixels[i];
        unsigned char *bytes = (unsigned char *)image->pixels + 4 * i;
        bytes[0] = (unsigned char)lrint(color.x * pixel->level);
        bytes[1] = (unsigned char)lrint(color.y * pixel->level);
        bytes[2] = (unsigned char)lrint(color.z * pixel->level);
        bytes[3] = pixel->covered ? 255 : 0;
    }
}

/* Drawing. */

static Options options_for(Size size, const char *precision)
{
    return (Options){.width = size.width,
                     .height = size.height,
                     .frames = 1,
                     .alpha = true,
                     .shaders = {.precision = precision}};
}

static void open_canvas(Canvas *canvas, const Options *options)
{
    SUCCEEDS(options_open_canvas(canvas, options, "picture.png", message));
}

static void open_picture(Picture *picture, Size size)
{
    memset(picture, 0, sizeof *picture);
    SUCCEEDS(image_open(&picture->image, size.width, size.height, IMAGE_BYTE, message));
}

static void open_example(Renderer *renderer, const Lesson *scene, const Canvas *canvas,
                         const Options *options)
{
    const DrawRequest request = options_request(options, scene->example);
    SUCCEEDS(renderer_open(renderer, scene->example, canvas, &request, message));
}

static void draw_picture(Renderer *renderer, const Options *options, double seconds,
                         Picture *picture)
{
    const DrawRequest request = options_request(options, renderer->example);
    SUCCEEDS(renderer_picture(renderer, &request, seconds, &picture->image, message));
}

/* One picture, on a canvas of its own. */
static void draw_alone(const Lesson *scene, const Options *options, double seconds,
                       Picture *picture)
{
    CLOSED(canvas_close) Canvas canvas;
    CLOSED(renderer_close) Renderer renderer;
    open_canvas(&canvas, options);
    open_picture(picture, (Size){options->width, options->height});
    open_example(&renderer, scene, &canvas, options);
    draw_picture(&renderer, options, seconds, picture);
}

static void picture_name(char name[128], const Lesson *scene, Size size, double seconds, bool half)
{
    snprintf(name, 128, "%s-%dx%d-%gs-%s", scene->example->name, size.width, size.height, seconds,
             half ? "default" : "highp");
}

/* Every scene at every size and time. */

static bool moves(const Lesson *scene)
{
    return scene->turn_per_second > 0;
}

/* The sums of one scene's pictures. */
static void add_verdict(Verdict *sum, const Verdict *verdict)
{
    sum->compared += verdict->compared;
    sum->covered += verdict->covered;
    sum->left_out += verdict->left_out;
    sum->wrong += verdict->wrong;
    sum->squares += verdict->squares;
    sum->worst = fmax(sum->worst, verdict->worst);
    sum->worst_part = fmax(sum->worst_part, verdict->worst_part);
}

static void check_picture(const Lesson *scene, Size size, double seconds, const Image *picture,
                          bool half, Verdict *sum)
{
    Exact exact;
    draw_exact(scene, size, seconds, &exact);
    const Verdict verdict = compare(picture, &exact, half);
    const long all = (long)size.width * size.height;
    char name[128];
    picture_name(name, scene, size, seconds, half);
    if (verdict.wrong && !sum->wrong) { /* write one picture per scene */
        CLOSED(image_close) Image expected;
        printf("%s: %ld pixels are wrong; the worst, column %d, row %d, by %.2f of its bound\n",
               name, verdict.wrong, verdict.column, verdict.row, verdict.worst_part);
        exact_image(&exact, &expected);
        picture_check_keep(name, picture, &expected);
    }
    free(exact.pixels);
    /* Every object fills a tenth of its picture at least, and of a hundred covered pixels at most
     * one is too near to an edge to be compared: such strips are 2 `snap` wide, and an object of
     * d pixels across has some 8 d of them for its d^2 / 2 pixels or more. */
    if (verdict.covered < all / 10 || verdict.left_out > verdict.covered / 100)
        fail_msg("%s: of %ld pixels %ld are covered and %ld left out", name, all, verdict.covered,
                 verdict.left_out);
    add_verdict(sum, &verdict);
}

static void check_all(bool half)
{
    Verdict sums[SCENE_COUNT] = {0};
    long wrong = 0;
    for (int s = 0; s < SIZE_COUNT; s++) {
        const Options options = options_for(SIZES[s], precision_of(half));
        CLOSED(canvas_close) Canvas canvas;
        Renderer renderer;
        Picture picture;
        open_canvas(&canvas, &options);
        open_picture(&picture, SIZES[s]);
        for (int i = 0; i < SCENE_COUNT; i++) {
            open_example(&renderer, &SCENES[i], &canvas, &options);
            /* A static scene only at the first and the last time. */
            for (int t = 0; t < TIME_COUNT; t += moves(&SCENES[i]) ? 1 : TIME_COUNT - 1) {
                draw_picture(&renderer, &options, TIMES[t], &picture);
                check_picture(&SCENES[i], SIZES[s], TIMES[t], &picture.image, half, &sums[i]);
            }
            renderer_close(&renderer);
        }
        image_close(&picture.image);
    }
    printf("%-31s %-8s   worst  of bound    rms   compared  covered  left out\n", "steps of 1/255",
           half ? "default:" : "highp:");
    for (int i = 0; i < SCENE_COUNT; i++) {
        const Verdict *sum = &sums[i];
        printf("%-40s %7.3f %8.0f%% %7.3f %9ld %8ld %8ld\n", SCENES[i].example->name, sum->worst,
               100 * sum->worst_part, sqrt(sum->squares / (double)sum->covered), sum->compared,
               sum->covered, sum->left_out);
        wrong += sum->wrong;
    }
    assert_int_equal(wrong, 0);
}

TEST(every_pixel_clear_of_an_edge_has_the_exact_colour_with_highp)
{
    check_all(false);
}

TEST(every_pixel_clear_of_an_edge_is_within_the_bound_of_11_bits_by_default)
{
    check_all(true);
}

/* The comparison itself can fail. */

static void flip(const Image *image, Image *flipped, bool columns)
{
    assert_true(image_open(flipped, image->width, image->height, image->type, NULL));
    for (int y = 0; y < image->height; y++) {
        for (int x = 0; x < image->width; x++) {
            const int from_x = columns ? image->width - 1 - x : x;
            const int from_y = columns ? y : image->height - 1 - y;
            memcpy((unsigned char *)flipped->pixels + 4 * (y * image->width + x),
                   (const unsigned char *)image->pixels + 4 * (from_y * image->width + from_x), 4);
        }
    }
}

/* Rejects more than 1% of the covered pixels, so rounding is not the cause. */
static void must_refuse(const char *what, const Exact *exact, const Image *picture, bool half)
{
    const Verdict verdict = compare(picture, exact, half);
    if (verdict.wrong <= verdict.covered / 100)
        fail_msg("%s: of the picture %s only %ld pixels count as wrong",
                 exact->scene->example->name, what, verdict.wrong);
}

TEST(a_black_flipped_mirrored_or_mistimed_picture_is_refused)
{
    const Size size = SIZES[0];
    for (int half = 0; half <= 1; half++) {
        const Options options = options_for(size, precision_of(half));
        for (int i = 0; i < SCENE_COUNT; i++) {
            const Lesson *scene = &SCENES[i];
            Picture picture;
            Exact exact;
            Image wrong;
            draw_alone(scene, &options, TIMES[1], &picture);
            draw_exact(scene, size, TIMES[1], &exact);
            assert_int_equal(compare(&picture.image, &exact, half).wrong, 0);
            flip(&picture.image, &wrong, false);
            must_refuse("upside down", &exact, &wrong, half);
            image_close(&wrong);
            flip(&picture.image, &wrong, true);
            must_refuse("mirrored", &exact, &wrong, half);
            memset(wrong.pixels, 0, image_row_size(&wrong) * (size_t)wrong.height);
            must_refuse("in black", &exact, &wrong, half);
            image_close(&wrong);
            free(exact.pixels);
            if (moves(scene)) {
                draw_exact(scene, size, TIMES[2], &exact);
                must_refuse("of another moment", &exact, &picture.image, half);
                free(exact.pixels);
            }
            image_close(&picture.image);
        }
    }
}

/* At time 0 the animated cube equals the static one: the only two equal pictures. */
static bool look_alike(const Lesson *a, const Lesson *b)
{
    const bool small = a->example == &LightedCube || a->example == &LightedCube_animation;
    return a == b ||
           (small && (b->example == &LightedCube || b->example == &LightedCube_animation));
}

TEST(the_picture_of_another_program_is_refused)
{
    const Size size = SIZES[0];
    const Options options = options_for(size, precision_of(false));
    static Exact exacts[SCENE_COUNT];
    for (int i = 0; i < SCENE_COUNT; i++)
        draw_exact(&SCENES[i], size, 0, &exacts[i]);
    for (int i = 0; i < SCENE_COUNT; i++) {
        Picture picture;
        draw_alone(&SCENES[i], &options, 0, &picture);
        for (int j = 0; j < SCENE_COUNT; j++) {
            if (look_alike(&SCENES[i], &SCENES[j]))
                assert_int_equal(compare(&picture.image, &exacts[j], false).wrong, 0);
            else
                must_refuse(SCENES[i].example->name, &exacts[j], &picture.image, false);
        }
        image_close(&picture.image);
    }
    for (int i = 0; i < SCENE_COUNT; i++)
        free(exacts[i].pixels);
}

TEST(a_still_scene_is_the_same_at_every_time)
{
    static const double moments[] = {-1e9, -0.4, 3, 13.3, 1e9};
    const Options options = options_for(SIZES[1], NULL);
    for (int i = 0; i < SCENE_COUNT; i++) {
        if (moves(&SCENES[i]))
            continue;
        Picture first;
        draw_alone(&SCENES[i], &options, 0, &first);
        for (size_t m = 0; m < sizeof moments / sizeof moments[0]; m++) {
            Picture later;
            draw_alone(&SCENES[i], &options, moments[m], &later);
            assert_true(picture_check_same(SCENES[i].example->name, &later.image, &first.image, 0));
            image_close(&later.image);
        }
        image_close(&first.image);
    }
}

TEST(drawing_twice_gives_the_same_bits)
{
    const Options options = options_for(SIZES[0], NULL);
    for (int i = 0; i < SCENE_COUNT; i++) {
        const Lesson *scene = &SCENES[i];
        Picture alone, again;
        Canvas canvas;
        Renderer renderer;
        draw_alone(scene, &options, TIMES[2], &alone);
        /* On a canvas that has drawn another time before. */
        open_canvas(&canvas, &options);
        open_picture(&again, SIZES[0]);
        open_example(&renderer, scene, &canvas, &options);
        draw_picture(&renderer, &options, TIMES[1], &again);
        draw_picture(&renderer, &options, TIMES[2], &again);
        renderer_close(&renderer);
        canvas_close(&canvas);
        assert_true(picture_check_same(scene->example->name, &again.image, &alone.image, 0));
        image_close(&alone.image);
        image_close(&again.image);
    }
}

TEST(without_alpha_the_same_picture_stands_on_opaque_black)
{
    const Options with = options_for(SIZES[1], NULL);
    Options without = with;
    without.alpha = false;
    for (int i = 0; i < SCENE_COUNT; i++) {
        Picture transparent, opaque;
        draw_alone(&SCENES[i], &with, TIMES[1], &transparent);
        draw_alone(&SCENES[i], &without, TIMES[1], &opaque);
        unsigned char *bytes = transparent.image.pixels;
        for (int p = 0; p < SIZES[1].width * SIZES[1].height; p++)
            bytes[4 * p + 3] = 255;
        assert_true(
            picture_check_same(SCENES[i].example->name, &opaque.image, &transparent.image, 0));
        image_close(&transparent.image);
        image_close(&opaque.image);
    }
}

int main(void)
{
    return picture_check_run("picture lecture", find_snap, NULL);
}
