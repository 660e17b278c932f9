/* load_settings.c - integrator, film, camera and sampler of a scene file. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "scene/load_parts.h"

const char *const integrator_names[] = {
    "intersection_test", "direct",    "path", "normal", "depth", "uv",
    "bvh_cost",          "mip_level", NULL};
const char *const light_selection_names[] = {"all", "uniform", "power", NULL};

static const struct json_range spp_range = {
    1, SPP_MAX, "a whole number from 1 to 16777216"};
static const struct json_range depth_range = {1, DEPTH_MAX,
                                              "a whole number from 1 to 65536"};
static const struct json_range side_range = {1, FILM_MAX_SIDE,
                                             "a whole number from 1 to 65536"};
/* 2^53: up to there JSON numbers, which are doubles, are exact. */
static const struct json_range seed_range = {0, 9007199254740992.0,
                                             "a whole number from 0 to 2^53"};

/* What an integrator takes when its keys are absent. */
struct integrator_defaults {
    int spp, max_depth;
    enum light_selection selection;
};

static struct integrator_defaults defaults_of(enum integrator_kind kind)
{
    const struct integrator_defaults simple = {8, 16, SELECT_ALL};
    const struct integrator_defaults direct = {32, 16, SELECT_ALL};
    const struct integrator_defaults path = {32, 12, SELECT_POWER};
    if (kind == INTEGRATOR_PATH)
        return path;
    return kind == INTEGRATOR_DIRECT ? direct : simple;
}

/* The keys beside type, spp, max_depth and light_selection. */
static const char *const test_keys[] = {"type",
                                        "spp",
                                        "max_depth",
                                        "light_selection",
                                        "point_light_position",
                                        "point_light_flux",
                                        NULL};
static const char *const path_keys[] = {
    "type",    "spp",          "max_depth", "light_selection",
    "profile", "rr_threshold", NULL};
static const char *const other_keys[] = {"type", "spp", "max_depth",
                                         "light_selection", NULL};

/* The light of the keys point_light_position and point_light_flux. */
static void load_point_light(struct json_reader *j, const cJSON *node,
                             struct scene *scene)
{
    struct light *light = add_light(scene, LIGHT_POINT);
    light->position = json_vec3(j, json_get(node, "point_light_position"),
                                vec3_make(0.0f, 5.0f, 0.0f));
    light->flux =
        json_rgb(j, json_get(node, "point_light_flux"), rgb_grey(1.0f));
}

static void load_path(struct json_reader *j, const cJSON *node,
                      struct integrator_settings *s)
{
    static const char *const profiles[] = {
        "RW", "NEE", "MIS", "RandomWalk", "NextEventEstimation", NULL};
    static const enum path_profile meaning[] = {
        PROFILE_RW, PROFILE_NEE, PROFILE_MIS, PROFILE_RW, PROFILE_NEE};
    const cJSON *profile = json_get(node, "profile");
    s->profile =
        profile ? meaning[json_name(j, profile, profiles)] : PROFILE_MIS;
    s->rr_threshold =
        json_float(j, json_get(node, "rr_threshold"), zero_or_more, 0.1f);
}

/* The course's scenes name integrators that this program has not: they have
 * the same expected image as path. */
static enum integrator_kind read_kind(struct json_reader *j, const cJSON *type,
                                      bool *substituted)
{
    static const char *const names[] = {
        "intersection_test", "direct",    "path", "normal", "depth", "uv",
        "bvh_cost",          "mip_level", "bdpt", "photon", NULL};
    int kind = json_name(j, type, names);
    *substituted = kind > INTEGRATOR_MIP_LEVEL;
    return *substituted ? INTEGRATOR_PATH : (enum integrator_kind)kind;
}

static void load_integrator_keys(struct json_reader *j, const cJSON *node,
                                 bool substituted, struct scene *scene)
{
    struct integrator_settings *s = &scene->integrator;
    struct integrator_defaults otherwise = defaults_of(s->kind);
    if (node != NULL && !substituted)
        json_keys(j, node,
                  s->kind == INTEGRATOR_INTERSECTION_TEST ? test_keys
                  : s->kind == INTEGRATOR_PATH            ? path_keys
                                                          : other_keys);
    s->spp = json_integer(j, json_get(node, "spp"), spp_range, otherwise.spp);
    s->max_depth = json_integer(j, json_get(node, "max_depth"), depth_range,
                                otherwise.max_depth);
    const cJSON *selection = json_get(node, "light_selection");
    s->selection = selection ? (enum light_selection)json_name(
                                   j, selection, light_selection_names)
                             : otherwise.selection;
    load_path(j, node, s);
    if (s->kind == INTEGRATOR_INTERSECTION_TEST)
        load_point_light(j, node, scene);
}

void load_integrator(struct json_reader *j, const cJSON *node,
                     struct scene *scene)
{
    bool substituted = false;
    if (node != NULL && !cJSON_IsObject(node)) {
        json_unexpected(j, node, "an object { ... }");
        return;
    }
    const cJSON *type = json_get(node, "type");
    scene->integrator.kind = read_kind(j, type, &substituted);
    if (substituted)
        fprintf(stderr,
                "raybook: %s: /integrator/type: \"%s\" is rendered "
                "with path (MIS): same expected image\n",
                j->file, type->valuestring);
    if (json_fine(j))
        load_integrator_keys(j, node, substituted, scene);
}

static void load_filter(struct json_reader *j, const cJSON *node,
                        struct film_settings *film)
{
    static const char *const keys[] = {"type", "radius", "alpha",
                                       "B",    "C",      NULL};
    static const struct json_range radius = {1e-3, 64.0,
                                             "a number from 0.001 to 64"};
    static const struct json_range cubic = {-10.0, 10.0,
                                            "a number from -10 to 10"};
    if (node != NULL && !json_keys(j, node, keys))
        return;
    film->filter =
        (enum filter_kind)json_name(j, json_get(node, "type"), filter_names);
    film->filter_radius = json_float(j, json_get(node, "radius"), radius, 0.5f);
    film->alpha = json_float(j, json_get(node, "alpha"), above_zero, 2.0f);
    film->b = json_float(j, json_get(node, "B"), cubic, 1.0f / 3.0f);
    film->c = json_float(j, json_get(node, "C"), cubic, 1.0f / 3.0f);
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
    if (node == NULL || !json_keys(j, node, keys))
        return;
    scene->integrator.sampler =
        (enum sampler_kind)json_name(j, json_get(node, "type"), sampler_names);
    const cJSON *seed = json_get(node, "seed");
    double value = json_number(j, seed, seed_range, 0.0);
    scene->integrator.seed = (uint64_t)value;
    if ((double)scene->integrator.seed != value)
        json_unexpected(j, seed, seed_range.expected);
}
