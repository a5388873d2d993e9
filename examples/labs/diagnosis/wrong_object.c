/* Each choice is one term of a product left out, put elsewhere or taken twice, as a student would:
 * a table or a switch has the forms, 0 is always the right one. */
#include "labs/diagnosis/wrong_program.h"

#include "core/example.h"
#include "labs/program/binding.h"

#include <math.h>

int made_choice(const Made *made, Slot slot)
{
    return made->of[slot];
}

/* 1 if the factor is another. */
double made_factor(const Made *made, Factor which)
{
    return made->choices->factor == which ? made->choices->value : 1;
}

/* The value if that is the factor. */
double made_value(const Made *made, Factor which, double otherwise)
{
    return made->choices->factor == which ? made->choices->value : otherwise;
}

/* Matrices. */

Mat4 made_part(Mat4 right, int choice)
{
    Mat4 inverse;
    if (choice == PART_INVERSE && mat4_inverse(right, &inverse))
        return inverse;
    return choice == PART_MISSING ? mat4_identity() : right;
}

static void world_parts(const Made *made, Mat4 *move, Mat4 *turn, Mat4 *scale)
{
    static const Vec3 AXES[] = {[AXIS_X] = {1, 0, 0}, [AXIS_Y] = {0, 1, 0}, [AXIS_Z] = {0, 0, 1}};
    const double degrees = DEGREES_PER_SECOND * made->lab_scene->seconds, radian = 180 / acos(-1);
    const double angles[] = {degrees, [PART_MISSING] = 0, [TURN_RADIANS] = degrees / radian,
                             [TURN_DEGREES] = degrees * radian};
    const double angle = angles[made_choice(made, SLOT_TURN)];
    const int axis = made_choice(made, SLOT_AXIS);
    lab_scene_world_parts(made->lab_scene->seconds, move, turn, scale);
    *move = made_part(*move, made_choice(made, SLOT_MOVE));
    *scale = made_part(*scale, made_choice(made, SLOT_SCALE));
    *turn = mat4_rotate(made_choice(made, SLOT_TURN_SIGN) ? -angle : angle,
                        axis ? AXES[axis] : LAB_AXIS);
}

static Mat4 product_of(Mat4 first, Mat4 second, Mat4 third)
{
    return mat4_product(first, mat4_product(second, third));
}

/* The object's, except in lab 3, whose C makes it. */
Mat4 made_model_matrix(const Made *made)
{
    Mat4 move, turn, scale;
    if (!made->lab->given)
        return made->object->world_from_object;
    world_parts(made, &move, &turn, &scale);
    const int order = made_choice(made, SLOT_ORDER), world = made_choice(made, SLOT_WORLD);
    const Mat4 matrix = order == ORDER_MOVED_FIRST   ? product_of(turn, move, scale)
                        : order == ORDER_SCALED_LAST ? product_of(move, scale, turn)
                        : order == ORDER_REVERSED    ? product_of(scale, turn, move)
                                                     : product_of(move, turn, scale);
    return world == WORLD_TRANSPOSED ? mat4_transpose(matrix)
           : world == WORLD_IDENTITY ? mat4_identity()
           : world == WORLD_INVERSE  ? made_part(matrix, PART_INVERSE)
                                     : matrix;
}

Mat4 made_clip_matrix(const Made *made)
{
    const Vec3 scales[] = {
        {1, 1, 1},
        [CLIP_UPSIDE_DOWN] = {1, -1, 1},
        [CLIP_SWAPPED] = {-1, 1, 1},
        [CLIP_ASPECT] = {(double)made->lab_scene->width / made->lab_scene->height, 1, 1},
        [CLIP_TRANSPOSED] = {1, 1, 1},
        [CLIP_FLAT] = {1, 1, 0},
        [CLIP_REVERSED] = {1, 1, -1}};
    const int clip = made_choice(made, SLOT_CLIP);
    if (clip == CLIP_NO_MODEL)
        return mat4_product(made->clip_from_eye, made->eye_from_world);
    if (clip == CLIP_NO_VIEW)
        return mat4_product(made->clip_from_eye, made->world);
    if (clip == CLIP_NO_PROJECTION)
        return mat4_product(made->eye_from_world, made->world);
    if (clip == CLIP_VIEW_LAST)
        return product_of(made->eye_from_world, made->clip_from_eye, made->world);
    const Mat4 right = product_of(made->clip_from_eye, made->eye_from_world, made->world);
    return clip == CLIP_TRANSPOSED    ? mat4_transpose(right)
           : clip == CLIP_MODEL_TWICE ? mat4_product(right, made->world)
                                      : mat4_product(mat4_scale(scales[clip]), right);
}

