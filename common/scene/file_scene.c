/* From lists of a file to a scene: objects and lights go where their nodes are; what a file may
 * leave open is chosen from the box around everything. */
#include "scene/file_scene.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/parse.h"
#include "scene/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Grows a box by another one, wherever a matrix puts that. */
static void grow(MeshBox *all, const MeshBox *box, Mat4 world_from_box)
{
    for (int corner = 0; corner < 8; corner++) {
        const Vec3 p =
            mat4_transform_point(world_from_box, (Vec3){corner & 1 ? box->high.x : box->low.x,
                                                        corner & 2 ? box->high.y : box->low.y,
                                                        corner & 4 ? box->high.z : box->low.z});
        all->low = (Vec3){fmin(all->low.x, p.x), fmin(all->low.y, p.y), fmin(all->low.z, p.z)};
        all->high = (Vec3){fmax(all->high.x, p.x), fmax(all->high.y, p.y), fmax(all->high.z, p.z)};
    }
}

/* Of an animation, where everything is at some of its times. */
static void find_middle(FileScene *made)
{
    enum { TIMES = 16 };
    const SceneFile *file = &made->file;
    double seconds = 0;
    MeshBox all = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    MeshBox *boxes = memory_new((size_t)file->mesh_count, sizeof *boxes);
    for (int i = 0; i < file->mesh_count; i++)
        boxes[i] = mesh_bounds(&file->meshes[i]);
    for (int i = 0; i < file->channel_count; i++)
        seconds = fmax(seconds,
                       (double)file->keys[file->channels[i].first + file->channels[i].count - 1]);
    for (int t = 0; t <= (file->channel_count > 0 ? TIMES : 0); t++) {
        scene_file_pose(file, seconds * t / (TIMES + 1), made->poses);
        for (int i = 0; i < file->object_count; i++)
            grow(&all, &boxes[file->objects[i].mesh], made->poses[file->objects[i].node]);
    }
    scene_file_pose(file, 0, made->poses);
    free(boxes);
    const Vec3 half = vec3_scale(vec3_subtract(all.high, all.low), 0.5);
    made->middle = vec3_add(all.low, half);
    made->radius = vec3_length(half);
}

/* Cameras */

static const double RADIANS = 0.017453292519943295;

static bool list_cameras(const SceneFile *file, const char *asked, Message *message)
{
    message_set(message, "camera %s: there is none; the file has ", asked);
    for (int i = 0; i < file->camera_count && i < 20; i++) {
        const FileCamera *camera = &file->cameras[i];
        const bool placed = camera->place[0] && strcmp(camera->place, camera->name) != 0;
        message_add(message, "%s%d%s%s%s%s", i ? ", " : "", i, camera->name[0] ? " " : "",
                    camera->name, placed ? " at " : "", placed ? camera->place : "");
    }
    return message_add(message, "%s", file->camera_count ? ", and fit" : "none, and fit");
}

static bool choose_camera(FileScene *made, const char *asked, Message *message)
{
    const SceneFile *file = &made->file;
    made->camera = file->camera_count > 0 ? 0 : -1;
    if (asked && strcmp(asked, "fit") == 0)
        made->camera = -1;
    else if (asked && !parse_whole(asked, 0, file->camera_count - 1, &made->camera)) {
        int i = 0;
        while (i < file->camera_count && strcmp(file->cameras[i].name, asked) != 0 &&
               strcmp(file->cameras[i].place, asked) != 0)
            i++;
        if (i == file->camera_count)
            return list_cameras(file, asked, message);
        made->camera = i;
    }
    return true;
}

/* From in front, the right and above, so far away that the sphere around everything is seen. */
static Camera fitting_camera(const FileScene *made)
{
    static const double FOVY = 40, MARGIN = 1.05;
    const double distance = made->radius / sin(FOVY * RADIANS / 2), r = MARGIN * made->radius;
    const Vec3 way = vec3_unit((Vec3){0.5, 0.35, 1});
    return (Camera){.eye = vec3_add(made->middle, vec3_scale(way, distance)),
                    .center = made->middle,
                    .up = {0, 1, 0},
                    .fovy = FOVY,
                    .near = distance - r,
                    .far = distance + r};
}

/* An orthographic view from far away, as high in the middle of everything: of things before and
 * behind that the size is wrong by a 300th. */
static void go_away(const FileScene *made, double half_height, Camera *camera)
{
    const Vec3 look = vec3_unit(vec3_subtract(camera->center, camera->eye));
    const double depth = vec3_dot(vec3_subtract(made->middle, camera->eye), look);
    const double away = 300 * fmax(half_height, made->radius), back = away - depth;
    camera->eye = vec3_subtract(camera->eye, vec3_scale(look, back));
    camera->center = vec3_add(camera->eye, vec3_scale(look, away));
    camera->fovy = 2 / RADIANS * atan(half_height / away);
    camera->near += back;
    camera->far = camera->far > 0 ? camera->far + back : 0;
}

