/* probe_bvh.c - runs a BVH module on many cases; judges nothing.
 *
 *   probe INPUT OUTPUT GROUP
 *
 * Both files are 32-bit little-endian words (f = IEEE single, u = unsigned).
 * The oracles of this folder mirror this layout.
 *
 * GROUP "tree-...": sets of boxes, to build trees of.
 *   in   u n, n times 6 f (lower x y z, upper x y z)
 *   out  u what bvh_build returned, u flags; unless it is more than there is
 *        room for: the nodes (6 f box, u first, u count each), n u order
 * GROUP "walk-...": trees that others built, and rays to walk them with.
 *   in   u nodes, u rays, the nodes, the rays: u kind, 3 f origin,
 *        3 f direction, f t_min, f t_max, u hits, hits times (u i, f t): the
 *        primitive that a leaf names order[i] is hit at t, within t_min and
 *        t_max or not
 *   out  for each ray: u returned true (1) or false (0), u i, f t,
 *        f t_max afterwards, u primitives asked about, u boxes tested,
 *        u flags
 *
 * So each side is judged without the other: trees by the oracle, walks on
 * given trees. What is hit is a list, and a walk must find the least t of it:
 * no arithmetic of the primitives' is in question. */
#include <math.h>
#include <setjmp.h>

#include "accel/bvh.h"
#include "base/counters.h"
#include "base/memory.h"
#include "probe.h"

/* Building ---------------------------------------------------------------- */

enum {
    WROTE_BEYOND_NODES = 1,
    WROTE_BEYOND_ORDER = 2,
    CHANGED_BOXES = 4,
    NOT_REPEATABLE = 8
};

/* Bytes before and behind an array that must stay as they were. */
enum { FENCE = 4096 };

/* Sets so small are built twice. */
enum { BUILT_TWICE = 6000 };

/* An array between two fences, all of it holding `junk`. */
static unsigned char *fenced(size_t size, int junk)
{
    unsigned char *all = mem_alloc(size + 2 * FENCE, 1);
    memset(all, junk, size + 2 * FENCE);
    return all;
}

static bool fences_stand(const unsigned char *all, size_t size, int junk)
{
    for (size_t i = 0; i < FENCE; i++)
        if (all[i] != junk || all[FENCE + size + i] != junk)
            return false;
    return true;
}

struct build {
    const aabb *boxes;
    uint32_t n, returned, flags;
    size_t nodes_size, order_size;
    unsigned char *nodes, *order; /* with their fences */
};

static struct build run_build(const aabb *boxes, uint32_t n, int junk)
{
    struct build b = {.boxes = boxes, .n = n};
    size_t room = n > 1 ? 2 * (size_t)n - 1 : 1;
    b.nodes_size = room * sizeof(struct bvh_node);
    b.order_size = n * sizeof(uint32_t);
    b.nodes = fenced(b.nodes_size, junk);
    b.order = fenced(b.order_size, junk);
    b.returned = bvh_build(boxes, n, (struct bvh_node *)(b.nodes + FENCE),
                           (uint32_t *)(b.order + FENCE));
    if (!fences_stand(b.nodes, b.nodes_size, junk))
        b.flags |= WROTE_BEYOND_NODES;
    if (!fences_stand(b.order, b.order_size, junk))
        b.flags |= WROTE_BEYOND_ORDER;
    return b;
}

static bool fits(const struct build *b)
{
    return b->returned <= b->nodes_size / sizeof(struct bvh_node);
}

static bool same(const struct build *a, const struct build *b)
{
    return a->returned == b->returned && fits(a) &&
           memcmp(a->nodes + FENCE, b->nodes + FENCE,
                  a->returned * sizeof(struct bvh_node)) == 0 &&
           memcmp(a->order + FENCE, b->order + FENCE, a->order_size) == 0;
}

static void free_build(struct build *b)
{
    mem_free(b->nodes);
    mem_free(b->order);
}

static void put_build(struct probe *p, const struct build *b)
{
    put_word(p, b->returned);
    put_word(p, b->flags);
    if (!fits(b))
        return;
    const struct bvh_node *nodes = (struct bvh_node *)(b->nodes + FENCE);
    const uint32_t *order = (uint32_t *)(b->order + FENCE);
    for (uint32_t i = 0; i < b->returned; i++) {
        put_vec3(p, nodes[i].box.lower);
        put_vec3(p, nodes[i].box.upper);
        put_word(p, nodes[i].first);
        put_word(p, nodes[i].count);
    }
    for (uint32_t i = 0; i < b->n; i++)
        put_word(p, order[i]);
}

