/*
 * What the search has found: each scene shrunk, with its cause, and a bound that follows from it.
 */
#include "hard/search.h"
#include "support/picture_check.h"
#include "support/testing.h"

enum { SIZE = 24 };

#define IDENTITY                                                                                   \
    {                                                                                              \
        {                                                                                          \
            1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1                                         \
        }                                                                                          \
    }

/* R.V is negative on the whole face and the shininess is nearly 0. The exact highlight is 0; the
 * shaders computed pow(max(cosine, 1e-37), s), which is 0.43 for s = 0.01: an error of 109 steps.
 * Fixed: a cosine of 0 or less has a branch of its own. */
static const RandomScene SHININESS_NEXT_TO_0 = {
    .scene = {.camera = {.eye = {0, 0, 3}, .up = {0, 1, 0}, .fovy = 30, .near = 1, .far = 30},
              .light_count = 1,
              .object_count = 1,
              .reflection = REFLECTION_PHONG},
    .lights[0] = {.kind = LIGHT_POINT, .position = {3, 0, 0.5}, .specular = {0, 0, 1}},
    .objects[0] = {.world_from_object = IDENTITY,
                   .front = {.specular = {0, 0, 1}, .alpha = 1, .shininess = 0.01}},
    .shapes[0] = {.solid = {.kind = SOLID_QUAD}, .divisions = 3},
};

/* The same with a strong light: a constant attenuation below 1 makes it 12.5 times 4 as strong, and
 * 50 * 1e-37^0.1 is 0.01, 2.5 steps. Fixed by the same branch. */
static const RandomScene STRONG_LIGHT_ASIDE = {
    .scene = {.camera = {.eye = {0, -2, 1}, .up = {0, 0, 1}, .fovy = 1, .near = 0.5, .far = 1},
              .light_count = 1,
              .object_count = 1},
    .lights[0] = {.kind = LIGHT_POINT, .specular = {0, 4, 0}, .constant = 0.08},
    .objects[0] = {.world_from_object = {{1, 0, 0, 0, 0, -0.8, -0.7, 0, 0, 0, 0, 0, 0, -1, 1, 1}},
                   .front = {.specular = {0, 1, 0}, .alpha = 1, .shininess = 0.1}},
    .shapes[0] = {.solid = {.kind = SOLID_QUAD}, .divisions = 3},
};

/* A thousandth of a degree is visible along the edge of a cone of 90 degrees. A cosine of floats
 * has an error of about 2^-23, 1.2e-7, a sixth of a pixel here. No computation with 24 bits is
 * better, so this counts as rounding. */
static const RandomScene CLOSE_LOOK_AT_A_CONE = {
    .scene = {.camera = {.eye = {-3, 0, 0}, .up = {0, 1, 0}, .fovy = 0.001, .near = 0.5, .far = 1},
              .light_count = 1,
              .object_count = 1},
    .lights[0] = {.kind = LIGHT_SPOT,
                  .position = {-3, 0, 0},
                  .direction = {0, 1, 0},
                  .specular = {1, 0, 0},
                  .cutoff = 90},
    .objects[0] = {.world_from_object = {{-0.23, 0.27, 0, 0, 0, 0, 1, 0, 0.44, -0.57, 0, 0, 0.3,
                                          -0.8, 0, 1}},
                   .front = {.specular = {1, 0, 0}, .alpha = 1}},
    .shapes[0] = {.solid = {.kind = SOLID_BOX, .radius = 90}, .divisions = 3},
};

/* A cone of one degree, seen from 0.0004 in front of a surface, where a pixel is 4e-6 wide. The
 * cosine of a cutoff c is rounded to 2^-24, which moves the edge by 2^-24 / sin(c) radians: 3.4e-6,
 * or 1.2e-5 at a distance of 3.4. Smaller cones are worse: the cosine of 0.02 degrees is 1 minus
 * one unit in the last place, so that cone may have any width from 0 to twice the right one. */
static const RandomScene NARROW_CONE_SEEN_CLOSELY = {
    .scene = {.camera = {.eye = {1, -1, 0.5},
                         .center = {0, -0.9, -0.8},
                         .up = {0, 0, 1},
                         .fovy = 1,
                         .near = 0.001,
                         .far = 1},
              .light_count = 1,
              .object_count = 1,
              .reflection = REFLECTION_PHONG},
    .lights[0] = {.kind = LIGHT_SPOT,
                  .position = {-0.5, -3.1, 2},
                  .direction = {1.5, 2.1, -1.5},
                  .specular = {0, 0, 1},
                  .cutoff = 1,
                  .quadratic = 7e-5},
    .objects[0] = {.world_from_object = {{1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, -0.9996, 0, 1}},
                   .front = {.specular = {0, 0, 1}, .alpha = 1, .shininess = 1}},
    .shapes[0] = {.solid = {.kind = SOLID_QUAD}, .divisions = 3},
};

