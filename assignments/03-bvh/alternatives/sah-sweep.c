/* bvh.c - the surface area heuristic at every border, and a recursive walk.
 *
 * Builder: sorts along each axis and sweeps over all n - 1 borders, in
 * double. Walk: recursion, which the tree's depth bounds. */
#include "accel/bvh.h"

#include <stdlib.h>
#include <string.h>

#include "accel/aabb.h"
#include "base/memory.h"

struct item {
    double centre[3];
    aabb box;
    uint32_t primitive;
};

struct work {
    struct item *items, *best; /* as they stand, and in the best order */
    double *area;              /* of the last i items */
    struct bvh_node *nodes;
    uint32_t used;
};

/* Ties go by number, so that the order is one and the same everywhere. */
static int compare(const struct item *a, const struct item *b, int axis)
{
    if (a->centre[axis] != b->centre[axis])
        return a->centre[axis] < b->centre[axis] ? -1 : 1;
    return a->primitive < b->primitive ? -1 : a->primitive > b->primitive;
}

static int by_x(const void *a, const void *b)
{
    return compare(a, b, 0);
}

static int by_y(const void *a, const void *b)
{
    return compare(a, b, 1);
}

static int by_z(const void *a, const void *b)
{
    return compare(a, b, 2);
}

static int (*const by_axis[3])(const void *, const void *) = {by_x, by_y, by_z};

static double area_of(aabb b)
{
    double x = (double)b.upper.x - b.lower.x, y = (double)b.upper.y - b.lower.y,
           z = (double)b.upper.z - b.lower.z;
    return x * y + y * z + z * x;
}

/* How many items go left at the best border, and what that costs. */
static uint32_t sweep(const struct item *items, uint32_t count, double *area,
                      double *cost)
{
    aabb box = aabb_empty();
    uint32_t best = 0;
    for (uint32_t i = count - 1; i > 0; i--) {
        box = aabb_union(box, items[i].box);
        area[i] = area_of(box);
    }
    box = aabb_empty();
    for (uint32_t i = 1; i < count; i++) {
        box = aabb_union(box, items[i - 1].box);
        double c = area_of(box) * i + area[i] * (count - i);
        if (c < *cost) {
            *cost = c;
            best = i;
        }
    }
    return best;
}

static int halvings(uint32_t count)
{
    int n = 0;
    for (; count > 1; count = (count + 1) / 2)
        n++;
    return n;
}

static void build(struct work *w, uint32_t node, uint32_t first, uint32_t count,
                  int depth)
{
    struct item *items = w->items + first;
    aabb box = aabb_empty();
    for (uint32_t i = 0; i < count; i++)
        box = aabb_union(box, items[i].box);
    w->nodes[node] = (struct bvh_node){box, first, count};
    if (count == 1)
        return;

    double cost = HUGE_VAL;
    uint32_t left = 0;
    for (int axis = 0; axis < 3; axis++) {
        double before = cost;
        qsort(items, count, sizeof *items, by_axis[axis]);
        uint32_t border = sweep(items, count, w->area, &cost);
        if (cost < before) {
            left = border;
            memcpy(w->best, items, count * sizeof *items);
        }
    }
    memcpy(items, w->best, count * sizeof *items);
    if (depth + halvings(count) >= BVH_MAX_DEPTH)
        left = count / 2;
    else if (count <= 4 && area_of(box) * count <= cost + 2 * area_of(box))
        return;

    uint32_t child = w->used;
    w->used += 2;
    w->nodes[node].first = child;
    w->nodes[node].count = 0;
    build(w, child, first, left, depth + 1);
    build(w, child + 1, first + left, count - left, depth + 1);
}

uint32_t bvh_build(const aabb boxes[], uint32_t primitive_count,
                   struct bvh_node nodes[], uint32_t order[])
{
    uint32_t n = primitive_count;
    if (n == 0)
        return 0;
    struct work w = {mem_alloc(n, sizeof *w.items),
                     mem_alloc(n, sizeof *w.best), mem_alloc(n, sizeof *w.area),
                     nodes, 1};
    for (uint32_t i = 0; i < n; i++) {
        w.items[i].box = boxes[i];
        w.items[i].primitive = i;
        for (int axis = 0; axis < 3; axis++)
            w.items[i].centre[axis] =
                0.5 * ((double)vec3_axis(boxes[i].lower, axis) +
                       vec3_axis(boxes[i].upper, axis));
    }
    build(&w, 0, 0, n, 1);
    for (uint32_t i = 0; i < n; i++)
        order[i] = w.items[i].primitive;
    mem_free(w.items);
    mem_free(w.best);
    mem_free(w.area);
    return w.used;
}

struct query {
    const struct bvh_node *nodes;
    ray *r;
    leaf_test_fn *test;
    const void *context;
    void *hit;
    bool any;
};

/* Visits a node whose box is known to be entered. */
static bool visit(const struct query *q, const struct bvh_node *node)
{
    if (node->count > 0)
        return q->test(q->context, node->first, node->count, q->r, q->hit);
    const struct bvh_node *a = &q->nodes[node->first], *b = a + 1;
    float enter_a, enter_b, leave;
    bool in_a = aabb_test(&a->box, q->r, &enter_a, &leave);
    bool in_b = aabb_test(&b->box, q->r, &enter_b, &leave);
    if (in_a && in_b && enter_b < enter_a) {
        const struct bvh_node *c = a;
        float enter = enter_a;
        a = b;
        b = c;
        enter_a = enter_b;
        enter_b = enter;
    }
    bool found = in_a && visit(q, a);
    if (in_b && !(found && q->any) && enter_b <= q->r->t_max)
        found |= visit(q, b);
    return found;
}

static bool start(const struct bvh *tree, const struct query *q)
{
    float enter, leave;
    return tree->node_count > 0 &&
           aabb_test(&tree->nodes[0].box, q->r, &enter, &leave) &&
           visit(q, &tree->nodes[0]);
}

bool bvh_nearest(const struct bvh *tree, ray *r, leaf_test_fn *test,
                 const void *context, void *hit)
{
    struct query q = {tree->nodes, r, test, context, hit, false};
    return start(tree, &q);
}

bool bvh_any(const struct bvh *tree, ray *r, leaf_test_fn *test,
             const void *context, void *hit)
{
    struct query q = {tree->nodes, r, test, context, hit, true};
    return start(tree, &q);
}
