/*
 * A map is a depth buffer seen from the light: a point is in shadow if it lies farther away than
 * what the map has there. The map is drawn again only if what it shows has changed: transforms,
 * buffers and frusta are kept as bytes and compared. Looked up it is either by the program that
 * lights an object, or, where a light has several maps or a program has no room, by a program of
 * its own, which marks the light's channel in a mask.
 */
#include "shadows/shadow_map.h"

#include "core/canvas.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FLOAT_BITS = 24 }; /* with which the shader compares, whatever the texture has */

/* Programs. Depths need more bits than mediump has, whatever --precision says. */

int shadow_map_defines(int look, const char *defines[LOOK_DEFINES])
{
    static const struct {
        int look;
        const char *define;
    } all[LOOK_DEFINES] = {{LOOK_SMOOTH, "SMOOTH"},
                           {LOOK_ALONG_NORMAL, "ALONG_NORMAL"},
                           {LOOK_PERSPECTIVE, "PERSPECTIVE"},
                           {LOOK_PACKED, "PACKED"}};
    int count = 0;
    for (int i = 0; i < LOOK_DEFINES; i++)
        if (look & all[i].look)
            defines[count++] = all[i].define;
    return count;
}

static bool open_program(Shader *shader, const ShadowMaps *maps, const char *purpose, int look,
                         Message *message)
{
    const char *defines[LOOK_DEFINES + 2] = {purpose};
    shadow_map_defines(look, &defines[1]);
    ShaderLoader loader = maps->loader;
    loader.precision = NULL;
    loader.defines = defines;
    return shader_open(shader, &loader, "shadow", message);
}

/* Images */

static GLuint make_texture(int size, bool packed)
{
    return packed ? canvas_texture(GL_RGBA, GL_UNSIGNED_BYTE, size, size)
                  : canvas_texture(GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, size, size);
}

static void attach(const ShadowMaps *maps, GLuint texture)
{
    glFramebufferTexture2D(GL_FRAMEBUFFER,
                           maps->packed ? GL_COLOR_ATTACHMENT0 : GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D,
                           texture, 0);
}

/* Whether the driver draws to a depth texture alone, and of how many bits. */
static bool has_depth_texture(ShadowMaps *maps)
{
    enum { PROBE = 16 };
    if (gl_version() < 30 && !gl_has("GL_OES_depth_texture"))
        return false;
    GLint target, bits = 0;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &target);
    GLuint texture = make_texture(PROBE, false);
    glBindFramebuffer(GL_FRAMEBUFFER, maps->framebuffer);
    attach(maps, texture);
    const bool done = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE &&
                      glGetError() == GL_NO_ERROR;
    if (done)
        glGetIntegerv(GL_DEPTH_BITS, &bits);
    attach(maps, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)target);
    glDeleteTextures(1, &texture);
    while (glGetError() != GL_NO_ERROR)
        ;
    maps->bits = bits < FLOAT_BITS ? bits : FLOAT_BITS;
    return done && bits >= 16;
}

bool shadow_maps_open(ShadowMaps *maps, const ShaderLoader *loader, Message *message)
{
    *maps = (ShadowMaps){.loader = *loader};
    glGenFramebuffers(1, &maps->framebuffer);
    maps->packed = !has_depth_texture(maps);
    if (maps->packed)
        maps->bits = FLOAT_BITS; /* 255^3 values, nearly */
    if (!open_program(&maps->draw, maps, "DRAW_MAP", maps->packed ? LOOK_PACKED : 0, message)) {
        shadow_maps_close(maps);
        return false;
    }
    maps->draw_position = glGetAttribLocation(maps->draw.program, "a_Position");
    maps->draw_clip_from_object = glGetUniformLocation(maps->draw.program, "u_ClipFromObject");
    return true;
}

static void drop_map(ShadowMap *map)
{
    for (int i = 0; i < SHADOW_FACES; i++)
        if (map->textures[i])
            glDeleteTextures(1, &map->textures[i]);
    free(map->drawn.bytes);
    *map = (ShadowMap){.size = 0};
}

void shadow_maps_forget(ShadowMaps *maps)
{
    for (int i = 0; i < SHADOW_MAPS; i++)
        maps->lights[i].drawn.size = 0;
}

