/* wide.c - walking through the wide tree; see wide.h. */
#include "accel/wide.h"

#include <stddef.h>

#include "accel/beam.h"
#include "accel/lanes.h"
#include "base/counters.h"
#include "shapes/triangle.h"

//> wide.query: What a walk knows
struct query {
    const struct wide *tree;
    const struct placement *place; /* NULL: the tree is in the world */
    struct beam beam; /* where the tree is; the ray is the world's */
    ray *r;
    leaf_test_fn *test;
    const void *context;
    void *hit;
};

/* A node or leaf waits here with the t at which the beam enters it. Each level
 * leaves at most seven behind. */
struct waiting {
    uint32_t child;
    float t_enter;
};

enum { MOST_WAITING = WIDE_MAX_DEPTH * (WIDE - 1) };
//< wide.query

//> wide.node: Test eight boxes
/* t_enter: where the beam enters each child's box, INFINITY where it misses
 * it. A missing child is missed: its near planes are at +infinity. */
static inline void enter_children(const struct wide_node *restrict n,
                                  const struct query *q,
                                  float t_enter[restrict WIDE])
{
    const struct beam *b = &q->beam;
    const float *near_x = n->planes[b->near_plane[0]];
    const float *near_y = n->planes[b->near_plane[1]];
    const float *near_z = n->planes[b->near_plane[2]];
    const float *far_x = n->planes[b->far_plane[0]];
    const float *far_y = n->planes[b->far_plane[1]];
    const float *far_z = n->planes[b->far_plane[2]];
    const float ix = b->inverse[0], iy = b->inverse[1], iz = b->inverse[2];
    const float ex = b->enter[0], ey = b->enter[1], ez = b->enter[2];
    const float lx = b->leave[0], ly = b->leave[1], lz = b->leave[2];
    const float t_min = q->r->t_min, t_max = q->r->t_max;
    for (int i = 0; i < WIDE; i++) {
        float x0 = multiply_add(near_x[i], ix, ex);
        float y0 = multiply_add(near_y[i], iy, ey);
        float z0 = multiply_add(near_z[i], iz, ez);
        float x1 = multiply_add(far_x[i], ix, lx);
        float y1 = multiply_add(far_y[i], iy, ly);
        float z1 = multiply_add(far_z[i], iz, lz);
        float enter = greater(greater(x0, y0), greater(z0, t_min));
        float leave = lesser(lesser(x1, y1), lesser(z1, t_max));
        t_enter[i] = enter <= leave ? enter : INFINITY;
    }
}
//< wide.node

//> wide.descend: Go to the nearest child, let the others wait
/* The nearest stays in a register; the others are not worth sorting, since
 * most of them are dropped once something is hit. Returns the new end of the
 * stack. */
static inline struct waiting *
descend(const struct query *q, struct waiting *end, struct waiting *nearest)
{
    const struct wide_node *n = &q->tree->nodes[nearest->child];
    float t_enter[WIDE];
    enter_children(n, q, t_enter);
    nearest->t_enter = INFINITY;
    for (int i = 0; i < WIDE; i++) {
        struct waiting child = {n->child[i], t_enter[i]};
        if (!(child.t_enter < INFINITY))
            continue;
        if (nearest->t_enter < INFINITY) {
            bool nearer = child.t_enter < nearest->t_enter;
            *end++ = nearer ? *nearest : child;
            *nearest = nearer ? child : *nearest;
        } else {
            *nearest = child;
        }
    }
    return end;
}
//< wide.descend

//> wide.pack: Test eight triangles
/* perhaps: where a ray may hit each triangle at the earliest, INFINITY where
 * it certainly does not. NaN lanes fail the comparisons.
 *
 * Seen along the ray, a = (ax, ay), b and c are the corners and the ray is the
 * origin. u, v and s, twice the areas that it spans with the edges, must have
 * one sign. A corner that is off by e moves an area by no more than e times
 * the size of the other corner, and e^2; with the products' own rounding,
 * that is less than error. In depth a point of the triangle lies between the
 * corners. */
static inline void try_triangles(const struct wide_pack *restrict p,
                                 const struct query *q,
                                 float perhaps[restrict WIDE])
{
    const struct beam *b = &q->beam;
    const float *px = p->corner[0][b->x], *py = p->corner[0][b->y];
    const float *qx = p->corner[1][b->x], *qy = p->corner[1][b->y];
    const float *rx = p->corner[2][b->x], *ry = p->corner[2][b->y];
    const float *pz = p->corner[0][b->z], *qz = p->corner[1][b->z];
    const float *rz = p->corner[2][b->z];
    const float ox = b->origin[b->x], oy = b->origin[b->y];
    const float oz = b->origin[b->z], scale = b->scale_z;
    const float sx = -b->shear_x, sy = -b->shear_y, width = b->width;
    const float first = q->r->t_min - b->width_t;
    const float last = q->r->t_max + b->width_t;
    for (int i = 0; i < WIDE; i++) {
        float az = pz[i] - oz, bz = qz[i] - oz, cz = rz[i] - oz;
        float ax = multiply_add(sx, az, px[i] - ox);
        float ay = multiply_add(sy, az, py[i] - oy);
        float bx = multiply_add(sx, bz, qx[i] - ox);
        float by = multiply_add(sy, bz, qy[i] - oy);
        float cx = multiply_add(sx, cz, rx[i] - ox);
        float cy = multiply_add(sy, cz, ry[i] - oy);
        float u = multiply_add(cx, by, -(cy * bx));
        float v = multiply_add(ax, cy, -(ay * cx));
        float s = multiply_add(bx, ay, -(by * ax));
        float size = fabsf(ax) + fabsf(ay) + fabsf(bx) + fabsf(by) +
                     (fabsf(cx) + fabsf(cy));
        float error = multiply_add(width, size, width * width);
        float least = lesser(u, lesser(v, s));
        float most = greater(u, greater(v, s));
        float ta = az * scale, tb = bz * scale, tc = cz * scale;
        float nearest = lesser(ta, lesser(tb, tc));
        float farthest = greater(ta, greater(tb, tc));
        int inside = (least >= -error) | (most <= error);
        int in_range = (nearest <= last) & (farthest >= first);
        perhaps[i] = inside & in_range ? nearest : INFINITY;
    }
}
//< wide.pack