static void run_set(struct probe *p)
{
    uint32_t n = take_word(p);
    size_t size = n * sizeof(aabb);
    aabb *boxes = mem_alloc(n, sizeof *boxes);
    aabb *before = mem_alloc(n, sizeof *before);
    for (uint32_t i = 0; i < n; i++)
        boxes[i] = take_box(p);
    memcpy(before, boxes, size);
    struct build first = run_build(boxes, n, 0x5a);
    if (n <= BUILT_TWICE) {
        struct build second = run_build(boxes, n, 0xc3);
        if (!same(&first, &second))
            first.flags |= NOT_REPEATABLE;
        free_build(&second);
    }
    if (memcmp(before, boxes, size) != 0)
        first.flags |= CHANGED_BOXES;
    put_build(p, &first);
    free_build(&first);
    mem_free(boxes);
    mem_free(before);
}

/* Walking ----------------------------------------------------------------- */

enum {
    NOT_A_LEAF = 1,
    OTHER_HIT = 2,
    WROTE_WITHOUT_A_HIT = 4,
    CHANGED_RAY = 8,
    ASKED_AFTER_A_HIT = 16,
    BROKEN_BY_ANOTHER = 32,
    CHANGED_TREE = 64,
    ENDLESS = 128
};

/* Kinds of rays are sums of these. ANY: bvh_any, not bvh_nearest. NESTED: each
 * leaf's test asks about the ray before, as the test of an instance does.
 * BEYOND: tests lower t_max to a little beyond the hit. */
enum { ANY = 1, NESTED = 2, BEYOND = 4 };

struct found {
    uint32_t i;
    float t;
};

static const struct found NOTHING = {UINT32_MAX, INFINITY};

/* One ray, what it hits, and what became of it. */
struct query {
    const struct bvh *tree;
    struct query *inner; /* NULL, or what the tests ask on their way */
    uint32_t kind;
    ray r;
    uint32_t hits;
    struct found *hit;
    /* answers */
    bool returned;
    struct found answer;
    float t_max;
    uint32_t primitives, boxes, flags;
    /* while it runs */
    uint32_t calls;
    float last_t_max;
    bool true_before;
    jmp_buf give_up;
};

static bool is_leaf(const struct bvh *tree, uint32_t first, uint32_t count)
{
    for (uint32_t i = 0; i < tree->node_count; i++)
        if (tree->nodes[i].count == count && tree->nodes[i].first == first)
            return count > 0;
    return false;
}

static void answer(struct query *q);

/* What the other walk tests is not this one's work. */
static void ask_another(struct query *q)
{
    struct query again = *q->inner;
    uint64_t boxes_tested = counters_mine.boxes_tested;
    again.kind &= ANY | BEYOND;
    again.inner = NULL;
    answer(&again);
    counters_mine.boxes_tested = boxes_tested;
    if (again.returned != q->inner->returned ||
        memcmp(&again.answer, &q->inner->answer, sizeof again.answer) != 0)
        q->flags |= BROKEN_BY_ANOTHER;
}

/* Flags what is wrong with a call of the test; gives a walk up that cannot go
 * on. Large trees are given to be counted on, small ones to be looked at. */
static void check_call(struct query *q, uint32_t first, uint32_t count,
                       const struct found *hit)
{
    if (hit != &q->answer)
        q->flags |= OTHER_HIT;
    if (++q->calls > 4 * q->tree->node_count)
        q->flags |= ENDLESS;
    if (q->flags & (OTHER_HIT | ENDLESS))
        longjmp(q->give_up, 1);
    if (q->tree->node_count < 1000 && !is_leaf(q->tree, first, count))
        q->flags |= NOT_A_LEAF;
    if (q->true_before && (q->kind & ANY))
        q->flags |= ASKED_AFTER_A_HIT;
}

