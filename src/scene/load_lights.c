/* load_lights.c - the list of lights of a scene file. */
#include "base/memory.h"
#include "scene/load_parts.h"

void add_point_light(struct scene *scene, vec3 position, rgb flux)
{
    uint32_t count = scene->light_count + 1;
    scene->lights = mem_resize(scene->lights, count, sizeof *scene->lights);
    scene->lights[scene->light_count].position = position;
    scene->lights[scene->light_count].flux = flux;
    scene->light_count = count;
}

static void load_light(struct json_reader *j, const cJSON *node,
                       struct scene *scene)
{
    static const char *const keys[] = {"type", "position", "flux", NULL};
    static const char *const kinds[] = {"point", "directional", "spot", NULL};
    if (!cJSON_IsObject(node)) {
        json_unexpected(j, node, "an object { ... }");
        return;
    }
    int kind = json_name(j, json_require(j, node, "type"), kinds);
    if (kind != 0) {
        not_supported(j, node, kinds[kind]);
        return;
    }
    json_keys(j, node, keys);
    vec3 zero = vec3_make(0.0f, 0.0f, 0.0f);
    vec3 position = json_vec3(j, json_require(j, node, "position"), zero);
    rgb flux = json_rgb(j, json_require(j, node, "flux"), rgb_grey(0.0f));
    add_point_light(scene, position, flux);
}

void load_lights(struct json_reader *j, const cJSON *node, struct scene *scene)
{
    if (node == NULL || !json_is_list(j, node))
        return;
    for (const cJSON *item = node->child; item && json_fine(j);
         item = item->next)
        load_light(j, item, scene);
}
