/* Points are drawn by chance in triangles that face the eye, as many in each object of each scene,
 * so that all that scenes are made for shows. A vertex shader's results are kept by point: of most
 * pairs of shaders that are compared only the fragment shader differs. */
#include "labs/diagnosis/points.h"

#include "base/memory.h"
#include "labs/program/lab_scene_open.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Shadows cover little. */
enum { OF_OBJECT = 24, OF_OBJECT_IN_SHADOW = 60, TRIES = 40 * OF_OBJECT_IN_SHADOW };

static unsigned char *read_map(const LabShadowMap *map)
{
    GLuint framebuffer;
    GLint target;
    unsigned char *texels = memory_new((size_t)LAB_SHADOW_MAP_SIZE * LAB_SHADOW_MAP_SIZE, 4);
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &target);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, map->texture, 0);
    glReadPixels(0, 0, LAB_SHADOW_MAP_SIZE, LAB_SHADOW_MAP_SIZE, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)target);
    glDeleteFramebuffers(1, &framebuffer);
    return texels;
}

const float *points_value(const PointSetting *setting, const char *name)
{
    for (int i = 0; i < setting->value_count; i++)
        if (strcmp(setting->values[i].name, name) == 0)
            return setting->values[i].numbers;
    return NULL;
}

static void multiply(const float m[16], const float v[3], double clip[4])
{
    for (int i = 0; i < 4; i++)
        clip[i] =
            (double)m[i] * v[0] + (double)m[4 + i] * v[1] + (double)m[8 + i] * v[2] + m[12 + i];
}

/* Counter-clockwise, as the eye sees it. */
static bool is_front(double clip[POINT_CORNERS][4])
{
    const double *a = clip[0], *b = clip[1], *c = clip[2];
    return a[0] * (b[1] * c[3] - c[1] * b[3]) - a[1] * (b[0] * c[3] - c[0] * b[3]) +
               a[3] * (b[0] * c[1] - c[0] * b[1]) >
           0;
}

static bool faces_eye(const PointSetting *setting, const Point *point)
{
    const float *matrix = points_value(setting, "u_MvpMatrix");
    double clip[POINT_CORNERS][4];
    for (int i = 0; i < POINT_CORNERS; i++) {
        multiply(matrix, point->corners[i].position, clip[i]);
        if (clip[i][3] <= 0)
            return false;
    }
    return is_front(clip);
}

static MeshVertex middle(const Point *point)
{
    MeshVertex vertex = {{0}, {0}};
    for (int i = 0; i < POINT_CORNERS; i++) {
        for (int k = 0; k < 3; k++) {
            vertex.position[k] += (float)(point->weights[i] * point->corners[i].position[k]);
            vertex.normal[k] += (float)(point->weights[i] * point->corners[i].normal[k]);
        }
    }
    return vertex;
}

void points_place(const Points *points, int point, double place[3])
{
    const Point *at = &points->items[point];
    const MeshVertex center = middle(at);
    double clip[4];
    multiply(points_value(&points->settings[at->setting], "u_MvpMatrix"), center.position, clip);
    for (int k = 0; k < 3; k++)
        place[k] = clip[k] / clip[3];
}

/* Rounds down, as a texture that is not filtered does, and ends at its edges. */
static int texel_at(double coordinate)
{
    const double at = floor(coordinate * LAB_SHADOW_MAP_SIZE);
    return !(at > 0) ? 0 : at >= LAB_SHADOW_MAP_SIZE ? LAB_SHADOW_MAP_SIZE - 1 : (int)at;
}

static const unsigned char *texel_of(const PointSetting *setting, double x, double y)
{
    return setting->map + 4 * ((size_t)texel_at(y) * LAB_SHADOW_MAP_SIZE + (size_t)texel_at(x));
}

/* Whether right programs differ there: some texels away another surface is before the light or the
 * map ends, or beside the very texel the depth is nearly that of the point, so that biases and
 * filters decide. */