void shadow_maps_close(ShadowMaps *maps)
{
    if (!maps)
        return;
    for (int i = 0; i < SHADOW_MAPS; i++)
        drop_map(&maps->lights[i]);
    if (maps->framebuffer)
        glDeleteFramebuffers(1, &maps->framebuffer);
    if (maps->depth)
        glDeleteRenderbuffers(1, &maps->depth);
    shader_close(&maps->draw);
    for (int i = 0; i < LOOKS; i++)
        shader_close(&maps->looks[i].shader.shader);
    free(maps->key.bytes);
    *maps = (ShadowMaps){.bits = 0};
}

/* Drawing a map */

/* False: no memory. */
static bool make_key(struct ShadowMapKey *key, const ShadowMapScene *scene)
{
    const size_t matrices = 2 * (size_t)scene->face_count, each = sizeof(Mat4);
    key->size = matrices * each + (size_t)scene->caster_count * (each + sizeof(GLuint));
    if (key->size > key->capacity) {
        void *larger = realloc(key->bytes, key->size);
        if (!larger)
            return false;
        key->bytes = larger;
        key->capacity = key->size;
    }
    char *to = key->bytes;
    for (size_t i = 0; i < matrices; i++, to += each) {
        const ShadowFrustum *frustum = &scene->frusta[i / 2];
        memcpy(to, i % 2 ? &frustum->map_from_light : &frustum->light_from_world, each);
    }
    for (int i = 0; i < scene->caster_count; i++, to += each + sizeof(GLuint)) {
        memcpy(to, &scene->casters[i].world_from_object, each);
        memcpy(to + each, &scene->casters[i].buffer->vertices, sizeof(GLuint));
    }
    return true;
}

static bool draw_face(ShadowMaps *maps, ShadowMap *map, int face, const ShadowMapCaster *casters,
                      int count)
{
    const ShadowFrustum *frustum = &map->frusta[face];
    if (!map->textures[face])
        map->textures[face] = make_texture(map->size, maps->packed);
    attach(maps, map->textures[face]);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return false;
    glClearColor(1, 1, 1, 1);
    glClear(maps->packed ? GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT : GL_DEPTH_BUFFER_BIT);
    for (int i = 0; i < count; i++) {
        shader_set_mat4(
            maps->draw_clip_from_object,
            mat4_product(frustum->map_from_light,
                         mat4_product(frustum->light_from_world, casters[i].world_from_object)));
        mesh_buffer_bind(casters[i].buffer, maps->draw_position, -1);
        glDrawElements(GL_TRIANGLES, casters[i].buffer->index_count, casters[i].buffer->index_type,
                       NULL);
    }
    maps->drawn++;
    return true;
}

static void make_depth(ShadowMaps *maps, int size)
{
    if (!maps->packed || maps->depth_size == size)
        return;
    if (!maps->depth)
        glGenRenderbuffers(1, &maps->depth);
    glBindRenderbuffer(GL_RENDERBUFFER, maps->depth);
    glRenderbufferStorage(GL_RENDERBUFFER,
                          gl_version() >= 30 || gl_has("GL_OES_depth24") ? GL_DEPTH_COMPONENT24_OES
                                                                         : GL_DEPTH_COMPONENT16,
                          size, size);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, maps->depth);
    maps->depth_size = size;
}

static bool draw_faces(ShadowMaps *maps, ShadowMap *map, const ShadowMapCaster *casters, int count)
{
    GLint target, place[4];
    bool done = true;
    const bool cut = glIsEnabled(GL_SCISSOR_TEST);
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &target);
    glGetIntegerv(GL_VIEWPORT, place);
    glBindFramebuffer(GL_FRAMEBUFFER, maps->framebuffer);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    glViewport(0, 0, map->size, map->size);
    glUseProgram(maps->draw.program);
    make_depth(maps, map->size);
    for (int face = 0; face < map->count && done; face++)
        done = draw_face(maps, map, face, casters, count);
    attach(maps, 0);
    if (cut)
        glEnable(GL_SCISSOR_TEST);
    glViewport(place[0], place[1], place[2], place[3]);
    glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)target);
    return done && glGetError() == GL_NO_ERROR;
}

bool shadow_map_draw(ShadowMaps *maps, int light, const ShadowMapScene *scene, Message *message)
{
    ShadowMap *map = &maps->lights[light];
    const int size = scene->size;
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (size > most)
        return message_set(message, "shadows: a map of %dx%d: this driver has textures up to %dx%d",
                           size, size, (int)most, (int)most);
    if (!make_key(&maps->key, scene))
        return message_set(message, "shadows: not enough memory");
    if (map->size == size && map->drawn.size == maps->key.size &&
        memcmp(map->drawn.bytes, maps->key.bytes, maps->key.size) == 0)
        return true;
    if (map->size != size)
        drop_map(map);
    const struct ShadowMapKey before = map->drawn;
    map->drawn = maps->key;
    maps->key = before;
    map->size = size;
    map->count = scene->face_count;
    memcpy(map->frusta, scene->frusta, (size_t)scene->face_count * sizeof *scene->frusta);
    if (draw_faces(maps, map, scene->casters, scene->caster_count))
        return true;
    drop_map(map);
    return message_set(message,
                       "shadows: the driver cannot draw to a map of %dx%d; use a smaller one", size,
                       size);
}

