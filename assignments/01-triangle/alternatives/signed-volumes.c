/* triangle.c - assignment 01: three volumes, and no plane.
 *
 * The ray's direction and an edge, both seen from the origin, span a
 * tetrahedron. If the three volumes have one sign, the ray passes on the inner
 * side of every edge; and each one's share of their sum is the weight of the
 * opposite corner. t follows as the mix of the corners along the direction.
 *
 * Double precision. */
#include "shapes/triangle.h"

struct wide {
    double x, y, z;
};

static struct wide widen(vec3 a)
{
    struct wide w = {(double)a.x, (double)a.y, (double)a.z};
    return w;
}

static struct wide minus(vec3 a, vec3 b)
{
    struct wide v = widen(a), w = widen(b);
    struct wide d = {v.x - w.x, v.y - w.y, v.z - w.z};
    return d;
}

static double dot(struct wide a, struct wide b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double volume(struct wide a, struct wide b, struct wide c)
{
    return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
           a.z * (b.x * c.y - b.y * c.x);
}

static bool of_one_sign(double a, double b, double c)
{
    return (a >= 0.0 && b >= 0.0 && c >= 0.0) ||
           (a <= 0.0 && b <= 0.0 && c <= 0.0);
}

bool triangle_intersect(const vec3 p[3], const ray *r, struct triangle_hit *hit)
{
    struct wide d = widen(r->direction);
    struct wide a = minus(p[0], r->origin);
    struct wide b = minus(p[1], r->origin);
    struct wide c = minus(p[2], r->origin);
    double v0 = volume(d, b, c), v1 = volume(d, c, a), v2 = volume(d, a, b);
    double all = v0 + v1 + v2;
    if (all == 0.0 || !of_one_sign(v0, v1, v2))
        return false;
    double t =
        (v0 * dot(a, d) + v1 * dot(b, d) + v2 * dot(c, d)) / (all * dot(d, d));
    if (!(t >= (double)r->t_min && t <= (double)r->t_max))
        return false;
    hit->t = (float)t;
    hit->b1 = (float)(v1 / all);
    hit->b2 = (float)(v2 / all);
    return true;
}

/* The part of edge a that is left when du (or dv) of edge b is taken out. */
static vec3 eliminate(struct wide a, double of_a, struct wide b, double of_b)
{
    double k = of_a / of_b;
    return vec3_make((float)(a.x - k * b.x), (float)(a.y - k * b.y),
                     (float)(a.z - k * b.z));
}

bool triangle_uv_differentials(const vec3 p[3], const vec2 uv[3], vec3 *dp_du,
                               vec3 *dp_dv)
{
    struct wide e1 = minus(p[1], p[0]), e2 = minus(p[2], p[0]);
    double u1 = (double)uv[1].x - (double)uv[0].x;
    double v1 = (double)uv[1].y - (double)uv[0].y;
    double u2 = (double)uv[2].x - (double)uv[0].x;
    double v2 = (double)uv[2].y - (double)uv[0].y;
    double det = u1 * v2 - u2 * v1;
    if (det == 0.0)
        return false;
    /* The larger of the two goes below the line, so that none is 0. */
    vec3 u = fabs(v2) > fabs(v1) ? eliminate(e1, v1, e2, v2)
                                 : eliminate(e2, v2, e1, v1);
    vec3 v = fabs(u2) > fabs(u1) ? eliminate(e1, u1, e2, u2)
                                 : eliminate(e2, u2, e1, u1);
    double per_u = fabs(v2) > fabs(v1) ? v2 / det : -v1 / det;
    double per_v = fabs(u2) > fabs(u1) ? -u2 / det : u1 / det;
    u = vec3_make((float)(u.x * per_u), (float)(u.y * per_u),
                  (float)(u.z * per_u));
    v = vec3_make((float)(v.x * per_v), (float)(v.y * per_v),
                  (float)(v.z * per_v));
    if (!vec3_is_finite(u) || !vec3_is_finite(v))
        return false;
    *dp_du = u;
    *dp_dv = v;
    return true;
}
