/* triangle.c - assignment 01: first the plane, then the three edges.
 *
 * Single precision throughout. The weights are ratios of areas: the area
 * opposite a corner over the whole. */
#include "shapes/triangle.h"

/* Twice the area of the triangle a, b, q, measured along normal: positive
 * when q is on the inner side of the edge from a to b. */
static float edge_area(vec3 a, vec3 b, vec3 q, vec3 normal)
{
    return vec3_dot(normal, vec3_cross(vec3_sub(b, a), vec3_sub(q, a)));
}

bool triangle_intersect(const vec3 p[3], const ray *r, struct triangle_hit *hit)
{
    vec3 normal = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
    float speed = vec3_dot(normal, r->direction);
    if (speed == 0.0f)
        return false;
    float t = vec3_dot(normal, vec3_sub(p[0], r->origin)) / speed;
    if (!(t >= r->t_min && t <= r->t_max))
        return false;

    vec3 q = ray_at(r, t);
    float area0 = edge_area(p[1], p[2], q, normal);
    float area1 = edge_area(p[2], p[0], q, normal);
    float area2 = edge_area(p[0], p[1], q, normal);
    if (!(area0 >= 0.0f && area1 >= 0.0f && area2 >= 0.0f))
        return false;
    float area = area0 + area1 + area2;
    hit->t = t;
    hit->b1 = area1 / area;
    hit->b2 = area2 / area;
    return true;
}

/* The 2x2 system for one component of the position, by elimination: the row
 * with the larger coefficient of u first, so that the pivot is never 0. */
static bool solve(vec2 row1, float right1, vec2 row2, float right2, float *u,
                  float *v)
{
    if (fabsf(row1.x) < fabsf(row2.x))
        return solve(row2, right2, row1, right1, u, v);
    float factor = row2.x / row1.x;
    float pivot = row2.y - factor * row1.y;
    *v = (right2 - factor * right1) / pivot;
    *u = (right1 - row1.y * *v) / row1.x;
    return isfinite(*u) && isfinite(*v);
}

bool triangle_uv_differentials(const vec3 p[3], const vec2 uv[3], vec3 *dp_du,
                               vec3 *dp_dv)
{
    vec2 row1 = {uv[1].x - uv[0].x, uv[1].y - uv[0].y};
    vec2 row2 = {uv[2].x - uv[0].x, uv[2].y - uv[0].y};
    if (row1.x * row2.y == row1.y * row2.x)
        return false;
    vec3 e1 = vec3_sub(p[1], p[0]), e2 = vec3_sub(p[2], p[0]);
    vec3 u, v;
    if (!solve(row1, e1.x, row2, e2.x, &u.x, &v.x) ||
        !solve(row1, e1.y, row2, e2.y, &u.y, &v.y) ||
        !solve(row1, e1.z, row2, e2.z, &u.z, &v.z))
        return false;
    *dp_du = u;
    *dp_dv = v;
    return true;
}
