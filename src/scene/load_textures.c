/* load_textures.c - the textures of a scene file. */
#include <stddef.h>

#include "base/memory.h"
#include "image/read.h"
#include "scene/load_parts.h"

/* uv' = uv * scale + delta */
static void load_generator(struct json_reader *j, const cJSON *node,
                           struct texture *out)
{
    static const char *const keys[] = {"type", "scale", "delta", NULL};
    static const char *const kinds[] = {"uvmapping2d", NULL};
    out->scale = vec2_make(1.0f, 1.0f);
    out->delta = vec2_make(0.0f, 0.0f);
    if (node == NULL || !json_keys(j, node, keys))
        return;
    json_name(j, json_get(node, "type"), kinds);
    out->scale = json_vec2(j, json_get(node, "scale"), out->scale);
    out->delta = json_vec2(j, json_get(node, "delta"), out->delta);
}

static void load_constant(struct json_reader *j, const cJSON *node,
                          struct texture *out)
{
    static const char *const keys[] = {"type", "color", NULL};
    json_keys(j, node, keys);
    out->color[0] = json_rgb(j, json_require(j, node, "color"), rgb_grey(0.0f));
}

static void load_checkerboard(struct json_reader *j, const cJSON *node,
                              struct texture *out)
{
    static const char *const keys[] = {"type", "color0", "color1",
                                       "tex_coordinate_generator", NULL};
    json_keys(j, node, keys);
    out->color[0] = json_rgb(j, json_get(node, "color0"), rgb_grey(0.4f));
    out->color[1] = json_rgb(j, json_get(node, "color1"), rgb_grey(0.2f));
    load_generator(j, json_get(node, "tex_coordinate_generator"), out);
}

static void read_image(struct json_reader *j, const cJSON *node,
                       enum image_encoding encoding, enum texture_wrap wrap,
                       struct texture *out)
{
    struct image image;
    struct error fault = {""};
    const cJSON *path = json_require(j, node, "path");
    const char *name = json_string(j, path, "");
    if (!json_fine(j))
        return;
    char *full = resolve_path(j, name);
    bool pyramid = out->image.filter == FILTER_TRILINEAR ||
                   out->image.filter == FILTER_EWA;
    if (image_read(full, encoding, &image, &fault))
        out->image.mipmap = mipmap_make(image, wrap, pyramid);
    else
        json_fault(j, path, "%s", fault.text);
    mem_free(full);
}

static void load_image(struct json_reader *j, const cJSON *node,
                       struct texture *out)
{
    static const char *const keys[] = {
        "type",     "path", "tex_coordinate_generator",
        "filter",   "wrap", "max_anisotropy",
        "encoding", NULL};
    static const struct json_range anisotropy = {1.0, 64.0,
                                                 "a number from 1 to 64"};
    const cJSON *filter = json_get(node, "filter");
    json_keys(j, node, keys);
    load_generator(j, json_get(node, "tex_coordinate_generator"), out);
    out->image.filter =
        filter ? (enum texture_filter)json_name(j, filter, texture_filter_names)
               : FILTER_TRILINEAR;
    out->image.max_anisotropy =
        json_float(j, json_get(node, "max_anisotropy"), anisotropy, 8.0f);
    int wrap = json_name(j, json_get(node, "wrap"), texture_wrap_names);
    int encoding =
        json_name(j, json_get(node, "encoding"), image_encoding_names);
    read_image(j, node, (enum image_encoding)encoding, (enum texture_wrap)wrap,
               out);
}

static void load_texture(struct json_reader *j, const cJSON *node,
                         struct texture *out)
{
    static const char *const kinds[] = {"constant", "checkerboard", "image",
                                        NULL};
    int kind = read_type(j, node, kinds);
    if (kind < 0)
        return;
    out->kind = (enum texture_kind)kind;
    if (out->kind == TEXTURE_CONSTANT)
        load_constant(j, node, out);
    else if (out->kind == TEXTURE_CHECKERBOARD)
        load_checkerboard(j, node, out);
    else
        load_image(j, node, out);
}

void load_textures(struct json_reader *j, const cJSON *node,
                   struct scene *scene)
{
    if (node == NULL || !json_is_table(j, node))
        return;
    size_t count = (size_t)cJSON_GetArraySize(node);
    scene->textures = mem_alloc(count, sizeof *scene->textures);
    for (const cJSON *m = node->child; m && json_fine(j); m = m->next)
        load_texture(j, m, &scene->textures[scene->texture_count++]);
}
