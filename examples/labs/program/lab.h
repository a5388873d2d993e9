/*
 * lab: a lab as data: names, what its scenes contain, which uniforms the shaders may use. No GL.
 *
 * A lab is a folder with its task, its starter and lab.json, which says all of this. Those that
 * come with the programs are examples/labs/NAME in the source tree and share/lighting/labs/NAME in
 * an installation; their lab.json are compiled in. Its shaders are NN.vert and NN.frag
 * ("lab05.vert").
 */
#ifndef LAB_H
#define LAB_H

#include "scene/scene.h"

#include <limits.h>
#include <stdint.h>

enum {
    LAB_COUNT = 11,
    LAB_MAX_LIGHTS = 2,
    LAB_MAX_UNIFORMS = 40,
    LAB_MAX_SOLUTIONS = 4,
    LAB_MAX_PARTS = 12,
    LAB_MAX_DAYS = 31
};

/* What scenes show; the flat ones come first. */
typedef enum LabShape {
    SHAPE_OF_CUBE,
    SHAPE_OF_CUBE_ON_CORNER, /* lab 3: scaling along the axes tilts its faces */
    SHAPE_OF_ICOSAHEDRON,
    SHAPE_OF_DODECAHEDRON,
    SHAPE_OF_OCTAHEDRON,
    SHAPE_OF_QUAD,
    SHAPE_OF_TUBE, /* an open cylinder of flat strips */
    SHAPE_OF_BALL,
    SHAPE_OF_COARSE_BALL,
    SHAPE_OF_TORUS,
    SHAPE_OF_SPHERE, /* lab 10: compared with the exact sphere of radius 1 */
} LabShape;

/* The scene of a lab's program. */
typedef struct LabOwnScene {
    LabShape shape;
    double scale; /* after it has been turned; 0: not turned */
    Vec3 eye, center;
    struct {
        Vec3 place, color;
    } lights[LAB_MAX_LIGHTS];
    Vec3 at; /* a spot light's aim */
    double cutoff, exponent;
    Vec3 attenuation; /* constant, linear, quadratic */
    Vec3 color;
    double shininess;
} LabOwnScene;

/* A uniform that only this lab's shaders have, or their own name for one that others have, too. */
typedef struct LabUniform {
    const char *name;                /* "u_FogColor", "lights[1].position" */
    const char *is;                  /* whose value it has (binding.c); NULL: its own */
    int light;                       /* of an array, the element; -1: all */
    int size;                        /* of its own: 1 to 4 numbers */
    double value[4], min[4], max[4]; /* in the lab's own scene, and the range in others */
} LabUniform;

/* What a lab's shaders call the attributes. */
typedef struct LabAttributes {
    const char *position, *normal, *color; /* NULL: a_Position, a_Normal, a_Color */
} LabAttributes;

/* Of a lab: of a right submission; of a wrong one that draws, for all scenes right, and for each
 * part that is right: of the light, or a variable of the first solution. */
typedef struct LabPoints {
    double most, drawn, scenes, step; /* rounded down to a multiple of `step` */
    struct {
        const char *name;
        double points;
    } parts[LAB_MAX_PARTS];
    int part_count;
    long long due;                /* in seconds since 1970; 0: never late */
    double percent[LAB_MAX_DAYS]; /* of `most`, taken for so many days, the last for all more */
    int day_count;
} LabPoints;

/* Where lab.json does not say. */
#define LAB_POINTS                                                                                 \
    {                                                                                              \
        .most = 10, .drawn = 1, .scenes = 8, .step = 0.5                                           \
    }

typedef struct Lab {
    int number;          /* 1 to LAB_COUNT, or any */
    const char *name;    /* of its folder and program: "lab05_per_fragment" */
    const char *file;    /* of its shaders, without extension: "lab05" */
    const char *summary; /* one line */
    const char *code;    /* a submission's C file: "matrices.c"; NULL: none */
    LightKind light;
    int lights; /* how many; with 2 their uniforms are arrays */
    bool ambient;
    bool specular;
    bool fitted;    /* uses Blinn-Phong's exponent fitted to the given one of Phong */
    bool flat;      /* only flat shapes, whose interpolated normals stay normalized */
    bool rigid;     /* objects are turned and moved, never scaled */
    bool either;    /* light at the vertices is as right as at the fragments */
    bool two_sided; /* the back has its own colour; objects may be mirrored */
    bool given;     /* the shaders are given, the submission is only C */
    bool shadow;    /* its light casts shadows: the shaders get its map (binding.h) */
    bool budget;    /* the submission chooses the mesh and is scored by its cost */
    Reflection reflection;
    LabOwnScene scene;
    /* Of a lab that is read from its folder (submission/lab_json.h). */
    const char *folder; /* NULL: it comes with the programs */
    const LabUniform *uniforms;
    int uniform_count;
    LabAttributes attributes;
    const struct SubmissionFiles *solutions; /* what they draw is right; none: the exact picture */
    int solution_count;
    double tolerance; /* in steps of 1/255; 0: as in other labs */
    LabPoints points;
    uint64_t hash; /* of its files */
} Lab;

extern const Lab LABS[LAB_COUNT];

/* By "5", "05", "lab05", "lab5" or "lab05_per_fragment"; NULL, with a message that names the
 * nearest or all. */
const Lab *lab_find(const char *text, Message *message);

/* The names of the files that a submission has to have: its two shaders, its C, or all of them.
 * Returns how many. */
enum { LAB_MAX_FILES = 3, LAB_NAME_SIZE = 64 };
int lab_files(const Lab *lab, char names[LAB_MAX_FILES][LAB_NAME_SIZE]);

/* Whether its light has this part: "diffuse", "ambient", "highlight", "light 1", "light 2". */
bool lab_has_light(const Lab *lab, const char *part);

/* The folder with the lab's task and starter; false, with a message: there is none. */
bool lab_folder(const Lab *lab, char folder[PATH_MAX], Message *message);

#endif
