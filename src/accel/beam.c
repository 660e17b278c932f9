/* beam.c - see beam.h. */
#include "accel/beam.h"

#include "accel/lanes.h"

static const float box_width = 0x1p-21f, triangle_width = 0x1p-20f;

/* How far from the axis' planes a direction must at least lead, as a fraction
 * of its largest component. That much moves no point of the ray by more than
 * 2^-40 R, and no product overflows. */
static const float least_slope = 0x1p-40f;

/* A beam is made for every ray, and in which direction it goes a processor
 * cannot guess: so what depends on that is computed, without a branch. */
static int largest_axis(vec3 v)
{
    vec3 size = vec3_abs(v);
    int second = size.y > size.x, third = size.z > greater(size.x, size.y);
    return 2 * third + (second & !third);
}

static float largest(vec3 v)
{
    return greater(v.x, greater(v.y, v.z));
}

static void make_slab(struct beam *b, int axis, float origin, float inverse,
                      float steepest, float width)
{
    float size = lesser(fabsf(inverse), steepest), spread = size * width;
    int backwards = signbit(inverse) != 0;
    float to_origin = -(origin * copysignf(size, inverse));
    b->near_plane[axis] = 2 * axis + backwards;
    b->far_plane[axis] = 2 * axis + 1 - backwards;
    b->inverse[axis] = copysignf(size, inverse);
    b->enter[axis] = to_origin - spread;
    b->leave[axis] = to_origin + spread;
    b->origin[axis] = origin;
}

/* Along z the slab's inverse is that of the ray: it is the least of the three,
 * so that it was not cut. */
static void make_shear(struct beam *b, vec3 direction, float width)
{
    static const int next_axis[3] = {1, 2, 0};
    const float along[3] = {direction.x, direction.y, direction.z};
    b->x = next_axis[b->z];
    b->y = next_axis[b->x];
    b->scale_z = b->inverse[b->z];
    b->shear_x = along[b->x] * b->scale_z;
    b->shear_y = along[b->y] * b->scale_z;
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
    vec3 size = vec3_abs(inverse);
    float least = lesser(size.x, lesser(size.y, size.z));
    if (!(far <= 0x1p60f && far * least <= 0x1p84f))
        return false;
    float steepest = least / least_slope;
    float more = margin.factor * far + margin.length;
    float width = box_width * far + more;
    make_slab(out, 0, o.x, inverse.x, steepest, width);
    make_slab(out, 1, o.y, inverse.y, steepest, width);
    make_slab(out, 2, o.z, inverse.z, steepest, width);
    make_shear(out, r->direction, triangle_width * reach + more);
    return true;
}