static bool test_leaf(const void *context, uint32_t first, uint32_t count,
                      ray *r, void *out)
{
    struct query *q = *(struct query *const *)context;
    bool found = false;
    check_call(q, first, count, out);
    q->primitives += count;
    if (q->inner)
        ask_another(q);
    for (uint32_t k = 0; k < q->hits; k++) {
        struct found hit = q->hit[k];
        if (hit.i - first >= count || !(hit.t >= r->t_min) ||
            !(hit.t <= r->t_max) || !(hit.t < q->answer.t))
            continue;
        q->answer = hit;
        r->t_max = q->kind & BEYOND ? nextafterf(hit.t, INFINITY) : hit.t;
        q->last_t_max = r->t_max;
        q->true_before = found = true;
    }
    return found;
}

static void ask(struct query *q)
{
    ray used = q->r;
    q->returned = q->kind & ANY
                      ? bvh_any(q->tree, &used, test_leaf, &q, &q->answer)
                      : bvh_nearest(q->tree, &used, test_leaf, &q, &q->answer);
    q->t_max = used.t_max;
    used.t_max = q->r.t_max;
    if (memcmp(&used, &q->r, sizeof used) != 0 ||
        memcmp(&q->t_max, &q->last_t_max, sizeof q->t_max) != 0)
        q->flags |= CHANGED_RAY;
    if (!q->true_before && memcmp(&q->answer, &NOTHING, sizeof NOTHING) != 0)
        q->flags |= WROTE_WITHOUT_A_HIT;
}

/* Fills in the answers. */
static void answer(struct query *q)
{
    uint64_t boxes_before = counters_mine.boxes_tested;
    q->primitives = q->boxes = q->flags = q->calls = 0;
    q->returned = q->true_before = false;
    q->answer = NOTHING;
    q->t_max = q->last_t_max = q->r.t_max;
    if (setjmp(q->give_up) == 0)
        ask(q);
    q->boxes = (uint32_t)(counters_mine.boxes_tested - boxes_before);
}

static struct query take_query(struct probe *p, const struct bvh *tree)
{
    struct query q = {.tree = tree, .kind = take_word(p)};
    q.r = take_ray(p);
    q.hits = take_word(p);
    q.hit = mem_alloc(q.hits, sizeof *q.hit);
    for (uint32_t i = 0; i < q.hits; i++) {
        q.hit[i].i = take_word(p);
        q.hit[i].t = take_float(p);
    }
    return q;
}

static void put_query(struct probe *p, const struct query *q)
{
    put_word(p, q->returned);
    put_word(p, q->answer.i);
    put_float(p, q->answer.t);
    put_float(p, q->t_max);
    put_word(p, q->primitives);
    put_word(p, q->boxes);
    put_word(p, q->flags);
}

static void run_rays(struct probe *p, const struct bvh *tree, uint32_t rays,
                     const struct bvh_node *before)
{
    struct query last = {.hit = NULL};
    for (uint32_t i = 0; i < rays; i++) {
        struct query q = take_query(p, tree);
        q.inner = q.kind & NESTED && i > 0 ? &last : NULL;
        answer(&q);
        if (i + 1 == rays &&
            memcmp(before, tree->nodes, tree->node_count * sizeof *before) != 0)
            q.flags |= CHANGED_TREE;
        put_query(p, &q);
        mem_free(last.hit);
        last = q;
    }
    mem_free(last.hit);
}

static void run_tree(struct probe *p)
{
    uint32_t node_count = take_word(p), rays = take_word(p);
    struct bvh_node *nodes = mem_alloc(node_count, sizeof *nodes);
    struct bvh_node *before = mem_alloc(node_count, sizeof *before);
    for (uint32_t i = 0; i < node_count; i++) {
        nodes[i].box = take_box(p);
        nodes[i].first = take_word(p);
        nodes[i].count = take_word(p);
    }
    memcpy(before, nodes, node_count * sizeof *nodes);
    struct bvh tree = {nodes, node_count};
    run_rays(p, &tree, rays, before);
    mem_free(nodes);
    mem_free(before);
}

int main(int argc, char **argv)
{
    struct probe p = probe_open("probe_bvh", argc, argv);
    bool walks = strncmp(p.group, "walk", 4) == 0;
    while (probe_more(&p)) {
        if (walks)
            run_tree(&p);
        else
            run_set(&p);
    }
    return probe_close(&p);
}
