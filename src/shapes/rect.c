/* rect.c - see rect.h. */
#include "shapes/rect.h"

#include "base/constants.h"

struct rect rect_make(const struct transform *to_world)
{
    struct rect s;
    s.center = transform_point(to_world, vec3_make(0.0f, 0.0f, 0.0f));
    s.side_x = transform_direction(to_world, vec3_make(1.0f, 0.0f, 0.0f));
    s.side_y = transform_direction(to_world, vec3_make(0.0f, 1.0f, 0.0f));
    s.normal =
        vec3_normalize(transform_normal(to_world, vec3_make(0.0f, 0.0f, 1.0f)));
    s.area = vec3_length(vec3_cross(s.side_x, s.side_y));
    return s;
}

/* The coordinates of a point of the plane along the two sides, each in
 * [-1/2, 1/2] inside: a 2x2 system, since the sides need not be at right
 * angles. */
static vec2 plane_coordinates(const struct rect *s, vec3 point)
{
    vec3 d = vec3_sub(point, s->center);
    float xx = vec3_dot(s->side_x, s->side_x);
    float xy = vec3_dot(s->side_x, s->side_y);
    float yy = vec3_dot(s->side_y, s->side_y);
    float dx = vec3_dot(d, s->side_x), dy = vec3_dot(d, s->side_y);
    float k = 1.0f / (xx * yy - xy * xy);
    return vec2_make(k * (yy * dx - xy * dy), k * (xx * dy - xy * dx));
}

bool rect_intersect(const struct rect *s, const ray *r, float *t)
{
    float toward = vec3_dot(s->normal, r->direction);
    float distance = vec3_dot(s->normal, vec3_sub(s->center, r->origin));
    float found = distance / toward;
    if (!(toward != 0.0f && found >= r->t_min && found <= r->t_max))
        return false;
    vec2 place = plane_coordinates(s, ray_at(r, found));
    if (!(fabsf(place.x) <= 0.5f && fabsf(place.y) <= 0.5f))
        return false;
    *t = found;
    return true;
}

/* The position is a sum of three terms, none larger than this; the two
 * coordinates carry the error of the plane hit, which only slides the point
 * within the plane. */
static vec3 position_error(const struct rect *s, vec2 place)
{
    vec3 size = vec3_abs(s->center);
    size = vec3_step(size, fabsf(place.x), vec3_abs(s->side_x));
    size = vec3_step(size, fabsf(place.y), vec3_abs(s->side_y));
    return vec3_scale(size, rounding_bound(5));
}

void rect_surface(const struct rect *s, const ray *r, float t,
                  struct surface *out)
{
    static const struct surface nothing;
    vec2 place = plane_coordinates(s, ray_at(r, t));
    *out = nothing;
    out->position =
        vec3_step(vec3_step(s->center, place.x, s->side_x), place.y, s->side_y);
    out->position_error = position_error(s, place);
    out->geometric_normal = s->normal;
    out->shading_normal = s->normal;
    out->uv = vec2_make(place.x + 0.5f, 0.5f - place.y);
    out->dp_du = s->side_x;
    out->dp_dv = vec3_negate(s->side_y);
}

aabb rect_bounds(const struct rect *s)
{
    vec3 half =
        vec3_scale(vec3_add(vec3_abs(s->side_x), vec3_abs(s->side_y)), 0.5f);
    aabb box = {vec3_sub(s->center, half), vec3_add(s->center, half)};
    return box;
}
