/* bvh.c - assignment 03: a tree of boxes over many primitives.
 *
 * The contract is in bvh.h. */
#include "accel/bvh.h"

#include <assert.h>
#include <stddef.h>

#include "accel/aabb.h"
#include "base/todo.h"

//> bvh.build: Build the tree
#ifndef TODO_bvh_build
//> bvh.build.state: What the builder knows
/* Costs of the surface area heuristic, in units of one box test. A ratio near
 * one is what measurements of triangle meshes give; only the ratio matters. */
static const float cost_of_box = 1.0f, cost_of_primitive = 1.0f;

enum { BIN_COUNT = 16, LEAF_TARGET = 4 };

struct builder {
    const aabb *boxes;
    struct bvh_node *nodes;
    uint32_t node_count;
    uint32_t *order;
};

static float centroid_along(const struct builder *b, uint32_t primitive,
                            int axis)
{
    return vec3_axis(aabb_centroid(b->boxes[primitive]), axis);
}
//< bvh.build.state

//> bvh.build.bins: Sort centroids into bins along one axis
struct bin {
    aabb box;
    uint32_t count;
};

/* Which bin holds a centroid. The same expression bins and partitions, so the
 * counts that the cost was made from are the counts that one gets. */
static int bin_of(float centroid, float lower, float scale)
{
    int i = (int)((centroid - lower) * scale);
    return i < BIN_COUNT ? i : BIN_COUNT - 1;
}

static void fill_bins(const struct builder *b, const struct bvh_node *node,
                      int axis, float lower, float scale,
                      struct bin bins[BIN_COUNT])
{
    for (int i = 0; i < BIN_COUNT; i++) {
        bins[i].box = aabb_empty();
        bins[i].count = 0;
    }
    for (uint32_t i = node->first; i < node->first + node->count; i++) {
        uint32_t primitive = b->order[i];
        float c = centroid_along(b, primitive, axis);
        struct bin *bin = &bins[bin_of(c, lower, scale)];
        bin->box = aabb_union(bin->box, b->boxes[primitive]);
        bin->count++;
    }
}
//< bvh.build.bins

//> bvh.build.sweep: Find the cheapest border between two bins
/* cost[i]: area times count of the bins 0 .. i. */
static void sweep_from_left(const struct bin bins[BIN_COUNT],
                            float cost[BIN_COUNT])
{
    aabb box = aabb_empty();
    uint32_t count = 0;
    for (int i = 0; i < BIN_COUNT; i++) {
        box = aabb_union(box, bins[i].box);
        count += bins[i].count;
        cost[i] = aabb_area(box) * (float)count;
    }
}

/* The border with the least area times count on its two sides; the last bin
 * on the left is returned, or -1 if all primitives are in one bin. */
static int cheapest_border(const struct bin bins[BIN_COUNT], float *least)
{
    float left_cost[BIN_COUNT];
    sweep_from_left(bins, left_cost);
    aabb box = aabb_empty();
    uint32_t right = 0, total = 0;
    int best = -1;
    for (int i = 0; i < BIN_COUNT; i++)
        total += bins[i].count;
    for (int i = BIN_COUNT - 1; i > 0; i--) {
        box = aabb_union(box, bins[i].box);
        right += bins[i].count;
        float cost = left_cost[i - 1] + aabb_area(box) * (float)right;
        if (right > 0 && right < total && cost < *least) {
            *least = cost;
            best = i - 1;
        }
    }
    return best;
}
//< bvh.build.sweep

//> bvh.build.choose: Choose the split by the surface area heuristic
static aabb centroid_bounds(const struct builder *b,
                            const struct bvh_node *node)
{
    aabb bounds = aabb_empty();
    for (uint32_t i = node->first; i < node->first + node->count; i++)
        bounds = aabb_include(bounds, aabb_centroid(b->boxes[b->order[i]]));
    return bounds;
}

struct choice {
    int axis, last_left_bin; /* last_left_bin < 0: no split */
    float lower, scale, cost;
};