static Mat4 without_translation(Mat4 matrix)
{
    matrix.m[12] = matrix.m[13] = matrix.m[14] = 0;
    return matrix;
}

Mat4 made_place_matrix(const Made *made)
{
    switch (made_choice(made, SLOT_PLACE)) {
    case PLACE_OBJECT:
        return mat4_identity();
    case PLACE_W_0:
        return without_translation(made->world);
    case PLACE_EYE:
        return mat4_product(made->eye_from_world, made->world);
    case PLACE_TRANSPOSED:
        return mat4_transpose(made->world);
    case PLACE_CLIP:
        return product_of(made->clip_from_eye, made->eye_from_world, made->world);
    case PLACE_NORMAL_MATRIX:
        return binding_normal_matrix(made->world);
    case PLACE_NOT_TO_EYE:
        return mat4_product(made_part(made->eye_from_world, PART_INVERSE), made->world);
    default:
        return made->world;
    }
}

static Mat4 unsigned_normal_matrix(const Made *made)
{
    static const Mat4 SWAPS[] = {{{1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1}},
                                 {{0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                                 {{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1}}};
    Mat4 move, turn, scale;
    switch (made_choice(made, SLOT_NORMAL)) {
    case NORMAL_OBJECT:
        return mat4_identity();
    case NORMAL_MODEL:
        return without_translation(made->world);
    case NORMAL_WORLD_POSITION:
    case NORMAL_MODEL_W_1:
        return made->world;
    case NORMAL_INVERSE:
        return mat4_transpose(binding_normal_matrix(made->world));
    case NORMAL_TRANSPOSE:
        return mat4_transpose(made->world);
    case NORMAL_EYE:
        return binding_normal_matrix(mat4_product(made->eye_from_world, made->world));
    case NORMAL_NOT_TO_EYE: /* as seen from world space */
        return mat4_product(without_translation(made_part(made->eye_from_world, PART_INVERSE)),
                            binding_normal_matrix(made->world));
    case NORMAL_XZY:
    case NORMAL_YXZ:
    case NORMAL_ZYX:
        return mat4_product(binding_normal_matrix(made->world),
                            SWAPS[made_choice(made, SLOT_NORMAL) - NORMAL_XZY]);
    case NORMAL_CLIP:
        return without_translation(
            product_of(made->clip_from_eye, made->eye_from_world, made->world));
    case NORMAL_VIEW:
        return without_translation(made->eye_from_world);
    case NORMAL_TURN:
        world_parts(made, &move, &turn, &scale);
        return turn;
    case NORMAL_UNTURNED:
        world_parts(made, &move, &turn, &scale);
        return binding_normal_matrix(scale);
    case NORMAL_REVERSED:
        world_parts(made, &move, &turn, &scale);
        return binding_normal_matrix(mat4_product(scale, turn));
    default:
        return binding_normal_matrix(made->world);
    }
}

Mat4 made_normal_matrix(const Made *made)
{
    const Mat4 normal = unsigned_normal_matrix(made);
    const int sign = made_choice(made, SLOT_NORMAL_SIGN);
    if (sign == SIGN_REVERSED || (sign == SIGN_MIRRORED && mat4_determinant(made->world) < 0))
        return mat4_product(mat4_scale((Vec3){-1, -1, -1}), normal);
    return normal;
}

/* Lights. */

Vec3 made_product(Vec3 a, Vec3 b)
{
    return (Vec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

static const Vec3 WHITE = {1, 1, 1}, BLACK = {0, 0, 0};

void made_choose_light_colors(Made *made)
{
    for (int i = 0; i < LAB_MAX_LIGHTS; i++) {
        Vec3 *color = &made->light_color[i];
        *color = i < made->lab->lights ? made->lab_scene->lights[i].diffuse : BLACK;
        if (i < made->lab->lights && made_choice(made, SLOT_LIGHT_COLOR) == LIGHT_COLOR_IGNORED)
            *color = WHITE;
        if (made_choice(made, SLOT_LIGHT_COLOR) == LIGHT_COLOR_SWAPPED)
            *color = (Vec3){color->z, color->y, color->x};
        if (made_choice(made, SLOT_LIGHT_COLOR) == LIGHT_COLOR_RED)
            color->y = color->z = color->x;
        if (i < made->lab->lights && made->choices->factor == FACTOR_LIGHT_VALUE)
            *color = vec3_scale(WHITE, made->choices->value);
        *color = vec3_scale(*color, made_factor(made, i == 0 ? FACTOR_FIRST : FACTOR_SECOND));
        if (made_choice(made, SLOT_LIGHT_COLOR) == LIGHT_COLOR_SQUARED)
            *color = made_product(*color, *color);
        if (made_choice(made, SLOT_LIGHTS) == LIGHTS_MEAN)
            *color = vec3_scale(*color, 1.0 / made->lab->lights);
        if ((made_choice(made, SLOT_LIGHTS) == LIGHTS_FIRST && i == 1) ||
            (made_choice(made, SLOT_LIGHTS) == LIGHTS_SECOND && i == 0))
            *color = BLACK;
    }
    const Vec3 first = made->light_color[0], second = made->light_color[1];
    const int of = made_choice(made, SLOT_LIGHTS);
    if (of == LIGHTS_SWAPPED || of == LIGHTS_SECOND_COLOR)
        made->light_color[0] = second;
    if (of == LIGHTS_SWAPPED || of == LIGHTS_FIRST_COLOR)
        made->light_color[1] = first;
}

void made_choose_light_places(Made *made)
{
    const Vec3 center = mat4_transform_point(made->world, (Vec3){0, 0, 0});
    const bool directional = made->lab->light == LIGHT_DIRECTIONAL;
    for (int i = 0; i < LAB_MAX_LIGHTS; i++) {
        const Light *light = &made->lab_scene->lights[i < made->lab->lights ? i : 0];
        Vec3 *place = &made->light[i];
        *place = directional ? light->direction : light->position;
        if (directional)
            vec3_normalize(*place, place);
        if (made_choice(made, SLOT_LIGHT_SPACE) == LIGHT_SPACE_EYE)
            *place = directional ? mat4_transform_direction(made->eye_from_world, *place)
                                 : mat4_transform_point(made->eye_from_world, *place);
        const int space = made_choice(made, SLOT_LIGHT_SPACE);
        const Mat4 world_from_eye = made_part(made->eye_from_world, PART_INVERSE);
        if (space == LIGHT_SPACE_NOT_TO_EYE)
            *place = directional ? mat4_transform_direction(world_from_eye, *place)
                                 : mat4_transform_point(world_from_eye, *place);
        if (space == LIGHT_SPACE_MODEL || space == LIGHT_SPACE_NORMAL)
            *place = mat4_transform_direction(
                space == LIGHT_SPACE_NORMAL ? binding_normal_matrix(made->world) : made->world,
                *place);
        if (space == LIGHT_SPACE_UNIT)
            vec3_normalize(*place, place);
        if (space == LIGHT_SPACE_W_0)
            *place = vec3_add(*place, made->lab_scene->scene.camera.eye);
        if (space == LIGHT_SPACE_MODEL_W_1)
            *place = mat4_transform_point(made->world, *place);
        if (made_choice(made, SLOT_LIGHT) == LIGHT_FROM_CENTER)
            *place = vec3_subtract(*place, center);
    }
    for (int i = 0; i < LAB_MAX_LIGHTS; i++)
        if (made_choice(made, SLOT_LIGHTS) == LIGHTS_FIRST_REVERSED + i)
            made->light[i] = vec3_scale(made->light[i], -1);
    if (made_choice(made, SLOT_LIGHTS) == LIGHTS_FIRST_PLACE)
        made->light[1] = made->light[0];
    if (made_choice(made, SLOT_LIGHTS) == LIGHTS_SECOND_PLACE)
        made->light[0] = made->light[1];
}

/* Colours. */

static Vec3 surface_color(const Made *made, Vec3 color)
{
    if (made_choice(made, SLOT_COLOR) == COLOR_SQUARED)
        return made_product(color, color);
    if (made_choice(made, SLOT_COLOR) == COLOR_SWAPPED)
        return (Vec3){color.z, color.y, color.x};
    if (made_choice(made, SLOT_COLOR) == COLOR_RBG)
        return (Vec3){color.x, color.z, color.y};
    if (made_choice(made, SLOT_COLOR) == COLOR_GRB)
        return (Vec3){color.y, color.x, color.z};
    return made_choice(made, SLOT_COLOR) == COLOR_IGNORED ? WHITE : color;
}

/* A colour in the diffuse term, which may be another than in the ambient term. */
static Vec3 lit_color(const Made *made, Vec3 color)
{
    switch (made_choice(made, SLOT_COLOR)) {
    case COLOR_LIT_IGNORED:
        return WHITE;
    case COLOR_LIT_SQUARED:
        return made_product(color, color);
    case COLOR_LIT_SWAPPED:
        return (Vec3){color.z, color.y, color.x};
    default:
        return color;
    }
}

static Vec3 base_color(const Made *made, Vec3 surface)
{
    const Vec3 ambient = made->choices->factor == FACTOR_AMBIENT_VALUE
                             ? vec3_scale(WHITE, made->choices->value)
                             : made->lab_scene->scene.global_ambient;
    const Vec3 base = vec3_scale(made_product(ambient, surface), made_factor(made, FACTOR_AMBIENT));
    const int lights = made_choice(made, SLOT_LIGHTS);
    switch (made_choice(made, SLOT_AMBIENT)) {
    case AMBIENT_MISSING:
        return BLACK;
    case AMBIENT_PER_LIGHT: /* once for each light in the sum */
        return vec3_scale(
            base, lights == LIGHTS_FIRST || lights == LIGHTS_SECOND ? 1 : made->lab->lights);
    case AMBIENT_PLAIN:
        return ambient;
    case AMBIENT_WHITE:
        return surface;
    case AMBIENT_SQUARED:
        return made_product(base, ambient);
    case AMBIENT_LIGHT_COLOR:
        return made_product(base, vec3_add(made->light_color[0], made->light_color[1]));
    default:
        return base;
    }
}

double made_exponent(const Made *made, bool blinn_phong)
{
    const double shininess = made->object->front.shininess;
    const double fitted = made->lab_scene->fitted[made->object - made->lab_scene->objects];
    const double wrong[] = {
        0, [EXPONENT_PLAIN] = shininess, [EXPONENT_ONE] = 1, [EXPONENT_QUARTER] = shininess / 4,
        [EXPONENT_SQUARED] = shininess * shininess};
    if (made_choice(made, SLOT_EXPONENT))
        return wrong[made_choice(made, SLOT_EXPONENT)];
    if (made_choice(made, SLOT_REFLECTION) == REFLECTION_OTHER_FITTED)
        return blinn_phong ? 4 * shininess : shininess;
    /* Between the two right exponents: 1 step of 255 from either. */
    const double right[] = {
        (4 * shininess + fitted) / 2, [FIT_LEAST_SQUARES] = fitted, [FIT_FOUR] = 4 * shininess};
    return made->lab->fitted ? right[made_choice(made, SLOT_FIT)] : shininess;
}

/* What normalizes the highlight's energy. */
static double energy(const Made *made)
{
    const double n = made_exponent(made, made->lab->reflection == REFLECTION_BLINN_PHONG);
    return made_choice(made, SLOT_HIGHLIGHT_COLOR) == HIGHLIGHT_ENERGY_2 ? (n + 2) / (2 * acos(-1))
                                                                         : (n + 8) / (8 * acos(-1));
}

/* The colours of the surface's sides. */
static void choose_sides(const Made *made, Vec3 *front, Vec3 *back)
{
    const int of = made_choice(made, SLOT_BACK);
    const bool mirrored = mat4_determinant(made->world) < 0;
    const bool swapped = of == BACK_COLORS_SWAPPED || (of == BACK_COLORS_MIRRORED && mirrored);
    const Vec3 own_front = surface_color(made, made->object->front.diffuse);
    const Vec3 own_back = surface_color(made, made->object->back.diffuse);
    *front = swapped ? own_back : own_front;
    *back = swapped ? own_front : own_back;
    if (of == BACK_PRODUCT)
        *back = made_product(own_front, own_back);
    if (of == BACK_FRONT_COLOR || !made->lab->two_sided || (of == BACK_NEVER_MIRRORED && mirrored))
        *back = *front;
}

/* A light's highlight. */
static Vec3 specular_color(const Made *made, Vec3 front, int light)
{
    const int of = made_choice(made, SLOT_HIGHLIGHT_COLOR);
    const double factor = made_factor(made, FACTOR_ALL) * made_factor(made, FACTOR_SPECULAR);
    const Vec3 own = made->object->front.specular;
    Vec3 color = made_product(own, made->light_color[light]);
    if (of == HIGHLIGHT_TINTED)
        color = made_product(color, front);
    if (of == HIGHLIGHT_WHITE)
        color = made->light_color[light];
    if (of == HIGHLIGHT_WHITE_LIGHT)
        color = light < made->lab->lights ? own : BLACK;
    if (of >= HIGHLIGHT_ENERGY_2)
        color = vec3_scale(color, energy(made));
    if (made->choices->factor == FACTOR_SPECULAR_VALUE)
        color = vec3_scale(made->light_color[light], made->choices->value);
    return made_choice(made, SLOT_HIGHLIGHT_LIGHTS) == HIGHLIGHT_LIGHTS_FIRST + 1 - light
               ? BLACK
               : vec3_scale(color, factor);
}

MadeColors made_colors(const Made *made)
{
    const double whole = made_factor(made, FACTOR_ALL), limit = made_factor(made, FACTOR_LIMIT);
    const double light = made_value(made, FACTOR_PLUS_LIGHT, 0);
    const double plus = made_value(made, FACTOR_PLUS_COLOR, 0);
    const bool added = made_choice(made, SLOT_COLOR) == COLOR_ADDED;
    const int ambient = made_choice(made, SLOT_AMBIENT);
    Vec3 front, back;
    choose_sides(made, &front, &back);
    const Vec3 back_base = ambient == AMBIENT_FRONT ? front : back;
    MadeColors colors = {
        .base = {vec3_scale(base_color(made, added ? WHITE : front), whole),
                 ambient == AMBIENT_NOT_BACK
                     ? BLACK
                     : vec3_scale(base_color(made, added ? WHITE : back_base), whole)},
        .limit = {vec3_scale(front, limit), vec3_scale(back, limit)},
        .plus = vec3_add(vec3_scale(front, light), added ? front : (Vec3){plus, plus, plus})};
    for (int i = 0; i < 2; i++) {
        const Vec3 lit =
            vec3_scale(made->light_color[i], whole * made_factor(made, FACTOR_DIFFUSE));
        colors.diffuse[i] = added ? lit : made_product(lit_color(made, front), lit);
        colors.diffuse[2 + i] = added ? lit : made_product(lit_color(made, back), lit);
        colors.specular[i] = specular_color(made, front, i);
    }
    return colors;
}