static bool is_at_edge_of_shadow(const PointSetting *setting, const Point *point)
{
    static const double TEXELS[] = {6, 2, 1.5}, LEAST[] = {0.01, 0.01, 0.001};
    static const double MOST[] = {0.01, 0.01, 0.006};
    const MeshVertex center = middle(point);
    double world[4], clip[4];
    bool lit = false, dark = false;
    multiply(points_value(setting, "u_ModelMatrix"), center.position, world);
    const float place[3] = {(float)world[0], (float)world[1], (float)world[2]};
    multiply(points_value(setting, "u_LightMatrix"), place, clip);
    const double x = 0.5 * clip[0] / clip[3] + 0.5, y = 0.5 * clip[1] / clip[3] + 0.5;
    const double end = fmin(fmin(fabs(x), fabs(1 - x)), fmin(fabs(y), fabs(1 - y)));
    for (int i = 0; i < 27; i++) {
        const double reach = TEXELS[i / 9] / LAB_SHADOW_MAP_SIZE;
        const unsigned char *texel =
            texel_of(setting, x + (i % 3 - 1) * reach, y + (i / 3 % 3 - 1) * reach);
        const double behind = 0.5 * clip[2] / clip[3] + 0.5 - texel[0] / 255.0 - texel[1] / 65025.0;
        dark |= behind > LEAST[i / 9];
        lit |= behind <= MOST[i / 9];
    }
    return (lit && dark) || end < TEXELS[0] / LAB_SHADOW_MAP_SIZE;
}

static void add_points(Points *points, const Mesh *mesh, Random *random)
{
    const int setting = points->setting_count - 1, triangles = (int)(mesh->index_count / 3);
    const int wanted = points->lab->shadow ? OF_OBJECT_IN_SHADOW : OF_OBJECT;
    for (int try = 0, found = 0; try < TRIES && found < wanted; try++) {
        const int triangle = random_below(random, triangles);
        Point point = {.setting = setting};
        double sum = 0;
        for (int i = 0; i < POINT_CORNERS; i++) {
            point.corners[i] = mesh->vertices[mesh->indices[3 * triangle + i]];
            sum += point.weights[i] = random_between(random, 0.05, 1);
        }
        for (int i = 0; i < POINT_CORNERS; i++)
            point.weights[i] /= sum;
        if ((!points->lab->two_sided && !faces_eye(&points->settings[setting], &point)) ||
            (points->lab->shadow && is_at_edge_of_shadow(&points->settings[setting], &point)))
            continue;
        *(Point *)memory_add(&points->items, &points->count, &points->room, sizeof(Point)) = point;
        found++;
    }
}

static bool add_scene(Points *points, const LabScene *lab_scene, const Mesh *mesh,
                      LabShadowMap *map, Message *message)
{
    Random random = {0x5EED + (uint64_t)points->setting_count};
    bool done = !points->lab->shadow || lab_shadow_map_open(map, lab_scene, message);
    for (int i = 0; i < lab_scene->scene.object_count && done; i++) {
        PointSetting *setting = memory_add(&points->settings, &points->setting_count,
                                           &points->setting_room, sizeof *setting);
        const Drawn drawn = {.scene = &lab_scene->scene,
                             .object = i,
                             .aspect = (double)lab_scene->width / lab_scene->height,
                             .map = map,
                             .own = lab_scene->own};
        *setting = (PointSetting){
            .width = lab_scene->width, .height = lab_scene->height, .color = {0, 0, 0, 1}};
        setting->scene = lab_scene->known ? LAB_SCENE_NAMES[lab_scene->kind] : NULL;
        setting->value_count = binding_values(points->lab, &drawn, setting->values, message);
        vec3_to_float(lab_scene->objects[i].front.diffuse, setting->color);
        setting->owns_map = points->lab->shadow && i == 0;
        setting->map = setting->owns_map ? read_map(map) : i > 0 ? setting[-1].map : NULL;
        done = setting->value_count > 0;
        if (done)
            add_points(points, mesh ? mesh : &lab_scene->meshes[i], &random);
    }
    return done;
}

/* Another than those of the submission's seed: what is said does not depend on that. */
static bool add_further(Points *points, LabSceneKind kind, const Mesh *mesh, LabShadowMap *map,
                        Message *message)
{
    LabScene lab_scene;
    if (!lab_scene_open_seed(&lab_scene, points->lab, kind, 0x0F0E0D0C, message))
        return false;
    const bool done = add_scene(points, &lab_scene, mesh, map, message);
    lab_scene_close(&lab_scene);
    return done;
}