static Camera file_camera(const FileScene *made)
{
    const FileCamera *from = &made->file.cameras[made->camera];
    Camera camera = from->camera;
    if (from->node >= 0) {
        const Mat4 world_from_node = made->poses[from->node];
        const Vec3 eye = camera.eye, look = vec3_subtract(camera.center, eye);
        camera.eye = mat4_transform_point(world_from_node, eye);
        camera.center =
            vec3_add(camera.eye, /* of any length, but not lost beside the eye */
                     vec3_scale(vec3_unit(mat4_transform_direction(world_from_node, look)),
                                fmax(made->radius, 1e-3 * vec3_length(camera.eye))));
        camera.up = vec3_unit(mat4_transform_direction(world_from_node, camera.up));
    }
    if (made->file.own)
        return camera;
    if (from->half_height > 0)
        go_away(made, from->half_height, &camera);
    /* As near and as far as the file has it, but no nearer or farther than anything is. */
    const double r = 1.05 * made->radius;
    const double depth = vec3_dot(vec3_subtract(made->middle, camera.eye),
                                  vec3_unit(vec3_subtract(camera.center, camera.eye)));
    const double last = fmax(depth + r, r);
    const bool moves = made->file.channel_count > 0;
    if (!(camera.far > 0))
        camera.far = fmax(moves ? 2 * last : last, 2 * camera.near);
    if (!moves && camera.near < last && last < camera.far)
        camera.far = last;
    camera.near = fmax(camera.near, 1e-5 * camera.far);
    if (!moves && depth - r > camera.near && depth - r < camera.far)
        camera.near = depth - r;
    return camera;
}

/* Lights */

/* Intensities grow with the square of the file's unit of length. A light that is as many times
 * weaker and loses as much less on its way is the same. */
static void scale_intensity(Light *light, double exposure)
{
    static const double MOST = 1e6; /* of a scene */
    const double color =
        exposure * fmax(fmax(light->diffuse.x, light->diffuse.y), light->diffuse.z);
    const double scale =
        color > MOST && light->constant + light->linear + light->quadratic > 0 ? 1 / color : 1;
    light->diffuse = vec3_scale(light->diffuse, scale * exposure);
    light->specular = vec3_scale(light->specular, scale * exposure);
    light->constant *= scale;
    light->linear *= scale;
    light->quadratic *= scale;
}

static Light light_at(const FileScene *made, const FileLight *from)
{
    Light light = from->light;
    if (from->node >= 0) {
        const Mat4 m = made->poses[from->node];
        light.position = mat4_transform_point(m, light.position);
        light.direction = vec3_unit(mat4_transform_direction(m, light.direction));
    }
    if (light.kind != LIGHT_POINT && vec3_length(light.direction) == 0)
        light.direction = (Vec3){0, -1, 0};
    scale_intensity(&light, made->exposure);
    return light;
}

static Light viewers_light(void)
{
    return (Light){.kind = LIGHT_DIRECTIONAL,
                   .space = LIGHT_EYE,
                   .direction = {0, 0, 1},
                   .diffuse = {0.9, 0.9, 0.9},
                   .specular = {0.9, 0.9, 0.9}};
}

/* What a white surface in an object's middle that faces a light reflects at most; a near light is
 * half the object's radius away. */
static double brightness(const Light *light, Sphere around)
{
    const double away = vec3_length(vec3_subtract(light->position, around.center));
    return fmax(fmax(light->diffuse.x, light->diffuse.y), light->diffuse.z) *
           light_attenuation(light, fmax(away, around.radius / 2));
}

static Sphere sphere_around(const FileScene *made, int number)
{
    const FileObject *from = &made->file.objects[number];
    const Object object = {.mesh = &made->file.meshes[from->mesh],
                           .world_from_object = made->poses[from->node]};
    const MeshBox box = mesh_bounds(object.mesh);
    return scene_sphere(&object, &box);
}

/* Of the objects, or some of very many, all but the brightest tenth are not brighter. */
static double usual_brightness(const FileScene *made)
{
    static const long long MOST = 10000000;
    const long long pairs = (long long)made->file.object_count * made->file.light_count;
    const size_t step = (size_t)(1 + pairs / MOST);
    const size_t count = ((size_t)made->file.object_count + step - 1) / step;
    double *all = memory_new(count, sizeof *all);
    for (size_t i = 0; i < count; i++) {
        const Sphere around = sphere_around(made, (int)(i * step));
        for (int k = 0; k < made->file.light_count; k++)
            all[i] += brightness(&made->lights[k], around);
    }
    qsort(all, count, sizeof *all, clock_compare);
    const double found = all[(count - 1) * 9 / 10];
    free(all);
    return found;
}

