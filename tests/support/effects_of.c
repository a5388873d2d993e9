/* What a plan finds for all objects at once, found for one. */
#include "support/effects_of.h"

#include "scene/shadow_pairs.h"

/* Where memory runs out, all lights that have shadows cast them on it. */
ObjectFacts effects_facts(const Scene *scene, const Object *object)
{
    const MeshBox box = mesh_bounds(object->mesh);
    const NormalCone normals = effects_normal_cone(object->mesh);
    const EffectsPlace place = effects_place(object, &box, &normals);
    const SceneFacts facts = effects_scene(scene);
    ShadowPairs pairs = {.count = 0};
    EffectsView view;
    uint32_t shadowed = effects_shadows(&facts);
    if (shadowed && shadow_pairs_open(&pairs, scene->object_count, NULL)) {
        for (int i = 0; i < scene->object_count; i++) {
            pairs.boxes[i] = mesh_bounds(scene->objects[i].mesh);
            pairs.placed[i] = placed_box(&pairs.boxes[i], scene->objects[i].world_from_object);
        }
        shadow_pairs_find(&pairs, scene);
        shadowed = pairs.receives[object - scene->objects];
    }
    shadow_pairs_close(&pairs);
    effects_view(&view, scene);
    return effects_object(&view, object, &place, shadowed);
}

Effects effects_of(const Scene *scene, const Object *object)
{
    const SceneFacts facts = effects_scene(scene);
    const ObjectFacts own = effects_facts(scene, object);
    return effects_decide(&facts, &own, NULL);
}

Effects effects_full(const Scene *scene, const Object *object)
{
    const SceneFacts facts = effects_scene(scene);
    const ObjectFacts own = effects_facts(scene, object);
    return effects_decide_full(&facts, &own);
}

void effects_explain(const Scene *scene, const Object *object, FILE *file)
{
    const SceneFacts facts = effects_scene(scene);
    const ObjectFacts own = effects_facts(scene, object);
    effects_decide(&facts, &own, file);
}
