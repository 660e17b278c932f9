/* triangle.c - assignment 01: Moller and Trumbore, in the order of their
 * paper (direction x edge2 first, an exit after each weight), in double. */
#include "shapes/triangle.h"

struct wide {
    double x, y, z;
};

static struct wide difference(vec3 a, vec3 b)
{
    struct wide d = {(double)a.x - b.x, (double)a.y - b.y, (double)a.z - b.z};
    return d;
}

static struct wide widen(vec3 a)
{
    struct wide w = {a.x, a.y, a.z};
    return w;
}

static double dot(struct wide a, struct wide b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static struct wide cross(struct wide a, struct wide b)
{
    struct wide c = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                     a.x * b.y - a.y * b.x};
    return c;
}

bool triangle_intersect(const vec3 p[3], const ray *r, struct triangle_hit *hit)
{
    struct wide edge1 = difference(p[1], p[0]);
    struct wide edge2 = difference(p[2], p[0]);
    struct wide d = widen(r->direction);

    struct wide pvec = cross(d, edge2);
    double determinant = dot(edge1, pvec);
    if (determinant == 0.0)
        return false;
    struct wide tvec = difference(r->origin, p[0]);
    double u = dot(tvec, pvec) / determinant;
    if (!(u >= 0.0 && u <= 1.0))
        return false;
    struct wide qvec = cross(tvec, edge1);
    double v = dot(d, qvec) / determinant;
    if (!(v >= 0.0 && u + v <= 1.0))
        return false;
    double t = dot(edge2, qvec) / determinant;
    if (!(t >= r->t_min && t <= r->t_max))
        return false;
    *hit = (struct triangle_hit){(float)t, (float)u, (float)v};
    return true;
}

/* (a x - b y) / k, rounded to single precision at the end. */
static vec3 combine(double x, struct wide a, double y, struct wide b, double k)
{
    return vec3_make((float)((x * a.x - y * b.x) / k),
                     (float)((x * a.y - y * b.y) / k),
                     (float)((x * a.z - y * b.z) / k));
}

bool triangle_uv_differentials(const vec3 p[3], const vec2 uv[3], vec3 *dp_du,
                               vec3 *dp_dv)
{
    double u1 = (double)uv[1].x - uv[0].x, v1 = (double)uv[1].y - uv[0].y;
    double u2 = (double)uv[2].x - uv[0].x, v2 = (double)uv[2].y - uv[0].y;
    double determinant = u1 * v2 - v1 * u2;
    if (determinant == 0.0)
        return false;
    struct wide edge1 = difference(p[1], p[0]);
    struct wide edge2 = difference(p[2], p[0]);
    vec3 u = combine(v2, edge1, v1, edge2, determinant);
    vec3 v = combine(u1, edge2, u2, edge1, determinant);
    if (!vec3_is_finite(u) || !vec3_is_finite(v))
        return false;
    *dp_du = u;
    *dp_dv = v;
    return true;
}
