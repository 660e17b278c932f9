/* bvh.c - a linear BVH: sorted along a Morton curve, split at its bits.
 *
 * Builder: 63 bits, 21 an axis; a radix sort; a node is split where the
 * highest bit changes that its codes do not share. Equal codes are halved.
 * Walk: the nearer child at once, the other waits; no t is kept.
 *
 * Source: C. Lauterbach et al., "Fast BVH Construction on GPUs",
 * Eurographics 2009. */
#include "accel/bvh.h"

#include "accel/aabb.h"
#include "base/memory.h"

enum { BITS = 21, LARGEST_LEAF = 4 };

/* A split at a bit is followed by halvings once the codes are equal. 29 bits
 * and 32 halvings, and the root, make 62 levels. */
enum { BITS_USED = 29 };

struct coded {
    uint64_t code;
    uint32_t primitive;
};

/* Two zeros before each bit. */
static uint64_t spread(uint64_t x)
{
    uint64_t out = 0;
    for (int i = 0; i < BITS; i++)
        out |= (x >> i & 1) << (3 * i);
    return out;
}

static uint64_t cell(float c, float lower, float upper)
{
    double width = (double)upper - lower;
    double part = width > 0.0 ? ((double)c - lower) / width : 0.0;
    uint64_t i = (uint64_t)(part * (1 << BITS));
    return i < (1 << BITS) ? i : (1 << BITS) - 1;
}

static uint64_t morton(vec3 p, aabb all)
{
    return spread(cell(p.x, all.lower.x, all.upper.x)) << 2 |
           spread(cell(p.y, all.lower.y, all.upper.y)) << 1 |
           spread(cell(p.z, all.lower.z, all.upper.z));
}

/* One byte at a time, from the lowest: stable, so that ties stay in order. */
static void sort(struct coded *a, struct coded *b, uint32_t n)
{
    for (int shift = 0; shift < 64; shift += 8) {
        uint32_t start[257] = {0};
        for (uint32_t i = 0; i < n; i++)
            start[(a[i].code >> shift & 255) + 1]++;
        for (int i = 0; i < 256; i++)
            start[i + 1] += start[i];
        for (uint32_t i = 0; i < n; i++)
            b[start[a[i].code >> shift & 255]++] = a[i];
        struct coded *c = a;
        a = b;
        b = c;
    }
}

struct linear {
    const aabb *boxes;
    const struct coded *sorted;
    struct bvh_node *nodes;
    uint32_t used;
};

/* The first place whose code has the bit; all before it have not. */
static uint32_t border(const struct coded *sorted, uint32_t first,
                       uint32_t count, uint64_t bit)
{
    uint32_t low = first, high = first + count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (sorted[middle].code & bit)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

static uint32_t left_count(const struct coded *sorted, uint32_t first,
                           uint32_t count)
{
    uint64_t differ = sorted[first].code ^ sorted[first + count - 1].code;
    int bit = 3 * BITS - 1;
    while (bit >= 3 * BITS - BITS_USED && !(differ >> bit & 1))
        bit--;
    if (bit < 3 * BITS - BITS_USED)
        return count / 2;
    return border(sorted, first, count, (uint64_t)1 << bit) - first;
}

/* Boxes are known once the children are: from the leaves up. */
static aabb emit(struct linear *l, uint32_t node, uint32_t first,
                 uint32_t count)
{
    aabb box = aabb_empty();
    if (count <= LARGEST_LEAF) {
        for (uint32_t i = first; i < first + count; i++)
            box = aabb_union(box, l->boxes[l->sorted[i].primitive]);
        l->nodes[node] = (struct bvh_node){box, first, count};
        return box;
    }
    uint32_t left = left_count(l->sorted, first, count), child = l->used;
    l->used += 2;
    box = emit(l, child, first, left);
    box = aabb_union(box, emit(l, child + 1, first + left, count - left));
    l->nodes[node] = (struct bvh_node){box, child, 0};
    return box;
}

uint32_t bvh_build(const aabb boxes[], uint32_t primitive_count,
                   struct bvh_node nodes[], uint32_t order[])
{
    uint32_t n = primitive_count;
    if (n == 0)
        return 0;
    struct coded *codes = mem_alloc(n, sizeof *codes);
    struct coded *spare = mem_alloc(n, sizeof *spare);
    aabb all = aabb_empty();
    for (uint32_t i = 0; i < n; i++)
        all = aabb_include(all, aabb_centroid(boxes[i]));
    for (uint32_t i = 0; i < n; i++)
        codes[i] = (struct coded){morton(aabb_centroid(boxes[i]), all), i};
    sort(codes, spare, n);
    struct linear l = {boxes, codes, nodes, 1};
    emit(&l, 0, 0, n);
    for (uint32_t i = 0; i < n; i++)
        order[i] = codes[i].primitive;
    mem_free(codes);
    mem_free(spare);
    return l.used;
}

static bool walk(const struct bvh *tree, ray *r, leaf_test_fn *test,
                 const void *context, void *hit, bool any)
{
    const struct bvh_node *nodes = tree->nodes, *stack[BVH_MAX_DEPTH];
    int waiting = 0;
    bool found = false;
    float t[2], leave;
    const struct bvh_node *node = nodes;
    if (tree->node_count == 0 || !aabb_test(&nodes->box, r, t, &leave))
        return false;
    for (;;) {
        if (node->count == 0) {
            const struct bvh_node *child = nodes + node->first;
            bool in[2] = {aabb_test(&child[0].box, r, &t[0], &leave),
                          aabb_test(&child[1].box, r, &t[1], &leave)};
            int nearer = in[1] && (!in[0] || t[1] < t[0]);
            if (in[0] && in[1])
                stack[waiting++] = &child[1 - nearer];
            if (in[0] || in[1]) {
                node = &child[nearer];
                continue;
            }
        } else if (test(context, node->first, node->count, r, hit)) {
            found = true;
            if (any)
                return true;
        }
        if (waiting == 0)
            return found;
        node = stack[--waiting];
    }
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
