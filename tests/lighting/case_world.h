/*
 * case_world: one object and its lights, by their properties, drawn by its own program and by the
 * full one, for tests.
 */
#ifndef CASE_WORLD_H
#define CASE_WORLD_H

#include "base/random.h"
#include "core/canvas.h"
#include "lighting/lighting.h"

enum { SIZE = 64 };

/* The color channels that a light and the material have in common, as bits. */
enum { AMBIENT = 1, DIFFUSE = 2, SPECULAR = 4 };

typedef enum Shape { SPHERE, CUBE, TUBE } Shape;
typedef enum Turn { RIGID, EVEN, UNEVEN, SHEARED, MIRRORED, TURNS } Turn;

/* A light's kind, with the properties that only this kind has. */
typedef struct Kind {
    LightKind kind;
    double constant, linear, exponent;
} Kind;

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

enum { KIND_COUNT = 8 };
extern const Kind KINDS[KIND_COUNT];
extern const Case RICH;

typedef struct CaseWorld {
    Light lights[32];
    Object object;
    Scene scene;
} CaseWorld;

extern CaseWorld world;
extern Canvas canvas;
extern Lighting *lighting;
extern Image specialised, full; /* or any two pictures to be compared */
extern Mesh sphere, cube, tube;

int open_all(void **state);
int close_all(void **state);

Light light_of(int number, int terms, Kind kind);
void make_world(const Case *c);

/* Draws a scene, with its own program or with the full one; the world with both. */
void render(const Scene *scene, bool with_all, Image *picture);
void draw_both(void);

/* Whether at most `exceptions` pixels are more than one level apart; keeps the pictures if not. */
bool pictures_agree(const char *name, const Image *a, const Image *b, int exceptions);

extern Random random_state;
int below(int limit);
double between(double min, double max);
Vec3 random_direction(void);
Vec3 random_color(double most);

#endif
