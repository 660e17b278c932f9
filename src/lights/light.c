/* light.c - which kind of light answers; see light.h. */
#include "lights/light.h"

#include "base/constants.h"
#include "lights/delta_lights.h"
#include "lights/environment_map.h"
#include "lights/mesh_light.h"
#include "lights/rect_light.h"
#include "lights/sphere_light.h"

//> light.shapes: Tie a light to its shape
void light_set_rect(struct light *light, const struct rect *rect)
{
    light->rect = rect;
    light->area = rect->area;
    light->extent = vec3_length(rect->side_x) + vec3_length(rect->side_y);
}

void light_set_sphere(struct light *light, const struct sphere *sphere)
{
    light->sphere = sphere;
    light->area = 4.0f * PI * sphere->radius * sphere->radius;
    light->extent = 2.0f * sphere->radius;
}

void light_set_mesh(struct light *light, const struct mesh *mesh)
{
    distribution_1d_free(&light->triangles);
    light->mesh = mesh;
    light->triangles = mesh_light_table(mesh, &light->area);
    light->extent = mesh_light_longest_edge(mesh);
}
//< light.shapes

//> light.look: Look at a place on a light
static float taxicab(vec3 v)
{
    return fabsf(v.x) + fabsf(v.y) + fabsf(v.z);
}

/* A step off the light, on the side of its normal. The place has been rounded
 * by about 4 units in its last digit, and a ray test that starts at the point
 * finds the light's plane to about 12 in those of the distances it meets. */
static vec3 off_light(const struct light *light, vec3 point, vec3 place,
                      vec3 normal)
{
    float size = taxicab(place) + taxicab(vec3_sub(place, point));
    return vec3_step(place, rounding_bound(16) * (size + light->extent),
                     normal);
}

static void look_along(const struct light *light, vec3 point, vec3 place,
                       vec3 normal, struct light_sample *out)
{
    out->target = off_light(light, point, place, normal);
    out->infinite = false;
    out->delta = false;
    out->radiance = light->radiance;
}

/* A place that was picked evenly by area. */
static bool see_place(const struct light *light, vec3 point, vec3 place,
                      vec3 normal, struct light_sample *out)
{
    look_along(light, point, place, normal, out);
    out->pdf = area_light_pdf(point, place, normal, light->area);
    if (!(out->pdf > 0.0f))
        return false;
    out->direction = vec3_normalize(vec3_sub(place, point));
    out->radiance = light_emitted(light, normal, vec3_negate(out->direction));
    return true;
}
//< light.look

//> light.sample: Ask each kind of light for a direction
static bool sample_rect(const struct light *light, vec3 point, vec2 random,
                        struct light_sample *out)
{
    vec3 place = rect_light_place(light->rect, random);
    return see_place(light, point, place, light->rect->normal, out);
}

static bool sample_mesh(const struct light *light, vec3 point, vec2 random,
                        struct light_sample *out)
{
    vec3 normal;
    if (!(light->area > 0.0f))
        return false;
    vec3 place =
        mesh_light_place(light->mesh, &light->triangles, random, &normal);
    return see_place(light, point, place, normal, out);
}

static bool sample_sphere(const struct light *light, vec3 point, vec2 random,
                          struct light_sample *out)
{
    vec3 place, normal;
    if (!sphere_light_sample(light->sphere, point, random, &out->direction,
                             &place, &normal))
        return false;
    look_along(light, point, place, normal, out);
    out->pdf = sphere_light_pdf(light->sphere, point);
    return true;
}

static bool sample_environment(const struct light *light, vec2 random,
                               struct light_sample *out)
{
    const struct environment *e = &light->environment;
    out->pdf = environment_sample(e, random, &out->direction);
    out->target = vec3_make(0.0f, 0.0f, 0.0f);
    out->infinite = true;
    out->delta = false;
    out->radiance = environment_radiance(e, out->direction);
    return true;
}

static bool sample_any(const struct light *light, vec3 point, vec2 random,
                       struct light_sample *out)
{
    switch (light->kind) {
    case LIGHT_POINT:
        return point_light_sample(light, point, out);
    case LIGHT_DIRECTIONAL:
        return directional_light_sample(light, out);
    case LIGHT_SPOT:
        return spot_light_sample(light, point, out);
    case LIGHT_RECT:
        return sample_rect(light, point, random, out);
    case LIGHT_SPHERE:
        return sample_sphere(light, point, random, out);
    case LIGHT_MESH:
        return sample_mesh(light, point, random, out);
    case LIGHT_ENVIRONMENT:
        return sample_environment(light, random, out);
    }
    return false;
}

bool light_sample(const struct light *light, vec3 point, vec2 random,
                  struct light_sample *out)
{
    return sample_any(light, point, random, out) && out->pdf > 0.0f &&
           isfinite(out->pdf) && !rgb_is_black(out->radiance);
}
//< light.sample

//> light.pdf: Say how likely a direction was
float light_pdf(const struct light *light, vec3 point, vec3 direction,
                vec3 position, vec3 normal)
{
    switch (light->kind) {
    case LIGHT_RECT:
    case LIGHT_MESH:
        return area_light_pdf(point, position, normal, light->area);
    case LIGHT_SPHERE:
        return sphere_light_pdf(light->sphere, point);
    case LIGHT_ENVIRONMENT:
        return environment_pdf(&light->environment, direction);
    case LIGHT_POINT:
    case LIGHT_DIRECTIONAL:
    case LIGHT_SPOT:
        break;
    }
    return 0.0f;
}
//< light.pdf

static bool is_area_light(const struct light *light)
{
    return light->kind == LIGHT_RECT || light->kind == LIGHT_SPHERE ||
           light->kind == LIGHT_MESH;
}

rgb light_emitted(const struct light *light, vec3 normal, vec3 outgoing)
{
    if (!is_area_light(light))
        return rgb_grey(0.0f);
    return area_light_emitted(light->radiance, normal, outgoing);
}

bool light_is_delta(const struct light *light)
{
    return !is_area_light(light) && light->kind != LIGHT_ENVIRONMENT;
}

//> light.power: Estimate the power of a light
/* The integral of the falloff over the sphere: with beam b and cutoff c, 2 pi
 * (1 - (sin c - sin b) / (c - b)). */
static float spot_solid_angle(const struct light *light)
{
    float b = light->beam_angle, c = light->cutoff_angle;
    if (!(c - b > 1e-4f)) /* a hard edge: the quotient's limit */
        return 2.0f * PI * (1.0f - cosf(c));
    return 2.0f * PI * (1.0f - (sinf(c) - sinf(b)) / (c - b));
}

float light_power(const struct light *light, float scene_radius)
{
    float disk = PI * scene_radius * scene_radius;
    switch (light->kind) {
    case LIGHT_POINT:
        return rgb_luminance(light->flux);
    case LIGHT_DIRECTIONAL:
        return disk * rgb_luminance(light->irradiance);
    case LIGHT_SPOT:
        return spot_solid_angle(light) * rgb_luminance(light->intensity);
    case LIGHT_RECT:
    case LIGHT_SPHERE:
    case LIGHT_MESH:
        return light->area * PI * rgb_luminance(light->radiance);
    case LIGHT_ENVIRONMENT:
        return disk * 4.0f * PI *
               environment_mean_luminance(&light->environment);
    }
    return 0.0f;
}
//< light.power

void light_free(struct light *light)
{
    distribution_1d_free(&light->triangles);
    environment_free(&light->environment);
}
