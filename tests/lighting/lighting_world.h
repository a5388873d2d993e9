/*
 * lighting_world: an object in the light of some lights, made from its properties, for tests.
 */
#ifndef LIGHTING_WORLD_H
#define LIGHTING_WORLD_H

#include "core/canvas.h"
#include "lighting/lighting.h"

enum { SIZE = 64 };
extern const Vec3 BACKGROUND;

/* The color channels that a light and the material have in common, as bits. */
enum { AMBIENT = 1, DIFFUSE = 2, SPECULAR = 4 };

typedef enum Shape { SPHERE, CUBE, TUBE } Shape;
typedef enum Turn { RIGID, EVEN, UNEVEN, SHEARED, MIRRORED, TURNS } Turn;

/* A light's kind, with the properties that only this kind has. */
typedef struct Kind {
    LightKind kind;
    double constant, linear, exponent;
} Kind;

enum { KIND_COUNT = 8 };
extern const Kind KINDS[KIND_COUNT];

typedef struct Case {
    int terms[3]; /* of each light */
    int kinds[3];
    int light_count;
    Shape shape;
    Turn turn;
    Interpolation interpolation;
    Reflection reflection;
    bool distant_viewer, two_sided, base, alpha;
} Case;

typedef struct LightingWorld {
    Light lights[32];
    Object object;
    Scene scene;
} LightingWorld;

extern Canvas canvas;
extern Lighting *lighting;
extern Image specialised, full; /* or any two pictures to be compared */
extern Mesh sphere, smooth_sphere, cube, tube, quad;
extern LightingWorld world;

/* Fixtures. */
int open_all(void **state);
int close_all(void **state);

Mat4 turn_matrix(Turn turn);
Light light_of(int number, int terms, Kind kind);
void make_world(const Case *c);

/* Draws a scene; the world with its own program and with the full one. */
void render(const Scene *scene, bool with_all, Image *picture);
void draw_both(void);

unsigned char *pixel(const Image *image, int x, int y);

/* Whether at most `exceptions` pixels are more than one level apart; keeps the pictures if not. */
bool pictures_agree(const char *name, const Image *a, const Image *b, int exceptions);

#endif
