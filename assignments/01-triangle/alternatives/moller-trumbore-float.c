/* triangle.c - assignment 01: Moller and Trumbore in single precision, and one
 * condition at the end that says what a hit is. */
#include "shapes/triangle.h"

static bool has_area(vec3 edge1, vec3 edge2)
{
    vec3 normal = vec3_cross(edge1, edge2);
    return normal.x != 0.0f || normal.y != 0.0f || normal.z != 0.0f;
}

bool triangle_intersect(const vec3 p[3], const ray *r, struct triangle_hit *hit)
{
    vec3 edge1 = vec3_sub(p[1], p[0]);
    vec3 edge2 = vec3_sub(p[2], p[0]);
    vec3 s = vec3_sub(r->origin, p[0]);
    vec3 a = vec3_cross(r->direction, edge2);
    vec3 b = vec3_cross(s, edge1);

    float determinant = vec3_dot(edge1, a);
    float u = vec3_dot(s, a) / determinant;
    float v = vec3_dot(r->direction, b) / determinant;
    float t = vec3_dot(edge2, b) / determinant;

    /* Without area the determinant may be what rounding leaves of 0, and the
     * rest noise; the normal is 0 even so. NaN fails by itself. */
    bool hits = has_area(edge1, edge2) && u >= 0.0f && v >= 0.0f &&
                u + v <= 1.0f && t >= r->t_min && t <= r->t_max;
    if (hits)
        *hit = (struct triangle_hit){.t = t, .b1 = u, .b2 = v};
    return hits;
}

bool triangle_uv_differentials(const vec3 p[3], const vec2 uv[3], vec3 *dp_du,
                               vec3 *dp_dv)
{
    vec3 edge1 = vec3_sub(p[1], p[0]);
    vec3 edge2 = vec3_sub(p[2], p[0]);
    vec2 d1 = {uv[1].x - uv[0].x, uv[1].y - uv[0].y};
    vec2 d2 = {uv[2].x - uv[0].x, uv[2].y - uv[0].y};
    float determinant = d1.x * d2.y - d1.y * d2.x;
    if (determinant == 0.0f)
        return false;
    vec3 u = vec3_step(vec3_scale(edge1, d2.y / determinant),
                       -d1.y / determinant, edge2);
    vec3 v = vec3_step(vec3_scale(edge2, d1.x / determinant),
                       -d2.x / determinant, edge1);
    if (!vec3_is_finite(u) || !vec3_is_finite(v))
        return false;
    *dp_du = u;
    *dp_dv = v;
    return true;
}
