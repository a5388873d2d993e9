/*
 * lab_scene_buffers: the meshes and the shadow map of a scene, uploaded once for many draw calls.
 */
#ifndef LAB_SCENE_BUFFERS_H
#define LAB_SCENE_BUFFERS_H

#include "labs/submission/submission.h"

typedef struct LabSceneBuffers {
    MeshBuffer buffers[LAB_SCENE_MAX_OBJECTS];
    bool cull; /* back faces */
    LabShadowMap map;
} LabSceneBuffers;
bool lab_scene_buffers_open(LabSceneBuffers *buffers, const LabScene *lab_scene,
                            const SubmissionGeometry *geometry, Message *message);
void lab_scene_buffers_close(LabSceneBuffers *buffers);

#endif
