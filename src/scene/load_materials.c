/* load_materials.c - textures and materials of a scene file. */
#include "base/memory.h"
#include "scene/load_parts.h"

/* Is node an object of named things (or absent)? */
static bool is_table(struct json_reader *j, const cJSON *node)
{
    if (node == NULL)
        return false;
    if (!cJSON_IsObject(node))
        return json_unexpected(j, node, "an object of named entries");
    for (const cJSON *m = node->child; m != NULL; m = m->next)
        if (json_get(node, m->string) != m)
            return json_fault(j, m, "the name \"%s\" is there twice",
                              m->string);
    return true;
}

static int entry_kind(struct json_reader *j, const cJSON *node,
                      const char *const kinds[])
{
    if (!cJSON_IsObject(node)) {
        json_unexpected(j, node, "an object { ... }");
        return 0;
    }
    const cJSON *type = json_require(j, node, "type");
    int kind = json_name(j, type, kinds);
    if (kind > 0)
        not_supported(j, type, kinds[kind]);
    return kind;
}

static void load_texture(struct json_reader *j, const cJSON *node,
                         struct texture *out)
{
    static const char *const keys[] = {"type", "color", NULL};
    static const char *const kinds[] = {"constant", "checkerboard", "image",
                                        NULL};
    out->kind = TEXTURE_CONSTANT;
    if (entry_kind(j, node, kinds) != 0 || !json_keys(j, node, keys))
        return;
    out->color = json_rgb(j, json_require(j, node, "color"), rgb_grey(0.0f));
}

void load_textures(struct json_reader *j, const cJSON *node,
                   struct scene *scene)
{
    if (!is_table(j, node))
        return;
    size_t count = (size_t)cJSON_GetArraySize(node), i = 0;
    scene->textures = mem_alloc(count, sizeof *scene->textures);
    for (const cJSON *m = node->child; m && json_fine(j); m = m->next)
        load_texture(j, m, &scene->textures[i++]);
}

/* A diffuse surface that reflects more than it gets would add light at every
 * bounce. */
static void check_albedo(struct json_reader *j, const cJSON *node, rgb albedo)
{
    if (albedo.r > 1.0f || albedo.g > 1.0f || albedo.b > 1.0f)
        json_fault(j, node,
                   "the texture's colour is the share of light that is "
                   "reflected, expected at most 1");
}

static void load_material(struct json_reader *j, const cJSON *textures,
                          const cJSON *node, const struct scene *scene,
                          struct material *out)
{
    static const char *const keys[] = {"type", "texture_name", "twosided",
                                       NULL};
    static const char *const kinds[] = {"diffuse", "refraction", "glass",
                                        "roughconductor", NULL};
    out->kind = MATERIAL_DIFFUSE;
    if (entry_kind(j, node, kinds) != 0 || !json_keys(j, node, keys))
        return;
    const cJSON *name = json_require(j, node, "texture_name");
    if (name == NULL)
        return;
    int texture = find_named(j, textures, name, "texture");
    if (texture < 0)
        return;
    out->albedo = &scene->textures[texture];
    check_albedo(j, name, out->albedo->color);
    out->two_sided = json_bool(j, json_get(node, "twosided"), false);
}

void load_materials(struct json_reader *j, const cJSON *textures,
                    const cJSON *node, struct scene *scene)
{
    if (!json_fine(j) || !is_table(j, node))
        return;
    size_t count = (size_t)cJSON_GetArraySize(node), i = 0;
    scene->materials = mem_alloc(count, sizeof *scene->materials);
    for (const cJSON *m = node->child; m && json_fine(j); m = m->next)
        load_material(j, textures, m, scene, &scene->materials[i++]);
}
