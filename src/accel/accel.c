/* accel.c - see accel.h. */
#include "accel/accel.h"

#include <assert.h>
#include <stddef.h>

#include "base/memory.h"

#ifdef RAYBOOK_EMBREE
#include "accel/embree.h"
#endif

const char *const accel_names[] = {"wide", "bvh", "linear", "embree", NULL};

/* Embree may be missing from a build; nothing below is reached then. */
#ifdef RAYBOOK_EMBREE
static const bool with_embree = true;
#else
static const bool with_embree = false;
#define embree_build(boxes, count) NULL
#define embree_nearest(e, r, test, context, hit) false
#define embree_any(e, r, test, context, hit) false
#define embree_free(e) ((void)0)
#endif

bool accel_available(enum accel_kind kind)
{
    return kind != ACCEL_EMBREE || with_embree;
}

static void build_bvh(struct accel *a, const aabb boxes[], uint32_t order[])
{
    uint32_t count = a->primitive_count;
    size_t room = count > 1 ? 2 * (size_t)count - 1 : 1;
    a->nodes = mem_alloc(room, sizeof *a->nodes);
    a->node_count = bvh_build(boxes, count, a->nodes, order);
    if (a->node_count > 0)
        a->nodes = mem_resize(a->nodes, a->node_count, sizeof *a->nodes);
}

static aabb box_at(const void *boxes, uint32_t primitive)
{
    return ((const aabb *)boxes)[primitive];
}

struct accel accel_build_wide(const struct wide_source *source)
{
    struct accel a = {.kind = ACCEL_WIDE, .primitive_count = source->count};
    a.wide = wide_build(source);
    a.node_count = a.wide.node_count;
    return a;
}

struct accel accel_build(enum accel_kind kind, const aabb boxes[],
                         uint32_t primitive_count, uint32_t order[])
{
    struct accel a = {.kind = kind, .primitive_count = primitive_count};
    const struct wide_source source = {primitive_count, NULL, boxes, NULL,
                                       box_at};
    assert(accel_available(kind));
    for (uint32_t i = 0; i < primitive_count; i++)
        order[i] = i;
    if (kind == ACCEL_WIDE)
        return accel_build_wide(&source);
    if (kind == ACCEL_BVH)
        build_bvh(&a, boxes, order);
    else if (kind == ACCEL_EMBREE)
        a.embree = embree_build(boxes, primitive_count);
    return a;
}

static bool query_linear(const struct accel *a, ray *r, leaf_test_fn *test,
                         const void *context, void *hit)
{
    return a->primitive_count > 0 &&
           test(context, 0, a->primitive_count, r, hit);
}

bool accel_nearest(const struct accel *a, ray *r, leaf_test_fn *test,
                   const void *context, void *hit)
{
    if (a->kind == ACCEL_LINEAR)
        return query_linear(a, r, test, context, hit);
    if (a->kind == ACCEL_WIDE)
        return wide_nearest(&a->wide, r, test, context, hit);
    if (a->kind == ACCEL_EMBREE)
        return embree_nearest(a->embree, r, test, context, hit);
    const struct bvh tree = {a->nodes, a->node_count};
    return bvh_nearest(&tree, r, test, context, hit);
}

bool accel_any(const struct accel *a, ray *r, leaf_test_fn *test,
               const void *context, void *hit)
{
    if (a->kind == ACCEL_LINEAR)
        return query_linear(a, r, test, context, hit);
    if (a->kind == ACCEL_WIDE)
        return wide_any(&a->wide, r, test, context, hit);
    if (a->kind == ACCEL_EMBREE)
        return embree_any(a->embree, r, test, context, hit);
    const struct bvh tree = {a->nodes, a->node_count};
    return bvh_any(&tree, r, test, context, hit);
}

void accel_free(struct accel *a)
{
    mem_free(a->nodes);
    wide_free(&a->wide);
    embree_free(a->embree);
    a->nodes = NULL;
    a->embree = NULL;
}
