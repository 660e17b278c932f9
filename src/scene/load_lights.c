/* load_lights.c - all that shines in a scene file. */
#include "base/constants.h"
#include "base/memory.h"
#include "lights/environment_map.h"
#include "scene/load_parts.h"

struct light *add_light(struct scene *scene, enum light_kind kind)
{
    static const struct light none;
    uint32_t count = scene->light_count + 1;
    scene->lights = mem_resize(scene->lights, count, sizeof *scene->lights);
    struct light *light = &scene->lights[scene->light_count++];
    *light = none;
    light->kind = kind;
    return light;
}

/* A unit vector; the zero vector has no direction. */
static vec3 read_direction(struct json_reader *j, const cJSON *node)
{
    vec3 down = vec3_make(0.0f, -1.0f, 0.0f);
    vec3 d = json_vec3(j, node, down);
    float length = vec3_length(d);
    if (length > 0.0f && isfinite(length))
        return vec3_scale(d, 1.0f / length);
    if (json_fine(j))
        json_fault(j, node, "the zero vector has no direction");
    return down;
}

static void load_point(struct json_reader *j, const cJSON *node,
                       struct light *out)
{
    static const char *const keys[] = {"type", "position", "flux", NULL};
    json_keys(j, node, keys);
    out->position = json_vec3(j, json_require(j, node, "position"),
                              vec3_make(0.0f, 0.0f, 0.0f));
    out->flux = json_rgb(j, json_require(j, node, "flux"), rgb_grey(0.0f));
}

static void load_directional(struct json_reader *j, const cJSON *node,
                             struct light *out)
{
    static const char *const keys[] = {"type", "direction", "irradiance", NULL};
    json_keys(j, node, keys);
    out->direction = read_direction(j, json_require(j, node, "direction"));
    out->irradiance =
        json_rgb(j, json_require(j, node, "irradiance"), rgb_grey(0.0f));
}

/* Angles are from the axis to the edge, in degrees. */
static void load_cone(struct json_reader *j, const cJSON *node,
                      struct light *out)
{
    static const struct json_range cutoff_range = {
        0.01, 89.99, "an angle in degrees from 0.01 to 89.99"};
    static const struct json_range beam_range = {
        0.0, 89.99, "an angle in degrees from 0 to 89.99"};
    const cJSON *beam_node = json_get(node, "beam_angle");
    const cJSON *cutoff_node = json_get(node, "cutoff_angle");
    float cutoff = json_float(j, cutoff_node, cutoff_range, 20.0f);
    float beam = json_float(j, beam_node, beam_range, 0.75f * cutoff);
    if (beam > cutoff)
        json_fault(j, node,
                   "beam_angle is %g, expected at most cutoff_angle, %g",
                   (double)beam, (double)cutoff);
    out->cutoff_angle = cutoff * (PI / 180.0f);
    out->beam_angle = beam * (PI / 180.0f);
}

static void load_spot(struct json_reader *j, const cJSON *node,
                      struct light *out)
{
    static const char *const keys[] = {
        "type",         "position",   "direction", "intensity",
        "cutoff_angle", "beam_angle", NULL};
    json_keys(j, node, keys);
    out->position = json_vec3(j, json_require(j, node, "position"),
                              vec3_make(0.0f, 0.0f, 0.0f));
    out->direction = read_direction(j, json_require(j, node, "direction"));
    out->intensity =
        json_rgb(j, json_require(j, node, "intensity"), rgb_grey(0.0f));
    load_cone(j, node, out);
}

static void load_light(struct json_reader *j, const cJSON *node,
                       struct scene *scene)
{
    static const char *const kinds[] = {"point", "directional", "spot", NULL};
    int kind = read_type(j, node, kinds);
    if (kind < 0)
        return;
    struct light *light = add_light(scene, (enum light_kind)kind);
    if (light->kind == LIGHT_POINT)
        load_point(j, node, light);
    else if (light->kind == LIGHT_DIRECTIONAL)
        load_directional(j, node, light);
    else
        load_spot(j, node, light);
}

