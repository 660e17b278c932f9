/* triangle.c - assignment 01: where a ray meets a triangle.
 *
 * The contract is in triangle.h. */
#include "shapes/triangle.h"

#include "base/todo.h"

//> triangle.intersect: Find where a ray meets a triangle
#ifndef TODO_triangle_intersect
/* Vectors in double precision. Corners and rays are single, so differences are
 * exact or nearly so, and thin and distant triangles keep their digits. */
struct wide {
    double x, y, z;
};

static struct wide widen(vec3 a)
{
    return (struct wide){(double)a.x, (double)a.y, (double)a.z};
}

static struct wide minus(struct wide a, struct wide b)
{
    return (struct wide){a.x - b.x, a.y - b.y, a.z - b.z};
}

static double dot(struct wide a, struct wide b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static struct wide cross(struct wide a, struct wide b)
{
    return (struct wide){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                         a.x * b.y - a.y * b.x};
}
#endif

bool triangle_intersect(const vec3 p[3], const ray *r, struct triangle_hit *hit)
{
#ifndef TODO_triangle_intersect
    //> triangle.intersect.system: Set up the 3x3 system
    struct wide p0 = widen(p[0]), direction = widen(r->direction);
    struct wide edge1 = minus(widen(p[1]), p0);
    struct wide edge2 = minus(widen(p[2]), p0);
    struct wide normal = cross(edge1, edge2);
    struct wide to_p0 = minus(p0, widen(r->origin));
    struct wide moment = cross(direction, to_p0);
    double determinant = dot(direction, normal);
    //< triangle.intersect.system
    //> triangle.intersect.solve: Solve it by Cramer's rule
    /* A determinant of 0 makes these infinite or NaN. The test below is
     * written as what must hold for a hit, so both are misses. */
    double inverse = 1.0 / determinant;
    double b1 = -dot(moment, edge2) * inverse;
    double b2 = dot(moment, edge1) * inverse;
    double t = dot(to_p0, normal) * inverse;
    //< triangle.intersect.solve
    //> triangle.intersect.accept: Accept a point inside the triangle and range
    /* More than the rounding of b1 and b2 while the triangle is seen from less
     * than about 10^7 of its heights away. So each of two triangles takes a
     * little of the other's side of their edge, and no ray slips between. */
    const double slack = 0x1p-26;
    bool inside = b1 >= -slack && b2 >= -slack && b1 + b2 <= 1.0 + slack;
    bool in_range = t >= (double)r->t_min && t <= (double)r->t_max;
    if (!(inverse != 0.0 && inside && in_range))
        return false;
    hit->t = (float)t;
    hit->b1 = (float)b1;
    hit->b2 = (float)b2;
    return true;
    //< triangle.intersect.accept
#else
    /* TODO(triangle_intersect): solve origin + t direction =
     * (1 - b1 - b2) p0 + b1 p1 + b2 p2 for t, b1 and b2, then decide whether
     * it is a hit. triangle.h says what must hold; chapter 2 derives it. */
    (void)p, (void)r, (void)hit;
    TODO_WARN("01 triangle", "triangles are invisible");
    return false;
#endif
}
//< triangle.intersect

//> triangle.uv: Find how the point moves with the texture coordinates
bool triangle_uv_differentials(const vec3 p[3], const vec2 uv[3], vec3 *dp_du,
                               vec3 *dp_dv)
{
#ifndef TODO_triangle_uv_differentials
    vec3 edge1 = vec3_sub(p[1], p[0]);
    vec3 edge2 = vec3_sub(p[2], p[0]);
    float du1 = uv[1].x - uv[0].x, dv1 = uv[1].y - uv[0].y;
    float du2 = uv[2].x - uv[0].x, dv2 = uv[2].y - uv[0].y;
    //> triangle.uv.solve: Invert the 2x2 matrix
    float determinant = du1 * dv2 - du2 * dv1;
    if (determinant == 0.0f || !isfinite(determinant))
        return false;
    float k = 1.0f / determinant;
    vec3 u_axis =
        vec3_scale(vec3_sub(vec3_scale(edge1, dv2), vec3_scale(edge2, dv1)), k);
    vec3 v_axis =
        vec3_scale(vec3_sub(vec3_scale(edge2, du1), vec3_scale(edge1, du2)), k);
    //< triangle.uv.solve
    if (!vec3_is_finite(u_axis) || !vec3_is_finite(v_axis))
        return false;
    *dp_du = u_axis;
    *dp_dv = v_axis;
    return true;
#else
    /* TODO(triangle_uv_differentials): two edges are known both in space and
     * in texture coordinates; invert that 2x2 relation. */
    (void)p, (void)uv, (void)dp_du, (void)dp_dv;
    TODO_WARN("01 triangle", "using some frame of the triangle's plane");
    return false;
#endif
}
//< triangle.uv