static void choose_exposure(FileScene *made, double asked)
{
    static const double DARK = 0.1, BRIGHT = 1.5;
    Scene scene;
    made->exposure = asked > 0 ? asked : 1;
    if (asked > 0 || !made->file.photometric)
        return;
    file_scene_make(made, 0, &scene);
    const double usual = usual_brightness(made);
    if (usual > 0 && (usual < DARK || usual > BRIGHT))
        made->exposure = 1 / usual;
}

/* The scene */

/* Meshes as they are drawn: with all normals; which are closed, and which are flat. */
static bool finish_meshes(FileScene *made, Message *message)
{
    SceneFile *file = &made->file;
    bool *closed = memory_new((size_t)file->mesh_count + 1, sizeof *closed);
    bool done = true;
    int kept = 0;
    for (int i = 0; i < file->mesh_count && done; i++)
        if (file->meshes[i].index_count > 0) {
            done = model_complete(&file->meshes[i], message);
            closed[i] = done && scene_file_is_closed(&file->meshes[i]);
        }
    for (int i = 0; i < file->object_count && done; i++) {
        FileObject *object = &file->objects[i];
        if (file->meshes[object->mesh].index_count == 0)
            continue;
        object->object.closed |= closed[object->mesh] && !file->own;
        file->objects[kept++] = *object;
    }
    free(closed);
    file->object_count = kept;
    return done && (kept > 0 || message_set(message, "holds no triangle with an area"));
}

static bool open_file(FileScene *made, const FileSceneOptions *options, Message *message)
{
    SceneFile *file = &made->file;
    Scene scene;
    if (!finish_meshes(made, message) || !choose_camera(made, options->camera, message))
        return false;
    made->poses = memory_new((size_t)file->node_count + 1, sizeof *made->poses);
    made->objects = memory_new((size_t)file->object_count, sizeof *made->objects);
    made->lights = memory_new((size_t)file->light_count + 1, sizeof *made->lights);
    made->exposure = 1;
    find_middle(made);
    choose_exposure(made, options->exposure);
    file_scene_make(made, 0, &scene);
    return scene_check(&scene, message);
}

bool file_scene_open(FileScene *made, const FileSceneOptions *options, Message *message)
{
    Message why = {0};
    *made = (FileScene){.camera = -1};
    if (!scene_file_read(options->path, (ModelUp)options->up, &made->file, message))
        return false;
    return open_file(made, options, &why) ||
           message_set(message, "%s: %s", options->path, why.text);
}

void file_scene_make(FileScene *made, double seconds, Scene *scene)
{
    const SceneFile *file = &made->file;
    scene_file_pose(file, seconds, made->poses);
    *scene = file->scene;
    for (int i = 0; i < file->object_count; i++) {
        made->objects[i] = file->objects[i].object;
        made->objects[i].name = file->objects[i].name;
        made->objects[i].mesh = &file->meshes[file->objects[i].mesh];
        made->objects[i].world_from_object = made->poses[file->objects[i].node];
    }
    for (int i = 0; i < file->light_count; i++) {
        made->lights[i] = light_at(made, &file->lights[i]);
        made->lights[i].shadows &= i < SCENE_MAX_CASTING;
    }
    if (file->light_count == 0 && !file->own)
        made->lights[0] = viewers_light();
    scene->lights = made->lights;
    scene->light_count = file->light_count || file->own ? file->light_count : 1;
    scene->objects = made->objects;
    scene->object_count = file->object_count;
    scene->camera = made->camera < 0 ? fitting_camera(made) : file_camera(made);
}

void file_scene_explain(const FileScene *made, FILE *file)
{
    for (int i = 0; i < made->file.note_count; i++)
        fprintf(file, "of the file, %d times: %s\n", made->file.notes[i].count,
                made->file.notes[i].text);
    if (made->exposure != 1)
        fprintf(file, "of the file: how bright its lights are; drawn %.4g times as bright\n",
                made->exposure);
    if (made->file.light_count == 0 && !made->file.own)
        fprintf(file, "the file has no light: there is one at the viewer\n");
    if (made->file.camera_count == 0)
        fprintf(file, "the file has no camera: one that sees all\n");
}

void file_scene_close(FileScene *made)
{
    scene_file_close(&made->file);
    free(made->poses);
    free(made->objects);
    free(made->lights);
    *made = (FileScene){.camera = -1};
}
