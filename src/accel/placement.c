/* placement.c - see placement.h. */
#include "accel/placement.h"

#include "accel/lanes.h"

static const float largest_norm = 0x1p40f, largest_condition = 0x1p10f;

/* The thickest beam that is of use, as a fraction of the mesh's size. */
static const float thickest = 0x1p-8f;

/* The largest sum of the sizes in a row: how much longer a vector can become,
 * both measured by their largest coordinate. */
static float norm(const float m[4][4])
{
    float largest = 0.0f;
    for (int i = 0; i < 3; i++)
        largest =
            greater(fabsf(m[i][0]) + fabsf(m[i][1]) + fabsf(m[i][2]), largest);
    return largest;
}

static vec3 offset_of(const struct transform *t)
{
    return vec3_make(t->m[0][3], t->m[1][3], t->m[2][3]);
}

static float largest_of(vec3 v)
{
    return greater(fabsf(v.x), greater(fabsf(v.y), fabsf(v.z)));
}

static bool moderate(float x)
{
    return x >= 1.0f / largest_norm && x <= largest_norm;
}

bool placement_make(const struct transform *to_world, uint32_t first_primitive,
                    const aabb *local, struct placement *out)
{
    float forth = norm(to_world->m), back = norm(to_world->inverse);
    float size = largest_of(vec3_sub(local->upper, local->lower));
    float away = greater(largest_of(local->lower), largest_of(local->upper));
    float condition = forth * back;
    float moved = back * largest_of(offset_of(to_world));
    out->to_world = *to_world;
    out->mirrors = transform_mirrors(to_world);
    out->first_primitive = first_primitive;
    out->margin.factor = 0x1p-20f * condition; /* 16 u k */
    out->margin.length = 0x1p-21f * moved;     /* 8 u |A^-1| |m| */
    return moderate(forth) && moderate(back) && moderate(size) &&
           condition <= largest_condition &&
           out->margin.factor * away + out->margin.length <= thickest * size;
}

static vec3 to_local(const struct placement *p, vec3 d)
{
    const float(*m)[4] = p->to_world.inverse;
    return vec3_make(m[0][0] * d.x + m[0][1] * d.y + m[0][2] * d.z,
                     m[1][0] * d.x + m[1][1] * d.y + m[1][2] * d.z,
                     m[2][0] * d.x + m[2][1] * d.y + m[2][2] * d.z);
}

/* The offset goes first, on the side where it is exactly what the corners were
 * moved by. */
ray placement_ray(const struct placement *p, const ray *r)
{
    vec3 from = vec3_sub(r->origin, offset_of(&p->to_world));
    return ray_make(to_local(p, from), to_local(p, r->direction), r->t_min,
                    r->t_max);
}

void placement_corners(const struct placement *p, const vec3 local[3],
                       vec3 world[3])
{
    world[0] = transform_point(&p->to_world, local[0]);
    world[p->mirrors ? 2 : 1] = transform_point(&p->to_world, local[1]);
    world[p->mirrors ? 1 : 2] = transform_point(&p->to_world, local[2]);
}