/* Looking it up */

int shadow_map_look(const ShadowMaps *maps, const ShadowFrustum *frustum,
                    const ShadowLookup *lookup)
{
    return (lookup->smooth ? LOOK_SMOOTH : 0) | (lookup->normal != 0 ? LOOK_ALONG_NORMAL : 0) |
           (frustum->perspective ? LOOK_PERSPECTIVE : 0) | (maps->packed ? LOOK_PACKED : 0);
}

static GLint location_of(GLuint program, const char *name, const char *suffix)
{
    char full_name[32];
    snprintf(full_name, sizeof full_name, "%s%s", name, suffix);
    return glGetUniformLocation(program, full_name);
}

ShadowMapLocations shadow_map_locations(GLuint program, const char *suffix)
{
    return (ShadowMapLocations){
        .map = location_of(program, "u_Map", suffix),
        .light_from_object = location_of(program, "u_LightFromObject", suffix),
        .light_normal = location_of(program, "u_LightNormal", suffix),
        .scale = location_of(program, "u_MapScale", suffix),
        .move = location_of(program, "u_MapMove", suffix),
        .size = location_of(program, "u_MapSize", suffix),
        .bias = location_of(program, "u_MapBias", suffix),
    };
}

/* From the light's coordinates to the map's: what of the projection is not zero, 0 to 1. */
void shadow_map_set(const ShadowMap *map, int face, const ShadowLookup *lookup,
                    const ShadowMapLocations *locations)
{
    const ShadowFrustum *frustum = &map->frusta[face];
    const double *m = frustum->map_from_light.m;
    const bool perspective = frustum->perspective;
    shader_set_vec3(locations->scale, (Vec3){m[0] / 2, m[5] / 2, m[perspective ? 14 : 10] / 2});
    shader_set_vec3(locations->move,
                    perspective ? (Vec3){(1 - m[8]) / 2, (1 - m[9]) / 2, (1 - m[10]) / 2}
                                : (Vec3){(1 + m[12]) / 2, (1 + m[13]) / 2, (1 + m[14]) / 2});
    shader_set_vec3(locations->size,
                    (Vec3){map->size, 1.0 / map->size, frustum->width / map->size});
    shader_set_vec3(locations->bias, (Vec3){lookup->constant, lookup->slope, lookup->normal});
}

void shadow_map_place(const ShadowMap *map, int face, Mat4 world_from_object,
                      const ShadowMapLocations *locations)
{
    const Mat4 light_from_object =
        mat4_product(map->frusta[face].light_from_world, world_from_object);
    shader_set_mat4(locations->light_from_object, light_from_object);
    shader_set_mat4(locations->light_normal, mat4_normal(light_from_object));
}

static bool open_look(ShadowLook *look, const ShadowMaps *maps, int number, Message *message)
{
    Shader shader;
    if (look->shader.shader.program)
        return true;
    if (!open_program(&shader, maps, "LOOK_UP", number, message))
        return false;
    look->shader = mask_shader(&shader);
    look->map = shadow_map_locations(shader.program, "");
    return true;
}

bool shadow_map_mark(ShadowMaps *maps, ShadowMask *mask, const ShadowMark *mark, Message *message)
{
    const ShadowMap *map = &maps->lights[mark->light];
    bool done = true;
    for (int face = 0; face < map->count && done; face++) {
        const int number = shadow_map_look(maps, &map->frusta[face], &mark->lookup);
        ShadowLook *look = &maps->looks[number];
        done = open_look(look, maps, number, message);
        if (!done)
            break;
        shadow_mask_write(mask, mark->channel, &look->shader);
        shadow_map_set(map, face, &mark->lookup, &look->map);
        shadow_map_place(map, face, mark->world_from_object, &look->map);
        glUniform1i(look->map.map, 0);
        glBindTexture(GL_TEXTURE_2D, map->textures[face]);
        shadow_mask_draw(mask, mark->surface);
    }
    glBindTexture(GL_TEXTURE_2D, 0);
    shadow_mask_write(mask, -1, NULL);
    return done;
}
