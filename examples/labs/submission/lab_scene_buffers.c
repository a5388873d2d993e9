/* Meshes and a shadow map, opened and closed together. */
#include "labs/submission/lab_scene_buffers.h"

bool lab_scene_buffers_open(LabSceneBuffers *buffers, const LabScene *lab_scene,
                            const SubmissionGeometry *geometry, Message *message)
{
    *buffers = (LabSceneBuffers){.cull = geometry->cull};
    for (int i = 0; i < lab_scene->scene.object_count; i++) {
        const Mesh *mesh = geometry->mesh ? geometry->mesh : &lab_scene->meshes[i];
        if (!mesh_buffer_open(&buffers->buffers[i], mesh, message)) {
            lab_scene_buffers_close(buffers);
            return false;
        }
    }
    if (lab_shadow_map_open(&buffers->map, lab_scene, message))
        return true;
    lab_scene_buffers_close(buffers);
    return false;
}

void lab_scene_buffers_close(LabSceneBuffers *buffers)
{
    if (!buffers)
        return;
    for (int i = 0; i < LAB_SCENE_MAX_OBJECTS; i++)
        mesh_buffer_close(&buffers->buffers[i]);
    lab_shadow_map_close(&buffers->map);
}