static struct choice choose_split(const struct builder *b,
                                  const struct bvh_node *node)
{
    struct choice best = {0, -1, 0.0f, 0.0f, INFINITY};
    aabb bounds = centroid_bounds(b, node);
    for (int axis = 0; axis < 3; axis++) {
        struct bin bins[BIN_COUNT];
        float lower = vec3_axis(bounds.lower, axis);
        float scale = BIN_COUNT / (vec3_axis(bounds.upper, axis) - lower);
        if (!(scale > 0.0f && isfinite(scale)))
            continue; /* no extent, or too little or too much to divide by */
        fill_bins(b, node, axis, lower, scale, bins);
        float cost = best.cost;
        int border = cheapest_border(bins, &cost);
        if (border >= 0)
            best = (struct choice){axis, border, lower, scale, cost};
    }
    return best;
}
//< bvh.build.choose

//> bvh.build.partition: Move the left primitives to the front
static uint32_t partition(const struct builder *b, const struct bvh_node *node,
                          const struct choice *choice)
{
    uint32_t left = node->first, right = node->first + node->count;
    while (left < right) {
        float c = centroid_along(b, b->order[left], choice->axis);
        if (bin_of(c, choice->lower, choice->scale) <= choice->last_left_bin) {
            left++;
        } else {
            uint32_t swap = b->order[left];
            b->order[left] = b->order[--right];
            b->order[right] = swap;
        }
    }
    return left - node->first;
}
//< bvh.build.partition

//> bvh.build.split: Split a node, or leave it a leaf
/* The number of levels that halving needs to bring count down to one. */
static int levels_needed(uint32_t count)
{
    int levels = 0;
    while (count > 1) {
        count -= count / 2;
        levels++;
    }
    return levels;
}

static bool leaf_is_cheaper(const struct bvh_node *node, float split_cost)
{
    float split = 2.0f * cost_of_box * aabb_area(node->box) +
                  cost_of_primitive * split_cost;
    float leaf = cost_of_primitive * aabb_area(node->box) * (float)node->count;
    return node->count <= LEAF_TARGET && leaf <= split;
}

/* How many primitives go left; 0 keeps the leaf. Halving the list as it
 * stands is the way out when centroids coincide, and when the levels that are
 * left would otherwise not do. */
static uint32_t split_primitives(const struct builder *b,
                                 const struct bvh_node *node, int depth)
{
    if (node->count == 1)
        return 0;
    if (depth + levels_needed(node->count) >= BVH_MAX_DEPTH)
        return node->count / 2;
    struct choice choice = choose_split(b, node);
    if (choice.last_left_bin < 0)
        return node->count <= LEAF_TARGET ? 0 : node->count / 2;
    if (leaf_is_cheaper(node, choice.cost))
        return 0;
    return partition(b, node, &choice);
}

static aabb bounds_of(const struct builder *b, uint32_t first, uint32_t count)
{
    aabb bounds = aabb_empty();
    for (uint32_t i = first; i < first + count; i++)
        bounds = aabb_union(bounds, b->boxes[b->order[i]]);
    return bounds;
}

static void make_leaf(struct builder *b, uint32_t node, uint32_t first,
                      uint32_t count)
{
    b->nodes[node].box = bounds_of(b, first, count);
    b->nodes[node].first = first;
    b->nodes[node].count = count;
}

static void split_node(struct builder *b, uint32_t index, int depth)
{
    struct bvh_node *node = &b->nodes[index];
    uint32_t first = node->first, count = node->count;
    uint32_t left = split_primitives(b, node, depth);
    if (left == 0)
        return;
    uint32_t children = b->node_count;
    b->node_count += 2;
    make_leaf(b, children, first, left);
    make_leaf(b, children + 1, first + left, count - left);
    node->first = children;
    node->count = 0;
    split_node(b, children, depth + 1);
    split_node(b, children + 1, depth + 1);
}
//< bvh.build.split
#endif