/* Vertex colors, a triangle no wider than a pixel, and sRGB, which is up to 13 times as steep as
 * linear colors: the driver rounds each corner to 1/256 of a pixel, which changes the color here by
 * most of a step. */
static const RandomScene SMALL_TRIANGLES_IN_THE_DARK = {
    .scene = {.camera = {.eye = {1.295441, 2.336, 4.646332},
                         .center = {0, -0.118042, 0.2866},
                         .up = {-0.4173211, 0.4069502, -0.8126},
                         .fovy = 36.3643,
                         .near = 1,
                         .far = 30},
              .light_count = 1,
              .object_count = 1,
              .interpolation = INTERPOLATION_GOURAUD,
              .linear = true},
    .lights[0] = {.kind = LIGHT_DIRECTIONAL, .direction = {0, -0.8, 0}, .diffuse = {0, 1, 0}},
    .objects[0] = {.world_from_object = {{0.35, 0, -0.0457, 0, -0.1985, -0.1885, 0.5531, 0, -0.47,
                                          -0.298, -0.2717, 0, -1.116834, 1.045218, 1.022357, 1}},
                   .front = {.diffuse = {0, 1, 0}, .alpha = 1}},
    .shapes[0] = {.solid = {.kind = SOLID_TORUS, .radius = 1, .tube = 0.375}, .divisions = 24},
};

/* A corner coincides with the light up to a rounding of 1e-7. That rounding decides whether the
 * corner is in the cone, and with it the color of the whole triangle; as above, it counts as
 * rounding. */
static const RandomScene CORNER_ON_A_SPOT = {
    .scene = {.camera = {.eye = {-4.595986, 0, 0.06298793},
                         .center = {1, -0.2606417, 0.3246102},
                         .up = {0, 0, 1},
                         .fovy = 30,
                         .near = 1,
                         .far = 30},
              .light_count = 1,
              .object_count = 1,
              .interpolation = INTERPOLATION_FLAT},
    .lights[0] = {.kind = LIGHT_SPOT,
                  .position = {-0.2097941, -0.567428, -0.3658021},
                  .direction = {2, -3, 0},
                  .ambient = {0, 0, 1},
                  .cutoff = 60},
    .objects[0] = {.world_from_object = {{-0.4578859, -0.6577167, 0.5632253, 0, -0.5653535,
                                          0.8837304, 0.07307, 0, -0.7815227, -0.0503656, -0.6941708,
                                          0, 0.8321857, -0.6688385, -0.3323879, 1}},
                   .front = {.ambient = {0, 0, 1}, .alpha = 1}},
    .shapes[0] = {.form = FORM_TETRAHEDRON, .solid = {.radius = 1}, .divisions = 3},
};

/* A constant attenuation is part of the colors. 1 / 2e-308 is infinite as a float, and infinity
 * times 0 is NaN. */
static const RandomScene MIN_CONSTANT_ATTENUATION = {
    .scene = {.camera = {.eye = {0, 0, 1}, .up = {0, 1, 0}, .fovy = 1, .near = 0.5, .far = 30},
              .light_count = 1,
              .object_count = 1},
    .lights[0] = {.kind = LIGHT_SPOT,
                  .direction = {0, 0, 1},
                  .specular = {0, 0, 1},
                  .constant = 2e-308},
    .objects[0] = {.world_from_object = {{0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}},
                   .front = {.specular = {0, 0, 1}, .alpha = 1}},
    .shapes[0] = {.solid = {.kind = SOLID_QUAD}, .divisions = 3},
};

/* A matrix that moves corners to 1e30, whose square overflows a float. */
static const RandomScene CORNERS_TOO_FAR_AWAY = {
    .scene = {.camera = {.eye = {0, 1, 0}, .up = {1, 0, 0}, .fovy = 1, .near = 0.5, .far = 1},
              .light_count = 1,
              .object_count = 1},
    .lights[0] = {.kind = LIGHT_POINT, .diffuse = {0, 0, 1}, .constant = 1, .quadratic = 1},
    .objects[0] = {.world_from_object = {{0, 0, 1, 0, 1e30, 0, 0, 0, 0, 0, 0, 0, 0, 0.5, 0, 1}},
                   .front = {.diffuse = {0, 0, 1}, .alpha = 1}},
    .shapes[0] = {.solid = {.kind = SOLID_QUAD}, .divisions = 3},
};

