/*
 * points: two shaders run by the evaluator (glsl/glsl_run.h) at points of a lab's scenes, in exact
 * arithmetic. No driver, except to read shadow maps.
 *
 * A point lies in a triangle of an object. The vertex shader runs at the triangle's corners, its
 * varyings are interpolated, and the fragment shader runs there. Equal formulas give equal numbers,
 * whatever a picture would round or hide.
 */
#ifndef POINTS_H
#define POINTS_H

#include "glsl/glsl_run.h"
#include "labs/submission/lab_pictures.h"

enum { POINT_CORNERS = 3, POINT_NUMBERS = 6 };

/* What all points of an object have in common. */
typedef struct PointSetting {
    BindingValue values[BINDING_VALUES];
    int value_count, width, height;
    const char *scene; /* its letter; NULL: not of the known ones */
    float color[4];
    unsigned char *map; /* lab 11: texels, the lowest row first; of all objects of a scene */
    bool owns_map, map_read;
} PointSetting;

typedef struct Point {
    int setting;
    MeshVertex corners[POINT_CORNERS];
    double weights[POINT_CORNERS];
} Point;

/* Parts of the light that are left out: its terms are seen one by one. */
enum { POINTS_NO_AMBIENT = 1, POINTS_NO_SPECULAR = 2, POINTS_NO_FIRST = 4, POINTS_NO_SECOND = 8 };

typedef struct Points {
    const Lab *lab;
    PointSetting *settings;
    Point *items;
    int setting_count, setting_room, count, room;
    int without; /* POINTS_NO_ bits */
    int corner;  /* of the triangle, from 1 on, instead of the point itself; 0: the point */
} Points;

bool points_open(Points *points, const LabPictures *pictures, Message *message);
void points_close(Points *points);

/* A shader ready to run. The text is what the driver gets. */
typedef struct PointShader {
    GlslTree *tree;
    GlslCode *code;
    GlslRun *run;
    int setting, without; /* whose uniforms are set */
    int *bound;           /* by variable: which of a setting's values it has; -1: none */
    bool lit;             /* it has one that may be left out */
    /* Of a vertex shader: what it gave at each point's corners, gl_Position first. */
    double *outputs;
    bool *done;
    int width;    /* numbers of each corner */
    bool at_once; /* it runs at the point itself: light at the vertices or not is as right */
} PointShader;

/* False: the text does not compile, or the evaluator cannot run it. */
bool point_shader_open(PointShader *shader, const char *text, GlslStage stage);
void point_shader_close(PointShader *shader); /* NULL or zeroed is fine */

/* What both draw at a point: the colour from 0 to 1, then its place in normalized device
 * coordinates. A colour of -1: discarded. */
void points_run(const Points *points, PointShader *vertex, PointShader *fragment, int point,
                double numbers[POINT_NUMBERS]);

/* A varying, or gl_Position: what is in `outputs`. */
bool points_is_output(const GlslVariable *variable);

/* Of a uniform; NULL: it has none. */
const float *points_value(const PointSetting *setting, const char *name);

/* Where u_MvpMatrix puts the point. */
void points_place(const Points *points, int point, double place[3]);

/* The largest difference of such numbers. */
double points_apart(const double a[POINT_NUMBERS], const double b[POINT_NUMBERS]);

#endif
