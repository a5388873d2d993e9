/*
 * probe_buffers: the meshes and the shadow map of a scene, uploaded once for many draw calls.
 */
#ifndef PROBE_BUFFERS_H
#define PROBE_BUFFERS_H

#include "labs/submission/submission.h"

typedef struct ProbeBuffers {
    MeshBuffer buffers[PROBE_MAX_OBJECTS];
    bool cull; /* back faces */
    ProbeMap map;
} ProbeBuffers;
bool probe_buffers_open(ProbeBuffers *buffers, const Probe *probe,
                        const SubmissionGeometry *geometry, Message *message);
void probe_buffers_close(ProbeBuffers *buffers);

#endif