/* The farthest corners allowed. The driver clips such a triangle at the sides of the view in
 * floats, whose steps are 6e7 there, so where it is cut is unspecified. Only finite values are
 * required. */
static const RandomScene CORNERS_FAR_AWAY = {
    .scene = {.camera = {.eye = {0, 0, 1}, .up = {0, 1, 0}, .fovy = 30, .near = 1, .far = 30},
              .background = {0.8, 0.05, 0.65},
              .light_count = 0,
              .object_count = 1},
    .objects[0] = {.world_from_object = {{0, 0, 1e15, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 1, 0, 1}},
                   .front = {.alpha = 1}},
    .shapes[0] = {.solid = {.kind = SOLID_QUAD}, .divisions = 3},
};

/* One light computed at the vertices and one at the fragments, both specular: both shaders have the
 * uniform of the shininess. mediump gave it two precisions, and the program did not link. */
static const RandomScene SHININESS_IN_BOTH_SHADERS = {
    .scene = {.camera = {.eye = {0, 0, 4}, .up = {0, 1, 0}, .fovy = 40, .near = 1, .far = 10},
              .light_count = 2,
              .object_count = 1,
              .distant_viewer = true},
    .lights[0] = {.kind = LIGHT_DIRECTIONAL, .direction = {0, 0, 1}, .specular = {1, 0, 0}},
    .lights[1] = {.kind = LIGHT_POINT, .position = {0, 0, 2}, .specular = {0, 1, 0}},
    .objects[0] = {.world_from_object = IDENTITY,
                   .front = {.specular = {0.9, 0.9, 0.9}, .alpha = 1, .shininess = 8}},
    .shapes[0] = {.solid = {.kind = SOLID_QUAD}, .divisions = 3},
};

typedef struct Found {
    const char *name;
    const RandomScene *scene;
    double max; /* steps of 1/255, beyond the allowance for rounding; see search_error */
} Found;

#define FOUND(scene, max)                                                                          \
    {                                                                                              \
#scene, &scene, max                                                                        \
    }

static const Found FOUND_SCENES[] = {
    FOUND(SHININESS_NEXT_TO_0, 0.1),
    FOUND(STRONG_LIGHT_ASIDE, 0.1),
    FOUND(CLOSE_LOOK_AT_A_CONE, 0.1),
    FOUND(NARROW_CONE_SEEN_CLOSELY, 0.1),
    FOUND(SMALL_TRIANGLES_IN_THE_DARK, 0.5),
    FOUND(CORNER_ON_A_SPOT, 0.1),
    FOUND(CORNERS_FAR_AWAY, 255),
    FOUND(CORNERS_TOO_FAR_AWAY, 255),
    FOUND(MIN_CONSTANT_ATTENUATION, 0.1),
    FOUND(SHININESS_IN_BOTH_SHADERS, 0.1),
};

static Search search;

FIXTURE(open_all)
{
    search_open(&search, SIZE, 1);
    return 0;
}

FIXTURE(close_all)
{
    search_close(&search);
    return 0;
}

TEST(found_scenes_stay_within_their_bounds)
{
    for (size_t i = 0; i < sizeof FOUND_SCENES / sizeof FOUND_SCENES[0]; i++) {
        const Found *found = &FOUND_SCENES[i];
        RandomScene scene = *found->scene;
        const double error = search_error(&search, &scene, 0);
        const bool refused = !scene_check(&scene.scene, NULL);
        const bool right = refused || (error >= 0 && error <= found->max);
        print_message("%s: %.3g steps, of %g\n", found->name, error, found->max);
        if (!right)
            fail_msg("%s: %g steps, of %g", found->name, error, found->max);
    }
}

/* In mediump only that the program links. */
TEST(shininess_in_both_shaders_links)
{
    RandomScene scene = SHININESS_IN_BOTH_SHADERS;
    assert_true(random_scene_ready(&scene, &search.meshes, NULL));
    for (int i = 0; i < 2; i++) {
        require(random_scene_draw(&scene, &hard.floats, hard.lightings[i], &hard.real, FAILURE),
                FAILURE);
    }
}

PICTURE_TEST_MAIN("found", open_all, close_all)
