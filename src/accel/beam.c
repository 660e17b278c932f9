/* beam.c - see beam.h. */
#include "accel/beam.h"

#include "accel/lanes.h"

static const float box_width = 0x1p-21f, triangle_width = 0x1p-20f;

/* How far from the axis' planes a direction must at least lead, as a fraction
 * of its largest component. That much moves no point of the ray by more than
 * 2^-40 R, and no product overflows. */
static const float least_slope = 0x1p-40f;

static int largest_axis(vec3 v)
{
    vec3 size = vec3_abs(v);
    if (size.x >= size.y && size.x >= size.z)
        return 0;
    return size.y >= size.z ? 1 : 2;
}

static float largest(vec3 v)
{
    return greater(v.x, greater(v.y, v.z));
}

static void make_slab(struct beam *b, int axis, float origin, float inverse,
                      float steepest, float width)
{
    if (!(fabsf(inverse) <= steepest))
        inverse = copysignf(steepest, inverse);
    bool backwards = signbit(inverse);
    float spread = fabsf(inverse) * width;
    b->near_plane[axis] = 2 * axis + backwards;
    b->far_plane[axis] = 2 * axis + !backwards;
    b->inverse[axis] = inverse;
    b->enter[axis] = -(origin * inverse) - spread;
    b->leave[axis] = -(origin * inverse) + spread;
    b->origin[axis] = origin;
}

static void make_shear(struct beam *b, const ray *r, float width)
{
    b->x = (b->z + 1) % 3;
    b->y = (b->z + 2) % 3;
    b->scale_z = vec3_axis(r->inverse_direction, b->z);
    b->shear_x = vec3_axis(r->direction, b->x) * b->scale_z;
    b->shear_y = vec3_axis(r->direction, b->y) * b->scale_z;
    b->width = width;
    b->width_t = width * fabsf(b->scale_z);
}

bool beam_make(const ray *r, const aabb *box, struct beam_margin margin,
               struct beam *out)
{
    vec3 o = r->origin, inverse = r->inverse_direction;
    float reach = greater(largest(vec3_sub(box->upper, o)),
                          largest(vec3_sub(o, box->lower)));
    float far = reach + largest(vec3_abs(o));
    out->z = largest_axis(r->direction);
    float least = fabsf(vec3_axis(inverse, out->z));
    if (!(far <= 0x1p60f && far * least <= 0x1p84f))
        return false;
    float steepest = least / least_slope;
    float more = margin.factor * far + margin.length;
    float width = box_width * far + more;
    make_slab(out, 0, o.x, inverse.x, steepest, width);
    make_slab(out, 1, o.y, inverse.y, steepest, width);
    make_slab(out, 2, o.z, inverse.z, steepest, width);
    make_shear(out, r, triangle_width * reach + more);
    return true;
}
