/* What a plan finds for all objects at once, found for one. */
#include "support/effects_of.h"

#include "scene/shadow_pairs.h"

/* Where memory runs out, all lights that have shadows cast them on it. */
static ObjectFacts find_facts(const Scene *scene, const Object *object, SceneFacts *scene_facts)
{
    const MeshBox box = mesh_bounds(object->mesh);
    const NormalCone normals = effects_normal_cone(object->mesh);
    const EffectsPlace place = effects_place(object, &box, &normals);
    ShadowPairs pairs = {.count = 0};
    EffectsView view = {.scene = NULL};
    EffectsLights chosen;
    effects_view(&view, scene);
    uint32_t shadowed = view.shadows;
    if (shadowed && shadow_pairs_open(&pairs, scene->object_count, NULL)) {
        for (int i = 0; i < scene->object_count; i++) {
            pairs.boxes[i] = mesh_bounds(scene->objects[i].mesh);
            pairs.placed[i] = placed_box(&pairs.boxes[i], scene->objects[i].world_from_object);
        }
        shadow_pairs_find(&pairs, scene);
        shadowed = pairs.receives[object - scene->objects];
    }
    shadow_pairs_close(&pairs);
    const EffectsLights *lights = effects_lights(&view, object, &place, &chosen, NULL);
    const ObjectFacts facts = effects_object(&view, lights, object, &place, shadowed);
    *scene_facts = effects_scene(&view, lights);
    effects_view_close(&view);
    return facts;
}

ObjectFacts effects_facts(const Scene *scene, const Object *object)
{
    SceneFacts facts;
    return find_facts(scene, object, &facts);
}

Effects effects_of(const Scene *scene, const Object *object)
{
    SceneFacts facts;
    const ObjectFacts own = find_facts(scene, object, &facts);
    return effects_decide(&facts, &own, NULL);
}

Effects effects_full(const Scene *scene, const Object *object)
{
    SceneFacts facts;
    const ObjectFacts own = find_facts(scene, object, &facts);
    return effects_decide_full(&facts, &own);
}

void effects_explain(const Scene *scene, const Object *object, FILE *file)
{
    SceneFacts facts;
    const ObjectFacts own = find_facts(scene, object, &facts);
    effects_decide(&facts, &own, file);
}
