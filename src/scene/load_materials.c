/* load_materials.c - the materials of a scene file. */
#include <float.h>
#include <stddef.h>

#include "base/memory.h"
#include "scene/load_parts.h"

/* What a material reads from: the reader, the table of textures that it may
 * name, and the scene that holds them. */
struct source {
    struct json_reader *j;
    const cJSON *textures;
    const struct scene *scene;
};

/* A surface that reflects more than it gets would add light at every bounce. */
static void check_albedo(struct json_reader *j, const cJSON *node,
                         const struct texture *t)
{
    bool too_bright = false;
    for (int i = 0; i < 2; i++)
        too_bright = too_bright || t->color[i].r > 1.0f ||
                     t->color[i].g > 1.0f || t->color[i].b > 1.0f;
    if (too_bright && t->kind != TEXTURE_IMAGE)
        json_fault(j, node,
                   "the texture's colour is the share of light that is "
                   "reflected, expected at most 1");
}

/* The texture that node names; NULL after a fault. */
static const struct texture *load_albedo(const struct source *from,
                                         const cJSON *node)
{
    if (node == NULL)
        return NULL;
    int index = find_named(from->j, from->textures, node, "texture");
    if (index < 0)
        return NULL;
    const struct texture *t = &from->scene->textures[index];
    check_albedo(from->j, node, t);
    return t;
}

static void load_diffuse(const struct source *from, const cJSON *node,
                         struct material *out)
{
    static const char *const keys[] = {"type", "texture_name", "twosided",
                                       NULL};
    json_keys(from->j, node, keys);
    out->albedo =
        load_albedo(from, json_require(from->j, node, "texture_name"));
    out->two_sided = json_bool(from->j, json_get(node, "twosided"), false);
}

static float load_eta(struct json_reader *j, const cJSON *node)
{
    static const struct json_range eta = {0.1, 10.0,
                                          "an index of refraction from 0.1 to "
                                          "10"};
    return json_float(j, json_get(node, "eta"), eta, 1.5f);
}

static void load_refraction(const struct source *from, const cJSON *node,
                            struct material *out)
{
    static const char *const keys[] = {"type", "eta", NULL};
    json_keys(from->j, node, keys);
    out->eta = load_eta(from->j, node);
}

static void load_glass(const struct source *from, const cJSON *node,
                       struct material *out)
{
    static const char *const keys[] = {"type", "R", "T", "eta", NULL};
    json_keys(from->j, node, keys);
    out->eta = load_eta(from->j, node);
    out->reflectance = json_rgb(from->j, json_get(node, "R"), rgb_grey(1.0f));
    out->transmittance = json_rgb(from->j, json_get(node, "T"), rgb_grey(1.0f));
}

/* A number for all channels, or three. */
static rgb number_or_rgb(struct json_reader *j, const cJSON *node,
                         rgb otherwise)
{
    if (cJSON_IsNumber(node))
        return rgb_grey(json_float(j, node, zero_or_more, 0.0f));
    return json_rgb(j, node, otherwise);
}

/* The metal's index relative to what is outside; the defaults are copper's
 * (about 645, 530 and 465 nm) in air. */
static void load_index(struct json_reader *j, const cJSON *node,
                       struct material *out)
{
    rgb inside = number_or_rgb(j, json_get(node, "etaT"),
                               rgb_make(0.200f, 0.924f, 1.102f));
    rgb k =
        number_or_rgb(j, json_get(node, "k"), rgb_make(3.912f, 2.452f, 2.142f));
    rgb outside = number_or_rgb(j, json_get(node, "etaI"), rgb_grey(1.0f));
    if (!(outside.r > 0.0f && outside.g > 0.0f && outside.b > 0.0f)) {
        json_fault(j, node, "etaI is 0, expected numbers above 0");
        return;
    }
    out->conductor_eta = rgb_make(inside.r / outside.r, inside.g / outside.g,
                                  inside.b / outside.b);
    out->conductor_k =
        rgb_make(k.r / outside.r, k.g / outside.g, k.b / outside.b);
}

static void load_rough_conductor(const struct source *from, const cJSON *node,
                                 struct material *out)
{
    static const char *const keys[] = {"type",         "alpha_x", "alpha_y",
                                       "etaI",         "etaT",    "k",
                                       "texture_name", NULL};
    static const struct json_range alpha = {0.001, 1.0,
                                            "a roughness from 0.001 to 1"};
    json_keys(from->j, node, keys);
    out->alpha_x = json_float(from->j, json_get(node, "alpha_x"), alpha, 0.1f);
    out->alpha_y = json_float(from->j, json_get(node, "alpha_y"), alpha, 0.1f);
    out->albedo = load_albedo(from, json_get(node, "texture_name"));
    load_index(from->j, node, out);
}

static void load_material(const struct source *from, const cJSON *node,
                          struct material *out)
{
    static const char *const kinds[] = {"diffuse", "refraction", "glass",
                                        "roughconductor", NULL};
    typedef void load_fn(const struct source *, const cJSON *,
                         struct material *);
    static load_fn *const load[] = {load_diffuse, load_refraction, load_glass,
                                    load_rough_conductor};
    int kind = read_type(from->j, node, kinds);
    if (kind < 0)
        return;
    out->kind = (enum material_kind)kind;
    load[kind](from, node, out);
}

void load_materials(struct json_reader *j, const cJSON *textures,
                    const cJSON *node, struct scene *scene)
{
    const struct source from = {j, textures, scene};
    if (!json_fine(j) || node == NULL || !json_is_table(j, node))
        return;
    size_t count = (size_t)cJSON_GetArraySize(node), i = 0;
    scene->materials = mem_alloc(count, sizeof *scene->materials);
    for (const cJSON *m = node->child; m && json_fine(j); m = m->next)
        load_material(&from, m, &scene->materials[i++]);
}
