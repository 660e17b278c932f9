/* load_settings.c - integrator, film, camera and sampler of a scene file. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "scene/load_parts.h"

const char *const integrator_names[] = {"intersection_test", NULL};

static const struct json_range spp_range = {
    1, SPP_MAX, "a whole number from 1 to 16777216"};
static const struct json_range depth_range = {1, DEPTH_MAX,
                                              "a whole number from 1 to 65536"};
static const struct json_range side_range = {1, FILM_MAX_SIDE,
                                             "a whole number from 1 to 65536"};
/* 2^53: up to there JSON numbers, which are doubles, are exact. */
static const struct json_range seed_range = {0, 9007199254740992.0,
                                             "a whole number from 0 to 2^53"};

/* The names that the format knows; only the first count work so far. */
static int supported_name(struct json_reader *j, const cJSON *node,
                          const char *const names[], int count)
{
    int i = json_name(j, node, names);
    char what[64];
    if (i < count)
        return i;
    snprintf(what, sizeof what, "\"%s\"", names[i]);
    not_supported(j, node, what);
    return 0;
}

static void load_point_light(struct json_reader *j, const cJSON *node,
                             struct scene *scene)
{
    vec3 position = json_vec3(j, json_get(node, "point_light_position"),
                              vec3_make(0.0f, 5.0f, 0.0f));
    rgb flux = json_rgb(j, json_get(node, "point_light_flux"), rgb_grey(1.0f));
    add_point_light(scene, position, flux);
}

void load_integrator(struct json_reader *j, const cJSON *node,
                     struct scene *scene)
{
    static const char *const keys[] = {
        "type", "spp", "max_depth", "point_light_position", "point_light_flux",
        NULL};
    static const char *const kinds[] = {"intersection_test",
                                        "direct",
                                        "path",
                                        "bdpt",
                                        "photon",
                                        "normal",
                                        "depth",
                                        "uv",
                                        "bvh_cost",
                                        "mip_level",
                                        NULL};
    struct integrator_settings *s = &scene->integrator;
    s->kind = INTEGRATOR_INTERSECTION_TEST;
    s->spp = 8;
    s->max_depth = 16;
    if (node == NULL) {
        add_point_light(scene, vec3_make(0.0f, 5.0f, 0.0f), rgb_grey(1.0f));
        return;
    }
    if (!cJSON_IsObject(node)) {
        json_unexpected(j, node, "an object { ... }");
        return;
    }
    const cJSON *type = json_get(node, "type");
    s->kind = (enum integrator_kind)supported_name(j, type, kinds, 1);
    json_keys(j, node, keys);
    s->spp = json_integer(j, json_get(node, "spp"), spp_range, 8);
    s->max_depth =
        json_integer(j, json_get(node, "max_depth"), depth_range, 16);
    load_point_light(j, node, scene);
}

static void load_filter(struct json_reader *j, const cJSON *node,
                        struct film_settings *film)
{
    static const char *const keys[] = {"type", "radius", "alpha",
                                       "B",    "C",      NULL};
    static const char *const kinds[] = {"box", "tent", "gaussian", "mitchell",
                                        NULL};
    static const struct json_range radius = {1e-3, 64.0,
                                             "a number from 0.001 to 64"};
    film->filter_radius = 0.5f;
    if (node == NULL || !json_keys(j, node, keys))
        return;
    supported_name(j, json_get(node, "type"), kinds, 1);
    film->filter_radius = json_float(j, json_get(node, "radius"), radius, 0.5f);
    json_float(j, json_get(node, "alpha"), above_zero, 2.0f);
    json_float(j, json_get(node, "B"), any_float, 1.0f / 3.0f);
    json_float(j, json_get(node, "C"), any_float, 1.0f / 3.0f);
}

static void load_resolution(struct json_reader *j, const cJSON *node,
                            struct film_settings *film)
{
    film->width = film->height = 600;
    if (node == NULL)
        return;
    if (!cJSON_IsArray(node) || cJSON_GetArraySize(node) != 2) {
        json_unexpected(j, node, "a list of 2 whole numbers, width and height");
        return;
    }
    film->width = json_integer(j, node->child, side_range, 600);
    film->height = json_integer(j, node->child->next, side_range, 600);
    if ((int64_t)film->width * film->height > FILM_MAX_PIXELS)
        json_fault(j, node, "%d x %d pixels are too many, expected at most %d",
                   film->width, film->height, FILM_MAX_PIXELS);
}

void load_film(struct json_reader *j, const cJSON *node, struct scene *scene)
{
    static const char *const keys[] = {"resolution", "filter", NULL};
    if (node != NULL && !json_keys(j, node, keys))
        return;
    load_resolution(j, json_get(node, "resolution"), &scene->film);
    load_filter(j, json_get(node, "filter"), &scene->film);
}

/* The three vectors must span a camera frame: the view must have a length and
 * must not run along the up vector (to float precision). */
static void check_frame(struct json_reader *j, const cJSON *node,
                        const struct camera_settings *c)
{
    vec3 view = vec3_sub(c->look_at, c->position);
    float length = vec3_length(view), up = vec3_length(c->up);
    if (!isfinite(length) || !isfinite(up))
        json_fault(j, node, "the camera's numbers are too large");
    else if (!(length > 0.0f))
        json_fault(j, node, "position and look_at are the same point");
    else if (!(up > 0.0f))
        json_fault(j, node, "ref_up is the zero vector");
    else if (!(vec3_length(vec3_cross(view, c->up)) > 1e-6f * length * up))
        json_fault(j, node, "ref_up is parallel to the view direction");
}

void load_camera(struct json_reader *j, const cJSON *node, struct scene *scene)
{
    static const char *const keys[] = {"position", "look_at",      "ref_up",
                                       "fov",      "focal_length", NULL};
    /* Beyond these, tan(fov / 2) leaves the range where pixels differ. */
    static const struct json_range fov = {
        1e-3, 179.9, "an angle in degrees from 0.001 to 179.9"};
    struct camera_settings *c = &scene->camera;
    if (node != NULL && !json_keys(j, node, keys))
        return;
    c->position = json_vec3(j, json_get(node, "position"), vec3_make(0, 0, 1));
    c->look_at = json_vec3(j, json_get(node, "look_at"), vec3_make(0, 0, 0));
    c->up = json_vec3(j, json_get(node, "ref_up"), vec3_make(0, 1, 0));
    c->vertical_fov = json_float(j, json_get(node, "fov"), fov, 45.0f);
    /* No part of a pinhole's picture; the course's scenes have it. */
    json_float(j, json_get(node, "focal_length"), above_zero, 1.0f);
    check_frame(j, node, c);
}

void load_sampler(struct json_reader *j, const cJSON *node, struct scene *scene)
{
    static const char *const keys[] = {"type", "seed", NULL};
    static const char *const kinds[] = {"independent", "stratified", "sobol",
                                        NULL};
    if (node == NULL || !json_keys(j, node, keys))
        return;
    supported_name(j, json_get(node, "type"), kinds, 1);
    const cJSON *seed = json_get(node, "seed");
    double value = json_number(j, seed, seed_range, 0.0);
    scene->integrator.seed = (uint64_t)value;
    if ((double)scene->integrator.seed != value)
        json_unexpected(j, seed, seed_range.expected);
}
