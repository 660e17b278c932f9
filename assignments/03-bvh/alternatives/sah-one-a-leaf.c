/* bvh.c - every primitive a leaf of its own, level by level.
 *
 * Builder: a queue, first in, first out, of nodes to split; 32 bins over the
 * node's box, not over its centroids, along all axes. Walk: children in the
 * order of the ray's direction along the axis that parts them most. */
#include "accel/bvh.h"

#include <float.h>

#include "accel/aabb.h"

enum { BINS = 32 };

struct bins {
    aabb box[BINS];
    uint32_t count[BINS];
};

static float centre(const aabb *box, int axis)
{
    return 0.5f * vec3_axis(box->lower, axis) +
           0.5f * vec3_axis(box->upper, axis);
}

/* The bin of a box: fractions of the node's box, in double against rounding
 * where the node is far from the origin. */
static int bin(const aabb *node, const aabb *box, int axis)
{
    double lower = vec3_axis(node->lower, axis);
    double width = vec3_axis(node->upper, axis) - lower;
    double place = (centre(box, axis) - lower) / width * BINS;
    if (!(place > 0.0)) /* a node without width, too */
        return 0;
    return place < BINS ? (int)place : BINS - 1;
}

static void fill(struct bins *bins, const aabb boxes[], const uint32_t order[],
                 const struct bvh_node *node, int axis)
{
    for (int i = 0; i < BINS; i++) {
        bins->box[i] = aabb_empty();
        bins->count[i] = 0;
    }
    for (uint32_t i = node->first; i < node->first + node->count; i++) {
        const aabb *box = &boxes[order[i]];
        int k = bin(&node->box, box, axis);
        bins->box[k] = aabb_union(bins->box[k], *box);
        bins->count[k]++;
    }
}

/* The last bin on the left of the best border, or -1; *least is lowered. */
static int best_border(const struct bins *bins, uint32_t total, double *least)
{
    double right[BINS];
    aabb box = aabb_empty();
    uint32_t count = 0;
    int best = -1;
    for (int i = BINS - 1; i > 0; i--) {
        box = aabb_union(box, bins->box[i]);
        count += bins->count[i];
        right[i] = (double)aabb_area(box) * count;
    }
    box = aabb_empty();
    count = 0;
    for (int i = 0; i < BINS - 1; i++) {
        box = aabb_union(box, bins->box[i]);
        count += bins->count[i];
        double cost = (double)aabb_area(box) * count + right[i + 1];
        if (count > 0 && count < total && cost < *least) {
            *least = cost;
            best = i;
        }
    }
    return best;
}

static uint32_t divide(const aabb boxes[], uint32_t order[],
                       const struct bvh_node *node, int axis, int border)
{
    uint32_t left = node->first, end = node->first + node->count;
    for (uint32_t i = left; i < end; i++) {
        uint32_t primitive = order[i];
        if (bin(&node->box, &boxes[primitive], axis) <= border) {
            order[i] = order[left];
            order[left++] = primitive;
        }
    }
    return left - node->first;
}

static uint32_t split(const aabb boxes[], uint32_t order[],
                      const struct bvh_node *node)
{
    double least = DBL_MAX;
    int axis = 0, border = -1;
    for (int a = 0; a < 3; a++) {
        struct bins bins;
        fill(&bins, boxes, order, node, a);
        int b = best_border(&bins, node->count, &least);
        if (b >= 0) {
            axis = a;
            border = b;
        }
    }
    if (border < 0)
        return node->count / 2;
    return divide(boxes, order, node, axis, border);
}

static void set_leaf(struct bvh_node *node, const aabb boxes[],
                     const uint32_t order[], uint32_t first, uint32_t count)
{
    node->first = first;
    node->count = count;
    node->box = boxes[order[first]];
    for (uint32_t i = first + 1; i < first + count; i++)
        node->box = aabb_union(node->box, boxes[order[i]]);
}

/* The nodes themselves are the queue: what is behind `next` is not split yet.
 * A level ends where the next one began to be written. From level 32 on,
 * halving brings 2^32 primitives down to one before level 64. */
uint32_t bvh_build(const aabb boxes[], uint32_t primitive_count,
                   struct bvh_node nodes[], uint32_t order[])
{
    if (primitive_count == 0)
        return 0;
    for (uint32_t i = 0; i < primitive_count; i++)
        order[i] = i;
    set_leaf(&nodes[0], boxes, order, 0, primitive_count);
    uint32_t used = 1, level_end = 1;
    int level = 1;
    for (uint32_t next = 0; next < used; next++) {
        if (next == level_end) {
            level++;
            level_end = used;
        }
        struct bvh_node *node = &nodes[next];
        if (node->count == 1)
            continue;
        uint32_t left =
            level < 32 ? split(boxes, order, node) : node->count / 2;
        set_leaf(&nodes[used], boxes, order, node->first, left);
        set_leaf(&nodes[used + 1], boxes, order, node->first + left,
                 node->count - left);
        node->first = used;
        node->count = 0;
        used += 2;
    }
    return used;
}

/* Whether the second child comes first, by the axis on which the two centres
 * differ most. */
static bool turned(const struct bvh_node *pair, const ray *r)
{
    float most = -1.0f, along = 0.0f;
    for (int axis = 0; axis < 3; axis++) {
        float gap = centre(&pair[1].box, axis) - centre(&pair[0].box, axis);
        if (fabsf(gap) > most) {
            most = fabsf(gap);
            along = gap * vec3_axis(r->direction, axis);
        }
    }
    return along < 0.0f;
}

struct walk {
    const struct bvh_node *nodes;
    leaf_test_fn *test;
    const void *context;
    void *hit;
    bool any, found;
};

static void descend(struct walk *w, uint32_t index, ray *r)
{
    const struct bvh_node *node = &w->nodes[index];
    float enter, leave;
    if ((w->any && w->found) || !aabb_test(&node->box, r, &enter, &leave))
        return;
    if (node->count > 0) {
        if (w->test(w->context, node->first, node->count, r, w->hit))
            w->found = true;
        return;
    }
    uint32_t second = turned(&w->nodes[node->first], r);
    descend(w, node->first + second, r);
    descend(w, node->first + 1 - second, r);
}

static bool walk(const struct bvh *tree, ray *r, leaf_test_fn *test,
                 const void *context, void *hit, bool any)
{
    struct walk w = {tree->nodes, test, context, hit, any, false};
    if (tree->node_count > 0)
        descend(&w, 0, r);
    return w.found;
}

bool bvh_nearest(const struct bvh *tree, ray *r, leaf_test_fn *test,
                 const void *context, void *hit)
{
    return walk(tree, r, test, context, hit, false);
}

bool bvh_any(const struct bvh *tree, ray *r, leaf_test_fn *test,
             const void *context, void *hit)
{
    return walk(tree, r, test, context, hit, true);
}
