/* refraction.c - Snell's law with angles, as in school, in double precision. */
#include "materials/refraction.h"

static double length3(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* A unit direction at an angle from `up`, leaning towards `side`. */
static vec3 at_angle(double angle, const double up[3], const double side[3])
{
    double c = cos(angle), s = sin(angle);
    return vec3_make((float)(c * up[0] + s * side[0]),
                     (float)(c * up[1] + s * side[1]),
                     (float)(c * up[2] + s * side[2]));
}

bool refraction_direction(vec3 normal, vec3 outgoing,
                          float eta_inside_over_outside, vec3 *incoming)
{
    const double n[3] = {normal.x, normal.y, normal.z};
    const double o[3] = {outgoing.x, outgoing.y, outgoing.z};
    double dot = n[0] * o[0] + n[1] * o[1] + n[2] * o[2];
    double sign = dot >= 0.0 ? 1.0 : -1.0;
    double here = dot >= 0.0 ? 1.0 : (double)eta_inside_over_outside;
    double there = dot >= 0.0 ? (double)eta_inside_over_outside : 1.0;

    double up[3], down[3], side[3];
    for (int i = 0; i < 3; i++) {
        up[i] = sign * n[i];
        down[i] = -up[i];
        side[i] = dot * n[i] - o[i]; /* to the other side of the normal */
    }
    double sine = length3(side);
    for (int i = 0; i < 3; i++)
        side[i] = sine > 0.0 ? side[i] / sine : 0.0;

    double angle = atan2(sine, fabs(dot));
    double sine_there = here / there * sin(angle);
    if (sine_there > 1.0) {
        *incoming = at_angle(angle, up, side);
        return false;
    }
    *incoming = at_angle(asin(sine_there), down, side);
    return true;
}
