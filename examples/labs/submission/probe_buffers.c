/* Meshes and a shadow map, opened and closed together. */
#include "labs/submission/probe_buffers.h"

bool probe_buffers_open(ProbeBuffers *buffers, const Probe *probe,
                        const SubmissionGeometry *geometry, Message *message)
{
    *buffers = (ProbeBuffers){.cull = geometry->cull};
    for (int i = 0; i < probe->scene.object_count; i++) {
        const Mesh *mesh = geometry->mesh ? geometry->mesh : &probe->meshes[i];
        if (!mesh_buffer_open(&buffers->buffers[i], mesh, message)) {
            probe_buffers_close(buffers);
            return false;
        }
    }
    if (probe_map_open(&buffers->map, probe, message))
        return true;
    probe_buffers_close(buffers);
    return false;
}

void probe_buffers_close(ProbeBuffers *buffers)
{
    if (!buffers)
        return;
    for (int i = 0; i < PROBE_MAX_OBJECTS; i++)
        mesh_buffer_close(&buffers->buffers[i]);
    probe_map_close(&buffers->map);
}
