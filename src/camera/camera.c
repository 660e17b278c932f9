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

ray camera_ray(const struct camera *c, vec2 place)
{
    float x = 2.0f * place.x / (float)c->width - 1.0f;
    float y = 2.0f * place.y / (float)c->height - 1.0f;
    vec3 d = vec3_step(vec3_step(c->forward, x, c->right), y, c->down);
    return ray_make(c->eye, vec3_normalize(d), 0.0f, INFINITY);
}