bool points_open(Points *points, const LabPictures *pictures, Message *message)
{
    const Mesh *mesh = pictures->mesh.vertices ? &pictures->mesh : NULL;
    LabShadowMap map = {0};
    bool done = true;
    *points = (Points){.lab = pictures->lab};
    for (int i = 0; i < pictures->count && done; i++) {
        const LabScene *lab_scene = &pictures->items[i].lab_scene;
        done = lab_scene->known ? add_scene(points, lab_scene, mesh, &map, message)
                                : add_further(points, lab_scene->kind, mesh, &map, message);
    }
    /* Where highlights are near the line of sight. */
    done = done && add_further(points, LAB_SCENE_ALONG, mesh, &map, message) &&
           add_further(points, LAB_SCENE_AGAINST, mesh, &map, message);
    lab_shadow_map_close(&map);
    return done;
}

void points_close(Points *points)
{
    for (int i = 0; i < points->setting_count; i++)
        if (points->settings[i].owns_map)
            free(points->settings[i].map);
    free(points->settings);
    free(points->items);
    *points = (Points){.count = 0};
}

/* Shaders. */

bool points_is_output(const GlslVariable *variable)
{
    return variable->storage == GLSL_VARYING ||
           (variable->storage == GLSL_OUT && strcmp(variable->name, "gl_Position") == 0);
}

/* Drivers do not count what is not used, but each point keeps it. */
static bool has_few_outputs(PointShader *shader)
{
    enum { MOST = 1024 };
    for (int i = 0; i < shader->code->variable_count && shader->width <= MOST; i++)
        if (points_is_output(&shader->code->variables[i]))
            shader->width += shader->code->variables[i].count;
    return shader->width <= MOST;
}

bool point_shader_open(PointShader *shader, const char *text, GlslStage stage)
{
    GlslLimits limits = GLSL_LIMITS;
    limits.silent = true;
    *shader = (PointShader){.setting = -1};
    shader->tree = glsl_parse(text, stage, &limits);
    if (shader->tree->message_count == 0 && glsl_check_whole(shader->tree)) {
        shader->code = glsl_compile(shader->tree);
        if (!shader->code->message.text[0] && has_few_outputs(shader)) {
            shader->run = glsl_run_open(shader->code);
            shader->run->loops = 1000;
            return true;
        }
    }
    point_shader_close(shader);
    return false;
}

void point_shader_close(PointShader *shader)
{
    if (!shader)
        return;
    glsl_run_close(shader->run);
    if (shader->code)
        glsl_code_free(shader->code);
    if (shader->tree)
        glsl_tree_free(shader->tree);
    free(shader->outputs);
    free(shader->done);
    free(shader->bound);
    *shader = (PointShader){.setting = -1};
}

static void look_up(void *context, int unit, int function, const double *coordinates, int count,
                    double color[4])
{
    PointSetting *setting = context;
    const bool projected = function == GLSL_TEXTURE_2D_PROJ || function == GLSL_TEXTURE_2D_PROJ_LOD;
    const double by = projected ? coordinates[count - 1] : 1;
    (void)unit;
    if (!setting->map)
        return;
    setting->map_read = true;
    const unsigned char *texel = texel_of(setting, coordinates[0] / by, coordinates[1] / by);
    for (int i = 0; i < 4; i++)
        color[i] = texel[i] / 255.0;
}

static bool is_left_out(const Points *points, const char *name, int element)
{
    const int light = element == 0 ? POINTS_NO_FIRST : POINTS_NO_SECOND;
    return ((points->without & POINTS_NO_AMBIENT) && strcmp(name, "u_AmbientLight") == 0) ||
           ((points->without & POINTS_NO_SPECULAR) && strcmp(name, "u_SpecularColor") == 0) ||
           ((points->without & light) && strcmp(name, "u_LightColor") == 0);
}