void load_lights(struct json_reader *j, const cJSON *node, struct scene *scene)
{
    if (node == NULL || !json_is_list(j, node))
        return;
    for (const cJSON *item = node->child; item && json_fine(j);
         item = item->next)
        load_light(j, item, scene);
}

/* The environment sees a texture's full image; a constant is one texel. */
static struct image texture_image(const struct texture *t)
{
    if (t->kind == TEXTURE_IMAGE) {
        const struct image *from = &t->image.mipmap.levels[0];
        struct image copy = image_make(from->width, from->height);
        size_t count = (size_t)from->width * (size_t)from->height;
        for (size_t i = 0; i < count; i++)
            copy.pixels[i] = from->pixels[i];
        return copy;
    }
    struct image one = image_make(1, 1);
    one.pixels[0] = t->color[0];
    return one;
}

/* A turned sphere of directions is a sphere of directions; a stretched one is
 * not: rows must be of length one and at right angles. */
static void check_rotation(struct json_reader *j, const cJSON *node,
                           const struct transform *t)
{
    for (int a = 0; a < 3; a++)
        for (int b = a; b < 3; b++) {
            float dot = 0.0f;
            for (int i = 0; i < 3; i++)
                dot += t->m[a][i] * t->m[b][i];
            if (fabsf(dot - (a == b ? 1.0f : 0.0f)) > 1e-3f)
                json_fault(j, node,
                           "expected a rotation (or mirror): rows of "
                           "length 1 at right angles");
        }
}

void load_environment(struct json_reader *j, const cJSON *textures,
                      const cJSON *node, struct scene *scene)
{
    static const char *const keys[] = {"texture_name", "scale", "transform",
                                       NULL};
    if (!json_fine(j) || node == NULL || !json_keys(j, node, keys))
        return;
    const cJSON *name = json_require(j, node, "texture_name");
    int texture = name ? find_named(j, textures, name, "texture") : -1;
    float scale = json_float(j, json_get(node, "scale"), zero_or_more, 1.0f);
    struct transform t = json_transform(j, json_get(node, "transform"));
    check_rotation(j, node, &t);
    if (json_fine(j) && scene->textures[texture].kind == TEXTURE_CHECKERBOARD)
        json_fault(j, name,
                   "found a checkerboard, expected an image or a "
                   "constant");
    if (!json_fine(j))
        return;
    scene->environment_image = texture_image(&scene->textures[texture]);
    scene->environment = (int32_t)scene->light_count;
    add_light(scene, LIGHT_ENVIRONMENT)->environment =
        environment_make(&scene->environment_image, scale, t);
}

static void bind_shape(struct light *light, const struct object *object)
{
    switch (object->kind) {
    case OBJECT_MESH:
        light_set_mesh(light, &object->mesh);
        break;
    case OBJECT_SPHERE:
        light_set_sphere(light, &object->sphere);
        break;
    case OBJECT_RECT:
        light_set_rect(light, &object->rect);
        break;
    }
}

void load_area_light(struct json_reader *j, const cJSON *node,
                     struct scene *scene, struct object *object)
{
    static const char *const keys[] = {"type", "radiance", NULL};
    static const char *const kinds[] = {"area", NULL};
    static const enum light_kind light_kinds[] = {LIGHT_MESH, LIGHT_SPHERE,
                                                  LIGHT_RECT};
    if (node == NULL || read_type(j, node, kinds) < 0)
        return;
    json_keys(j, node, keys);
    rgb radiance =
        json_rgb(j, json_require(j, node, "radiance"), rgb_grey(0.0f));
    if (!json_fine(j))
        return;
    object->light = (int32_t)scene->light_count;
    struct light *light = add_light(scene, light_kinds[object->kind]);
    light->radiance = radiance;
    bind_shape(light, object);
}