//> wide.confirm: Ask exactly
static bool confirm(const struct query *q, const struct wide_pack *p, int lane,
                    bool any)
{
    vec3 corners[3], moved[3];
    struct triangle_hit found;
    for (int i = 0; i < 3; i++)
        corners[i] = vec3_make(p->corner[i][0][lane], p->corner[i][1][lane],
                               p->corner[i][2][lane]);
    if (q->place != NULL)
        placement_corners(q->place, corners, moved);
    if (!triangle_intersect(q->place != NULL ? moved : corners, q->r, &found))
        return false;
    struct nearest hit = {p->primitive[lane], found.t, found.b1, found.b2};
    if (q->place != NULL)
        hit.primitive += q->place->first_primitive;
    if (any)
        return hit.t <= ((const struct nearest *)q->hit)->t;
    return nearest_offer(q->hit, &hit, q->r);
}
//< wide.confirm

//> wide.leaf: Test a leaf
/* What is no triangle is alone in its leaf. */
static bool test_other(const struct query *q, const struct wide_pack *p)
{
    return q->test(q->context, p->primitive[0], 1, q->r, q->hit);
}

static inline bool test_leaf(const struct query *q, uint32_t leaf, bool any)
{
    const struct wide_pack *p = &q->tree->packs[leaf & WIDE_INDEX];
    float perhaps[WIDE];
    bool found = false;
    if (leaf & WIDE_OTHER)
        return test_other(q, p);
    try_triangles(p, q, perhaps);
    for (int i = 0; i < WIDE; i++) {
        if (!(perhaps[i] < INFINITY) || !confirm(q, p, i, any))
            continue;
        if (any)
            return true;
        found = true;
    }
    return found;
}
//< wide.leaf

static inline void count(uint32_t nodes, uint32_t packs)
{
    counters_mine.boxes_tested += (uint64_t)WIDE * nodes;
    counters_mine.leaves_visited += packs;
    counters_mine.primitives_tested += (uint64_t)WIDE * packs;
}

//> wide.walk: Visit leaves from near to far
static inline bool walk(const struct query *q, bool any)
{
    struct waiting stack[MOST_WAITING], *end = stack;
    struct waiting next = {q->tree->root, q->r->t_min};
    uint32_t nodes = 0, packs = 0;
    bool found = false;
    for (;;) {
        if (next.t_enter <= q->r->t_max && next.child & WIDE_LEAF) {
            packs++;
            if (test_leaf(q, next.child, any)) {
                found = true;
                if (any)
                    break;
            }
        } else if (next.t_enter <= q->r->t_max) {
            nodes++;
            end = descend(q, end, &next);
            if (next.t_enter < INFINITY)
                continue;
        }
        if (end == stack)
            break;
        next = *--end;
    }
    count(nodes, packs);
    return found;
}
//< wide.walk

static bool ask_pack(const struct query *q, const struct wide_pack *p, bool any)
{
    bool found = false;
    if (isnan(p->corner[0][0][0]))
        return test_other(q, p);
    for (int i = 0; i < WIDE && !(found && any); i++)
        if (p->primitive[i] != NO_PRIMITIVE && confirm(q, p, i, any))
            found = true;
    return found;
}

static const struct beam_margin no_margin = {0.0f, 0.0f};

/* Every primitive, for a ray that single precision is too narrow for. */
static bool ask_all(const struct query *q, bool any)
{
    bool found = false;
    for (uint32_t k = 0; k < q->tree->pack_count && !(found && any); k++)
        if (ask_pack(q, &q->tree->packs[k], any))
            found = true;
    count(0, q->tree->pack_count);
    return found;
}

static inline bool ask(struct query *q, const ray *seen,
                       struct beam_margin margin, bool any)
{
    if (q->tree->pack_count == 0)
        return false;
    return beam_make(seen, &q->tree->box, margin, &q->beam) ? walk(q, any)
                                                            : ask_all(q, any);
}

bool wide_nearest(const struct wide *tree, ray *r, leaf_test_fn *test,
                  const void *context, void *hit)
{
    struct query q = {
        .tree = tree, .r = r, .test = test, .context = context, .hit = hit};
    return ask(&q, r, no_margin, false);
}

bool wide_any(const struct wide *tree, ray *r, leaf_test_fn *test,
              const void *context, void *hit)
{
    struct query q = {
        .tree = tree, .r = r, .test = test, .context = context, .hit = hit};
    return ask(&q, r, no_margin, true);
}

//> wide.placed: Walk through a tree that is put somewhere else
bool wide_nearest_placed(const struct wide *tree, const struct placement *place,
                         ray *r, void *hit)
{
    struct query q = {.tree = tree, .place = place, .r = r, .hit = hit};
    ray seen = placement_ray(place, r);
    return ask(&q, &seen, place->margin, false);
}

bool wide_any_placed(const struct wide *tree, const struct placement *place,
                     ray *r, void *hit)
{
    struct query q = {.tree = tree, .place = place, .r = r, .hit = hit};
    ray seen = placement_ray(place, r);
    return ask(&q, &seen, place->margin, true);
}
//< wide.placed