/* A mat3 has the upper left part of a mat4, a vec3 the first of four numbers. */
static void set_uniform(const Points *points, PointShader *shader, const GlslVariable *variable,
                        const BindingValue *value)
{
    const GlslType *type = &shader->tree->types[variable->type];
    const int elements = type->element ? type->length : 1;
    const int size = variable->count / elements;
    double *to = shader->run->registers + variable->first;
    for (int i = 0; i < elements && i < value->count; i++) {
        const bool out = is_left_out(points, value->name, i);
        for (int k = 0; k < size; k++) {
            const int from = value->size == 16 && size == 9 ? 4 * (k / 3) + k % 3 : k;
            to[i * size + k] =
                out || from >= value->size ? 0 : value->numbers[i * value->size + from];
        }
    }
}

/* All settings have the same values, in the same order. */
static void bind(const PointSetting *setting, PointShader *shader)
{
    const GlslCode *code = shader->code;
    shader->bound = memory_new((size_t)code->variable_count + 1, sizeof(int));
    for (int i = 0; i < code->variable_count; i++) {
        shader->bound[i] = -1;
        if (code->variables[i].storage != GLSL_UNIFORM)
            continue;
        for (int k = 0; k < setting->value_count && shader->bound[i] < 0; k++)
            if (strcmp(setting->values[k].name, code->variables[i].name) == 0)
                shader->bound[i] = k;
        shader->lit |= is_left_out(&(Points){.without = ~0}, code->variables[i].name, 0);
    }
}

static void use_setting(const Points *points, PointShader *shader, int number)
{
    PointSetting *setting = &points->settings[number];
    if (shader->setting == number && (shader->without == points->without || !shader->lit))
        return;
    shader->setting = number;
    shader->without = points->without;
    shader->run->texture = look_up;
    shader->run->context = setting;
    if (!shader->bound)
        bind(setting, shader);
    for (int i = 0; i < shader->code->variable_count; i++)
        if (shader->bound[i] >= 0)
            set_uniform(points, shader, &shader->code->variables[i],
                        &setting->values[shader->bound[i]]);
}

static bool is_called(const char *name, const char *own, const char *usual)
{
    return strcmp(name, own ? own : usual) == 0;
}

static void set_attributes(const Points *points, PointShader *shader, const PointSetting *setting,
                           const MeshVertex *vertex)
{
    const LabAttributes *names = &points->lab->attributes;
    for (int i = 0; i < shader->code->variable_count; i++) {
        const GlslVariable *variable = &shader->code->variables[i];
        if (variable->storage == GLSL_VARYING) /* not what the last run left */
            memset(shader->run->registers + variable->first, 0,
                   (size_t)variable->count * sizeof(double));
        if (variable->storage != GLSL_ATTRIBUTE)
            continue;
        const float *from = is_called(variable->name, names->position, "a_Position")
                                ? vertex->position
                            : is_called(variable->name, names->normal, "a_Normal") ? vertex->normal
                                                                                   : setting->color;
        double *to = shader->run->registers + variable->first;
        for (int k = 0; k < variable->count; k++)
            to[k] = k == 3 ? 1 : from[k]; /* also of a normal */
    }
}

static void prepare(const Points *points, PointShader *shader)
{
    if (!shader->outputs) {
        shader->outputs =
            memory_new((size_t)(points->count * POINT_CORNERS * shader->width), sizeof(double));
        shader->done = memory_new((size_t)points->count, sizeof(bool));
    }
    if (shader->setting >= 0 && shader->without != points->without && shader->lit)
        memset(shader->done, 0, (size_t)points->count * sizeof(bool));
}

static void run_corners(const Points *points, PointShader *shader, int number)
{
    const Point *point = &points->items[number];
    prepare(points, shader);
    if (shader->done[number])
        return;
    shader->done[number] = true;
    use_setting(points, shader, point->setting);
    double *to = shader->outputs + (size_t)number * POINT_CORNERS * (size_t)shader->width;
    for (int corner = 0; corner < POINT_CORNERS; corner++) {
        const MeshVertex center = middle(point);
        set_attributes(points, shader, &points->settings[point->setting],
                       shader->at_once ? &center : &point->corners[corner]);
        glsl_run(shader->run);
        for (int i = 0; i < shader->code->variable_count; i++) {
            const GlslVariable *variable = &shader->code->variables[i];
            if (!points_is_output(variable))
                continue;
            memcpy(to, shader->run->registers + variable->first,
                   (size_t)variable->count * sizeof(double));
            to += variable->count;
        }
    }
}

