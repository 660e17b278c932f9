/* triangle.c - assignment 01: first the plane, then a picture of the triangle
 * in the coordinate plane that it faces most, where the weights are ratios of
 * flat areas.
 *
 * Double precision.
 *
 * Source: D. Badouel, "An Efficient Ray-Polygon Intersection", in Graphics
 * Gems, 1990. */
#include "shapes/triangle.h"

struct flat {
    double x, y;
};

/* The two axes that are left when one is dropped, in cyclic order. */
static const int axis_x[3] = {1, 2, 0}, axis_y[3] = {2, 0, 1};

static double component(vec3 a, int axis)
{
    return (double)vec3_axis(a, axis);
}

/* The component of the normal along an axis: twice the area of the triangle
 * as it is seen along that axis. */
static double area_seen(const vec3 p[3], int axis)
{
    int x = axis_x[axis], y = axis_y[axis];
    double x1 = component(p[1], x) - component(p[0], x);
    double y1 = component(p[1], y) - component(p[0], y);
    double x2 = component(p[2], x) - component(p[0], x);
    double y2 = component(p[2], y) - component(p[0], y);
    return x1 * y2 - y1 * x2;
}

static int largest(const double a[3])
{
    int axis = fabs(a[1]) > fabs(a[0]) ? 1 : 0;
    return fabs(a[2]) > fabs(a[axis]) ? 2 : axis;
}

static double flat_area(struct flat a, struct flat b)
{
    return a.x * b.y - a.y * b.x;
}

/* From the ray's point at t to a corner, without the dropped axis. */
static struct flat to_corner(vec3 corner, const ray *r, double t, int axis)
{
    int x = axis_x[axis], y = axis_y[axis];
    struct flat v;
    v.x = component(corner, x) - component(r->origin, x) -
          t * component(r->direction, x);
    v.y = component(corner, y) - component(r->origin, y) -
          t * component(r->direction, y);
    return v;
}

bool triangle_intersect(const vec3 p[3], const ray *r, struct triangle_hit *hit)
{
    double normal[3], towards = 0.0, speed = 0.0;
    for (int i = 0; i < 3; i++) {
        normal[i] = area_seen(p, i);
        speed += normal[i] * component(r->direction, i);
        towards += normal[i] * (component(p[0], i) - component(r->origin, i));
    }
    if (speed == 0.0)
        return false;
    double t = towards / speed;
    if (!(t >= (double)r->t_min && t <= (double)r->t_max))
        return false;

    int axis = largest(normal);
    struct flat a = to_corner(p[0], r, t, axis);
    struct flat b = to_corner(p[1], r, t, axis);
    struct flat c = to_corner(p[2], r, t, axis);
    double b1 = flat_area(c, a) / normal[axis];
    double b2 = flat_area(a, b) / normal[axis];
    if (!(b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0))
        return false;
    hit->t = (float)t;
    hit->b1 = (float)b1;
    hit->b2 = (float)b2;
    return true;
}

/* The vector that, for a step of (du, dv) along each edge, solves the system
 * for the coordinate whose other one is given: Cramer, component by
 * component. */
static bool solve(double e1, double other1, double e2, double other2,
                  double determinant, float *result)
{
    *result = (float)((e1 * other2 - e2 * other1) / determinant);
    return isfinite(*result);
}

bool triangle_uv_differentials(const vec3 p[3], const vec2 uv[3], vec3 *dp_du,
                               vec3 *dp_dv)
{
    double u1 = (double)uv[1].x - (double)uv[0].x;
    double v1 = (double)uv[1].y - (double)uv[0].y;
    double u2 = (double)uv[2].x - (double)uv[0].x;
    double v2 = (double)uv[2].y - (double)uv[0].y;
    double determinant = u1 * v2 - u2 * v1;
    float u[3], v[3];
    bool found = determinant != 0.0;
    for (int i = 0; i < 3; i++) {
        double e1 = component(p[1], i) - component(p[0], i);
        double e2 = component(p[2], i) - component(p[0], i);
        found = found && solve(e1, v1, e2, v2, determinant, &u[i]);
        found = found && solve(e1, u1, e2, u2, -determinant, &v[i]);
    }
    if (!found)
        return false;
    *dp_du = vec3_make(u[0], u[1], u[2]);
    *dp_dv = vec3_make(v[0], v[1], v[2]);
    return true;
}
