/* twigs.c - see twigs.h. */
#include "accel/twigs.h"

#include <math.h>

enum { SMALL_TASK = 4096 };

//> twigs.price: Say what a subtree costs
/* cost[i - 1] is the least cost of a subtree that may use up to i of its
 * wide parent's children. With one it is a leaf or a wide node of its own;
 * with more it may instead hand them on to its own two children, in the best
 * proportion: left_share[i - 1] go to the left one, 0 if a node of its own is
 * no worse. left_share[0] is how that node's own children are shared out.
 *
 * Source: H. Ylitie, T. Karras, S. Laine, "Efficient Incoherent Ray Traversal
 * on GPUs Through Compressed Wide BVHs", High Performance Graphics 2017,
 * section 3.1. */
static const float cost_of_leaf = 1.0f, cost_of_node = 1.0f;

static void price_leaf(struct twig *leaf)
{
    leaf->children = 0;
    leaf->leaves = 1;
    for (int i = 0; i < TWIGS_WIDE; i++) {
        leaf->cost[i] = cost_of_leaf * aabb_area(leaf->box);
        leaf->left_share[i] = 0;
    }
}

/* Of the two that may use up to shares children in all. */
static float share_out(const struct twig pair[2], int shares,
                       uint8_t *left_share)
{
    float least = INFINITY;
    for (int left = 1; left < shares; left++) {
        float cost = pair[0].cost[left - 1] + pair[1].cost[shares - left - 1];
        if (left == 1 || cost < least) {
            least = cost;
            *left_share = (uint8_t)left;
        }
    }
    return least;
}

static void price_inner(struct twig *twig, const struct twig pair[2])
{
    twig->leaves = pair[0].leaves + pair[1].leaves;
    twig->cost[0] = cost_of_node * aabb_area(twig->box) +
                    share_out(pair, TWIGS_WIDE, &twig->left_share[0]);
    for (int i = 2; i <= TWIGS_WIDE; i++) {
        twig->cost[i - 1] = share_out(pair, i, &twig->left_share[i - 1]);
        if (twig->cost[0] <= twig->cost[i - 1]) {
            twig->cost[i - 1] = twig->cost[0];
            twig->left_share[i - 1] = 0;
        }
    }
}
//< twigs.price

//> twigs.grow: Grow the binary tree
struct builder {
    struct reference *references;
    struct twig *twigs;
    uint32_t twig_count;
    int depth_limit;
};

/* Two twigs side by side. */
static uint32_t take_twigs(struct builder *b)
{
    uint32_t first;
#pragma omp atomic capture
    {
        first = b->twig_count;
        b->twig_count += 2;
    }
    return first;
}

static void split(struct builder *b, const struct range *range, uint32_t index,
                  int depth);

static void split_both(struct builder *b, const struct range *left,
                       const struct range *right, uint32_t children, int depth)
{
    if (left->count + right->count > SMALL_TASK) {
#pragma omp task
        split(b, left, children, depth);
        split(b, right, children + 1, depth);
#pragma omp taskwait
    } else {
        split(b, left, children, depth);
        split(b, right, children + 1, depth);
    }
}

static void split(struct builder *b, const struct range *range, uint32_t index,
                  int depth)
{
    struct twig *twig = &b->twigs[index];
    twig->box = bounds_box(&range->boxes);
    twig->first = range->first;
    twig->count = range->count;
    if (range_is_leaf(range)) {
        price_leaf(twig);
        return;
    }
    struct range left, right;
    range_split(b->references, range, b->depth_limit - depth, &left, &right);
    twig->children = take_twigs(b);
    split_both(b, &left, &right, twig->children, depth + 1);
    price_inner(twig, &b->twigs[twig->children]);
}

void twigs_grow(struct reference references[], uint32_t count, int depth_limit,
                struct twig twigs[])
{
    struct builder b = {references, twigs, 1, depth_limit};
    struct range range = range_of_all(references, count);
#pragma omp parallel
#pragma omp single
    split(&b, &range, 0, 1);
}
//< twigs.grow

//> twigs.open: Open a node into eight
/* Adds to child what becomes of a twig that may use up to shares children. */
static int open(const struct twig twigs[], uint32_t index, int shares,
                uint32_t child[], int count)
{
    const struct twig *t = &twigs[index];
    int left = shares > 1 ? t->left_share[shares - 1] : 0;
    if (left == 0) {
        child[count] = index;
        return count + 1;
    }
    count = open(twigs, t->children, left, child, count);
    return open(twigs, t->children + 1, shares - left, child, count);
}

int twigs_open(const struct twig twigs[], uint32_t index,
               uint32_t child[TWIGS_WIDE])
{
    const struct twig *t = &twigs[index];
    int left = t->left_share[0];
    int count = open(twigs, t->children, left, child, 0);
    return open(twigs, t->children + 1, TWIGS_WIDE - left, child, count);
}
//< twigs.open
