/* bvh.c - twelve bins along the widest axis, leaves as the heuristic says.
 *
 * Builder: only the axis along which the centroids spread most; a leaf where
 * the heuristic finds no better split, up to BVH_MAX_LEAF. Where it fails,
 * the list is halved. Walk: one stack of nodes with the t at which each is
 * entered; the root waits on it like all others. */
#include "accel/bvh.h"

#include "accel/aabb.h"

#define BINS 12

typedef struct {
    const aabb *boxes;
    struct bvh_node *nodes;
    uint32_t *order;
    uint32_t next;
} Builder;

typedef struct {
    aabb box;
    uint32_t n;
} Bin;

static int pick_axis(vec3 extent)
{
    int axis = 0;
    if (extent.y > extent.x)
        axis = 1;
    if (extent.z > vec3_axis(extent, axis))
        axis = 2;
    return axis;
}

static int bin_index(float c, float lo, float extent)
{
    int k = (int)(BINS * ((c - lo) / extent));
    if (k < 0)
        k = 0;
    if (k > BINS - 1)
        k = BINS - 1;
    return k;
}

/* Returns the number of primitives for the left child, 0 for a leaf. */
static uint32_t split(Builder *b, uint32_t first, uint32_t n, aabb box)
{
    aabb centroids = aabb_empty();
    for (uint32_t i = first; i < first + n; i++)
        centroids =
            aabb_include(centroids, aabb_centroid(b->boxes[b->order[i]]));
    vec3 extent = vec3_sub(centroids.upper, centroids.lower);
    int axis = pick_axis(extent);
    float width = vec3_axis(extent, axis),
          lo = vec3_axis(centroids.lower, axis);
    if (!(width > 0))
        return n > BVH_MAX_LEAF ? n / 2 : 0;

    Bin bins[BINS];
    for (int k = 0; k < BINS; k++) {
        bins[k].box = aabb_empty();
        bins[k].n = 0;
    }
    for (uint32_t i = first; i < first + n; i++) {
        aabb p = b->boxes[b->order[i]];
        int k = bin_index(vec3_axis(aabb_centroid(p), axis), lo, width);
        bins[k].box = aabb_union(bins[k].box, p);
        bins[k].n++;
    }

    int best = -1;
    float best_cost = INFINITY;
    for (int cut = 0; cut < BINS - 1; cut++) {
        aabb l = aabb_empty(), r = aabb_empty();
        uint32_t nl = 0, nr = 0;
        for (int k = 0; k <= cut; k++) {
            l = aabb_union(l, bins[k].box);
            nl += bins[k].n;
        }
        for (int k = cut + 1; k < BINS; k++) {
            r = aabb_union(r, bins[k].box);
            nr += bins[k].n;
        }
        float cost = aabb_area(l) * (float)nl + aabb_area(r) * (float)nr;
        if (nl > 0 && nr > 0 && cost < best_cost) {
            best_cost = cost;
            best = cut;
        }
    }
    if (best < 0)
        return n > BVH_MAX_LEAF ? n / 2 : 0;
    float area = aabb_area(box);
    if (n <= BVH_MAX_LEAF && area * (float)n <= best_cost + 1.5f * area)
        return 0;

    uint32_t left = first;
    for (uint32_t i = first; i < first + n; i++) {
        uint32_t p = b->order[i];
        float c = vec3_axis(aabb_centroid(b->boxes[p]), axis);
        if (bin_index(c, lo, width) <= best) {
            b->order[i] = b->order[left];
            b->order[left++] = p;
        }
    }
    return left - first;
}

/* From here on halving alone must do: 2^32 primitives need 32 levels. */
#define ONLY_HALVES (BVH_MAX_DEPTH - 32)

static void grow(Builder *b, uint32_t node, uint32_t first, uint32_t n,
                 int depth)
{
    aabb box = aabb_empty();
    for (uint32_t i = first; i < first + n; i++)
        box = aabb_union(box, b->boxes[b->order[i]]);
    b->nodes[node].box = box;
    b->nodes[node].first = first;
    b->nodes[node].count = n;
    if (n < 2)
        return;
    uint32_t left = depth < ONLY_HALVES ? split(b, first, n, box)
                    : n > 4             ? n / 2
                                        : 0;
    if (left == 0)
        return;
    uint32_t child = b->next;
    b->next += 2;
    b->nodes[node].first = child;
    b->nodes[node].count = 0;
    grow(b, child, first, left, depth + 1);
    grow(b, child + 1, first + left, n - left, depth + 1);
}

uint32_t bvh_build(const aabb boxes[], uint32_t primitive_count,
                   struct bvh_node nodes[], uint32_t order[])
{
    Builder b = {boxes, nodes, order, 1};
    if (primitive_count == 0)
        return 0;
    for (uint32_t i = 0; i < primitive_count; i++)
        order[i] = i;
    grow(&b, 0, 0, primitive_count, 1);
    return b.next;
}

typedef struct {
    const struct bvh_node *node;
    float t;
} Entry;

/* Puts what the ray enters of a node's children into in[], the nearer first;
 * returns how many. */
static int entered(const struct bvh *tree, const struct bvh_node *node,
                   const ray *r, Entry in[2])
{
    int n = 0;
    for (uint32_t k = 0; k < 2; k++) {
        float t, leave;
        const struct bvh_node *child = &tree->nodes[node->first + k];
        if (aabb_test(&child->box, r, &t, &leave))
            in[n++] = (Entry){child, t};
    }
    if (n == 2 && in[1].t < in[0].t) {
        Entry e = in[0];
        in[0] = in[1];
        in[1] = e;
    }
    return n;
}

static bool traverse(const struct bvh *tree, ray *r, leaf_test_fn *test,
                     const void *context, void *hit, bool any)
{
    Entry stack[BVH_MAX_DEPTH + 1];
    int top = 0;
    bool found = false;
    float t, leave;
    if (tree->node_count == 0 || !aabb_test(&tree->nodes[0].box, r, &t, &leave))
        return false;
    stack[top++] = (Entry){&tree->nodes[0], t};
    while (top > 0) {
        Entry e = stack[--top];
        if (e.t > r->t_max)
            continue;
        if (e.node->count > 0) {
            if (test(context, e.node->first, e.node->count, r, hit)) {
                found = true;
                if (any)
                    return true;
            }
            continue;
        }
        Entry in[2];
        int n = entered(tree, e.node, r, in);
        while (n-- > 0)
            stack[top++] = in[n];
    }
    return found;
}

bool bvh_nearest(const struct bvh *tree, ray *r, leaf_test_fn *test,
                 const void *context, void *hit)
{
    return traverse(tree, r, test, context, hit, false);
}

bool bvh_any(const struct bvh *tree, ray *r, leaf_test_fn *test,
             const void *context, void *hit)
{
    return traverse(tree, r, test, context, hit, true);
}
