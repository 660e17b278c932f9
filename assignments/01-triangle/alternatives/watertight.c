/* triangle.c - assignment 01: the watertight test.
 *
 * The triangle is moved and sheared so that the ray becomes the z axis from
 * the origin; what is left is to ask on which side of three 2D edges the
 * origin lies. Two triangles that share an edge ask the very same question
 * of it, so no ray slips between them.
 *
 * Source: S. Woop, C. Benthin and I. Wald, "Watertight Ray/Triangle
 * Intersection", Journal of Computer Graphics Techniques 2(1), 2013. */
#include "shapes/triangle.h"

/* The axes in another order, z being the direction's largest, and the shear
 * that turns the direction into (0, 0, 1). */
struct shear {
    int kx, ky, kz;
    float sx, sy, sz;
};

static struct shear shear_of(vec3 d)
{
    vec3 size = vec3_abs(d);
    struct shear s;
    s.kz =
        size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    s.kx = (s.kz + 1) % 3;
    s.ky = (s.kz + 2) % 3;
    s.sz = 1.0f / vec3_axis(d, s.kz);
    s.sx = vec3_axis(d, s.kx) / vec3_axis(d, s.kz);
    s.sy = vec3_axis(d, s.ky) / vec3_axis(d, s.kz);
    return s;
}

static vec3 sheared(struct shear s, vec3 p, vec3 origin)
{
    vec3 a = vec3_sub(p, origin);
    float z = vec3_axis(a, s.kz);
    return vec3_make(vec3_axis(a, s.kx) - s.sx * z,
                     vec3_axis(a, s.ky) - s.sy * z, s.sz * z);
}

/* Which side of the edge from b to c the origin is on; when single precision
 * says "on it", double decides. */
static float side(vec3 b, vec3 c)
{
    float area = c.x * b.y - c.y * b.x;
    if (area == 0.0f)
        area = (float)((double)c.x * b.y - (double)c.y * b.x);
    return area;
}

bool triangle_intersect(const vec3 p[3], const ray *r, struct triangle_hit *hit)
{
    struct shear s = shear_of(r->direction);
    vec3 a = sheared(s, p[0], r->origin);
    vec3 b = sheared(s, p[1], r->origin);
    vec3 c = sheared(s, p[2], r->origin);

    float u = side(b, c), v = side(c, a), w = side(a, b);
    bool front = u >= 0.0f && v >= 0.0f && w >= 0.0f;
    bool back = u <= 0.0f && v <= 0.0f && w <= 0.0f;
    float area = u + v + w;
    if (!(front || back) || area == 0.0f)
        return false;
    float t = (u * a.z + v * b.z + w * c.z) / area;
    if (!(t >= r->t_min && t <= r->t_max))
        return false;
    hit->t = t;
    hit->b1 = v / area;
    hit->b2 = w / area;
    return true;
}

bool triangle_uv_differentials(const vec3 p[3], const vec2 uv[3], vec3 *dp_du,
                               vec3 *dp_dv)
{
    float u1 = uv[1].x - uv[0].x, v1 = uv[1].y - uv[0].y;
    float u2 = uv[2].x - uv[0].x, v2 = uv[2].y - uv[0].y;
    float area = u1 * v2 - u2 * v1;
    vec3 e1 = vec3_sub(p[1], p[0]), e2 = vec3_sub(p[2], p[0]);
    vec3 u = vec3_step(vec3_scale(e1, v2 / area), -v1 / area, e2);
    vec3 v = vec3_step(vec3_scale(e2, u1 / area), -u2 / area, e1);
    if (area == 0.0f || !vec3_is_finite(u) || !vec3_is_finite(v))
        return false;
    *dp_du = u;
    *dp_dv = v;
    return true;
}