/* A varying's or gl_Position's interpolated numbers; false: the vertex shader has none. */
static bool interpolate(const Points *points, const PointShader *vertex, int number,
                        const char *name, double *numbers, int count)
{
    const Point *point = &points->items[number];
    const double *from = vertex->outputs + (size_t)number * POINT_CORNERS * (size_t)vertex->width;
    for (int i = 0; i < vertex->code->variable_count; i++) {
        const GlslVariable *variable = &vertex->code->variables[i];
        if (!points_is_output(variable))
            continue;
        if (strcmp(variable->name, name) == 0 && variable->count == count) {
            for (int k = 0; k < count; k++) {
                numbers[k] = 0;
                for (int corner = 0; corner < POINT_CORNERS; corner++)
                    numbers[k] +=
                        (points->corner ? points->corner == corner + 1 : point->weights[corner]) *
                        from[corner * vertex->width + k];
            }
            return true;
        }
        from += variable->count;
    }
    return false;
}

static void corner_places(const PointShader *vertex, int number, double clip[POINT_CORNERS][4])
{
    const double *from = vertex->outputs + (size_t)number * POINT_CORNERS * (size_t)vertex->width;
    for (int i = 0; i < vertex->code->variable_count; i++) {
        const GlslVariable *variable = &vertex->code->variables[i];
        if (!points_is_output(variable))
            continue;
        for (int k = 0; k < POINT_CORNERS && strcmp(variable->name, "gl_Position") == 0; k++)
            memcpy(clip[k], from + k * vertex->width, 4 * sizeof(double));
        from += variable->count;
    }
}

/* What is undefined is like nothing else. */
static double from_0_to_1(double number)
{
    return isnan(number) ? -2 : fmax(0, fmin(number, 1));
}

static void set_inputs(const Points *points, const PointShader *vertex, PointShader *fragment,
                       int number, const double clip[4])
{
    const PointSetting *setting = &points->settings[points->items[number].setting];
    double corners[POINT_CORNERS][4] = {{0}};
    for (int i = 0; i < fragment->code->variable_count; i++) {
        const GlslVariable *variable = &fragment->code->variables[i];
        double *to = fragment->run->registers + variable->first;
        if (variable->storage == GLSL_VARYING) {
            interpolate(points, vertex, number, variable->name, to, variable->count);
        } else if (variable->storage != GLSL_IN) {
            continue;
        } else if (strcmp(variable->name, "gl_FragCoord") == 0) {
            to[0] = (clip[0] / clip[3] + 1) / 2 * setting->width;
            to[1] = (clip[1] / clip[3] + 1) / 2 * setting->height;
            to[2] = (clip[2] / clip[3] + 1) / 2;
            to[3] = 1 / clip[3];
        } else if (strcmp(variable->name, "gl_FrontFacing") == 0) {
            corner_places(vertex, number, corners);
            to[0] = is_front(corners);
        }
    }
}

void points_run(const Points *points, PointShader *vertex, PointShader *fragment, int point,
                double numbers[POINT_NUMBERS])
{
    double clip[4] = {0, 0, 0, 1};
    GlslVariable color;
    run_corners(points, vertex, point);
    interpolate(points, vertex, point, "gl_Position", clip, 4);
    use_setting(points, fragment, points->items[point].setting);
    set_inputs(points, vertex, fragment, point, clip);
    const bool ran = glsl_run(fragment->run) && !fragment->run->discarded;
    const bool found = glsl_find(fragment->code, "gl_FragColor", &color) ||
                       glsl_find(fragment->code, "gl_FragData[0]", &color);
    for (int i = 0; i < 3; i++) {
        numbers[i] = ran && found ? from_0_to_1(fragment->run->registers[color.first + i])
                     : ran        ? 0
                                  : -1;
        numbers[3 + i] = clip[i] / clip[3];
    }
}

double points_apart(const double a[POINT_NUMBERS], const double b[POINT_NUMBERS])
{
    double most = 0;
    for (int i = 0; i < POINT_NUMBERS; i++) {
        const double apart = fabs(a[i] - b[i]);
        most = apart > most ? apart : isnan(apart) ? 2 : most;
    }
    return most;
}
