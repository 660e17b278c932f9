/* camera.c - see camera.h. */
#include "camera/camera.h"

#include "base/constants.h"

struct camera camera_make(const struct camera_settings *settings,
                          const struct film_settings *film)
{
    struct camera c;
    float half_height = tanf(settings->vertical_fov * (PI / 360.0f));
    float half_width = half_height * (float)film->width / (float)film->height;
    vec3 view = vec3_sub(settings->look_at, settings->position);
    c.eye = settings->position;
    c.forward = vec3_normalize(view);
    vec3 right = vec3_normalize(vec3_cross(c.forward, settings->up));
    vec3 up = vec3_cross(right, c.forward);
    c.right = vec3_scale(right, half_width);
    c.down = vec3_scale(up, -half_height);
    c.width = film->width;
    c.height = film->height;
    return c;
}

/* Not of length one. */
static vec3 direction_through(const struct camera *c, vec2 place)
{
    float x = 2.0f * place.x / (float)c->width - 1.0f;
    float y = 2.0f * place.y / (float)c->height - 1.0f;
    return vec3_step(vec3_step(c->forward, x, c->right), y, c->down);
}

ray camera_ray(const struct camera *c, vec2 place)
{
    vec3 d = direction_through(c, place);
    return ray_make(c->eye, vec3_normalize(d), 0.0f, INFINITY);
}

/* The derivative of v / |v| when v changes by dv: what of dv is at right
 * angles to v, over |v|. */
static vec3 normalized_change(vec3 v, vec3 dv)
{
    float length2 = vec3_dot(v, v);
    vec3 across = vec3_step(dv, -vec3_dot(v, dv) / length2, v);
    return vec3_scale(across, 1.0f / sqrtf(length2));
}

struct ray_differential camera_differential(const struct camera *c, vec2 place)
{
    struct ray_differential d;
    vec3 v = direction_through(c, place);
    vec3 one_right = vec3_scale(c->right, 2.0f / (float)c->width);
    vec3 one_down = vec3_scale(c->down, 2.0f / (float)c->height);
    d.origin_dx = d.origin_dy = vec3_make(0.0f, 0.0f, 0.0f);
    d.direction_dx = normalized_change(v, one_right);
    d.direction_dy = normalized_change(v, one_down);
    return d;
}
