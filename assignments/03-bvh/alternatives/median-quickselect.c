/* bvh.c - median splits without recursion; a walk that tests boxes late.
 *
 * Builder: quickselect puts the median centroid of the widest axis in its
 * place, as std::nth_element would; nodes to split wait on a list.
 * Walk: a node's box is tested when it is taken from the stack. */
#include "accel/bvh.h"

#include "accel/aabb.h"

enum { SMALL = 4 };

struct range {
    uint32_t node, first, count;
};

static float key(const aabb boxes[], uint32_t primitive, int axis)
{
    return vec3_axis(boxes[primitive].lower, axis) +
           vec3_axis(boxes[primitive].upper, axis);
}

static void swap(uint32_t *a, uint32_t *b)
{
    uint32_t c = *a;
    *a = *b;
    *b = c;
}

/* Hoare's FIND: afterwards no key before order[k] is larger than its key, and
 * none behind it is smaller. Many equal keys are no trouble. */
static void select_kth(const aabb boxes[], uint32_t order[], int64_t count,
                       int64_t k, int axis)
{
    int64_t low = 0, high = count - 1;
    while (low < high) {
        float pivot = key(boxes, order[low + (high - low) / 2], axis);
        int64_t i = low, j = high;
        while (i <= j) {
            while (key(boxes, order[i], axis) < pivot)
                i++;
            while (key(boxes, order[j], axis) > pivot)
                j--;
            if (i <= j)
                swap(&order[i++], &order[j--]);
        }
        if (j < k)
            low = i;
        if (k < i)
            high = j;
    }
}

static int widest_axis(const aabb boxes[], const uint32_t order[],
                       uint32_t count)
{
    aabb all = aabb_empty();
    for (uint32_t i = 0; i < count; i++)
        all = aabb_include(all, aabb_centroid(boxes[order[i]]));
    vec3 d = vec3_sub(all.upper, all.lower);
    if (d.x >= d.y && d.x >= d.z)
        return 0;
    return d.y >= d.z ? 1 : 2;
}

static aabb box_of(const aabb boxes[], const uint32_t order[], uint32_t count)
{
    aabb all = boxes[order[0]];
    for (uint32_t i = 1; i < count; i++)
        all = aabb_union(all, boxes[order[i]]);
    return all;
}

uint32_t bvh_build(const aabb boxes[], uint32_t primitive_count,
                   struct bvh_node nodes[], uint32_t order[])
{
    struct range waiting[BVH_MAX_DEPTH];
    uint32_t used = 1;
    int size = 0;
    if (primitive_count == 0)
        return 0;
    for (uint32_t i = 0; i < primitive_count; i++)
        order[i] = i;
    waiting[size++] = (struct range){0, 0, primitive_count};
    while (size > 0) {
        struct range r = waiting[--size];
        struct bvh_node *node = &nodes[r.node];
        node->box = box_of(boxes, order + r.first, r.count);
        node->first = r.first;
        node->count = r.count;
        if (r.count <= SMALL)
            continue;
        uint32_t half = r.count / 2;
        int axis = widest_axis(boxes, order + r.first, r.count);
        select_kth(boxes, order + r.first, r.count, half, axis);
        node->first = used;
        node->count = 0;
        waiting[size++] =
            (struct range){used + 1, r.first + half, r.count - half};
        waiting[size++] = (struct range){used, r.first, half};
        used += 2;
    }
    return used;
}

/* The order in which two children are entered, by their centres along the
 * ray: a guess that needs no box test. */
static bool second_is_nearer(const struct bvh_node *pair, const ray *r)
{
    vec3 between =
        vec3_sub(aabb_centroid(pair[1].box), aabb_centroid(pair[0].box));
    return vec3_dot(between, r->direction) < 0.0f;
}

static bool walk(const struct bvh *tree, ray *r, leaf_test_fn *test,
                 const void *context, void *hit, bool any)
{
    uint32_t stack[BVH_MAX_DEPTH + 1];
    int size = 0;
    bool found = false;
    if (tree->node_count > 0)
        stack[size++] = 0;
    while (size > 0 && !(any && found)) {
        const struct bvh_node *node = &tree->nodes[stack[--size]];
        float enter, leave;
        if (!aabb_test(&node->box, r, &enter, &leave))
            continue;
        if (node->count > 0) {
            found |= test(context, node->first, node->count, r, hit);
            continue;
        }
        uint32_t second = second_is_nearer(&tree->nodes[node->first], r);
        stack[size++] = node->first + 1 - second;
        stack[size++] = node->first + second;
    }
    return found;
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