uint32_t bvh_build(const aabb boxes[], uint32_t primitive_count,
                   struct bvh_node nodes[], uint32_t order[])
{
    if (primitive_count == 0)
        return 0;
    for (uint32_t i = 0; i < primitive_count; i++)
        order[i] = i;
#ifndef TODO_bvh_build
    struct builder b = {boxes, nodes, 1, order};
    make_leaf(&b, 0, 0, primitive_count);
    split_node(&b, 0, 1);
    return b.node_count;
#else
    /* TODO(bvh_build): make the root a leaf of everything, then split leaves
     * until they are small. Until then the one leaf makes every ray test
     * every primitive. */
    TODO_WARN("03 bvh", "testing every triangle");
    nodes[0].box = boxes[0];
    for (uint32_t i = 1; i < primitive_count; i++)
        nodes[0].box = aabb_union(nodes[0].box, boxes[i]);
    nodes[0].first = 0;
    nodes[0].count = primitive_count;
    return 1;
#endif
}
//< bvh.build

//> bvh.traverse: Walk through the tree
#ifndef TODO_bvh_traverse
//> bvh.traverse.stack: What still has to be visited
/* A node waits here with the t at which the ray enters it, so that it can be
 * dropped when something nearer was found in the meantime. At most one node a
 * level waits. */
struct waiting {
    uint32_t node;
    float t_enter;
};

struct stack {
    struct waiting entries[BVH_MAX_DEPTH];
    int size;
};

static void push(struct stack *s, uint32_t node, float t_enter)
{
    assert(s->size < BVH_MAX_DEPTH);
    s->entries[s->size].node = node;
    s->entries[s->size].t_enter = t_enter;
    s->size++;
}

/* The next node that begins before t_max, or false. */
static bool pop(struct stack *s, float t_max, uint32_t *node)
{
    while (s->size > 0) {
        struct waiting w = s->entries[--s->size];
        if (w.t_enter <= t_max) {
            *node = w.node;
            return true;
        }
    }
    return false;
}
//< bvh.traverse.stack

//> bvh.traverse.descend: Go to the nearer child, let the other wait
static bool descend(const struct bvh *tree, const ray *r, struct stack *s,
                    uint32_t *node)
{
    uint32_t near = tree->nodes[*node].first, far = near + 1;
    float t_near, t_far, unused;
    bool hit_near = aabb_test(&tree->nodes[near].box, r, &t_near, &unused);
    bool hit_far = aabb_test(&tree->nodes[far].box, r, &t_far, &unused);
    if (hit_near && hit_far) {
        bool swap = t_far < t_near;
        push(s, swap ? near : far, swap ? t_near : t_far);
        *node = swap ? far : near;
        return true;
    }
    *node = hit_near ? near : far;
    return hit_near || hit_far;
}
//< bvh.traverse.descend

//> bvh.traverse.walk: Visit leaves from near to far
static bool walk(const struct bvh *tree, ray *r, leaf_test_fn *test,
                 const void *context, void *hit, bool first_hit_will_do)
{
    struct stack stack;
    stack.size = 0;
    uint32_t node = 0;
    float t_enter, t_exit;
    bool found = false;
    if (tree->node_count == 0 ||
        !aabb_test(&tree->nodes[0].box, r, &t_enter, &t_exit))
        return false;
    do {
        bool inside = true;
        while (inside && tree->nodes[node].count == 0)
            inside = descend(tree, r, &stack, &node);
        if (!inside)
            continue;
        const struct bvh_node *leaf = &tree->nodes[node];
        if (test(context, leaf->first, leaf->count, r, hit)) {
            found = true;
            if (first_hit_will_do)
                return true;
        }
    } while (pop(&stack, r->t_max, &node));
    return found;
}
//< bvh.traverse.walk
#else
/* TODO(bvh_traverse): keep a stack of nodes that the ray enters; test leaves,
 * open inner nodes, the nearer child first. Until then the leaves are tested
 * one by one, all of them. */
static bool walk(const struct bvh *tree, ray *r, leaf_test_fn *test,
                 const void *context, void *hit, bool first_hit_will_do)
{
    bool found = false;
    float enter, leave;
    TODO_WARN("03 bvh", "testing every leaf");
    for (uint32_t i = 0; i < tree->node_count; i++) {
        const struct bvh_node *node = &tree->nodes[i];
        if (node->count > 0 && aabb_test(&node->box, r, &enter, &leave) &&
            test(context, node->first, node->count, r, hit))
            found = true;
        if (found && first_hit_will_do)
            return true;
    }
    return found;
}
#endif

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
//< bvh.traverse
