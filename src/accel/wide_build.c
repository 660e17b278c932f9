/* wide_build.c - building the wide tree; see wide.h. */
#include <stdbool.h>
#include <stddef.h>

#include "accel/twigs.h"
#include "accel/wide.h"
#include "base/memory.h"

enum { SMALL_TASK = 1024, CACHE_LINE = 64 };

//> wide.references: A box for each primitive
/* The corners of a triangle; false: it is none. */
static bool corners_of(const struct wide_source *source, uint32_t primitive,
                       vec3 corners[3])
{
    return source->corners != NULL &&
           source->corners(source->context, primitive, corners);
}

/* What is no triangle takes as long as a pack of them, and the boxes of eight
 * children are tested in one go: so each of those has a leaf of its own. */
static struct reference make_reference(const struct wide_source *source,
                                       uint32_t primitive)
{
    vec3 p[3];
    aabb box = aabb_empty();
    bool other = !corners_of(source, primitive, p);
    if (other)
        box = source->box(source->context, primitive);
    for (int i = 0; i < 3 && !other; i++)
        box = aabb_include(box, p[i]);
    return reference_make(&box, primitive, other);
}

static struct reference *make_references(const struct wide_source *source)
{
    struct reference *references = mem_alloc(source->count, sizeof *references);
#pragma omp parallel for
    for (uint32_t i = 0; i < source->count; i++)
        references[i] = make_reference(
            source, source->numbers != NULL ? source->numbers[i] : i);
    return references;
}
//< wide.references

//> wide.count: Count the nodes of every subtree
/* Counts the wide nodes below each twig that becomes one. */
static void count_nodes(struct twig *twigs, uint32_t index)
{
    uint32_t child[WIDE];
    int count = twigs_open(twigs, index, child);
    for (int i = 0; i < count; i++) {
        const struct twig *t = &twigs[child[i]];
        if (t->children == 0)
            continue;
        if (t->leaves > SMALL_TASK) {
#pragma omp task firstprivate(i)
            count_nodes(twigs, child[i]);
        } else {
            count_nodes(twigs, child[i]);
        }
    }
#pragma omp taskwait
    twigs[index].nodes = 1;
    for (int i = 0; i < count; i++)
        if (twigs[child[i]].children != 0)
            twigs[index].nodes += twigs[child[i]].nodes;
}
//< wide.count

struct writer {
    const struct wide_source *source;
    const struct reference *references;
    struct twig *twigs;
    struct wide_node *nodes;
    struct wide_pack *packs;
};

//> wide.write_pack: Write a pack of triangles
static void write_corner(struct wide_pack *p, int corner, int lane, vec3 at)
{
    p->corner[corner][0][lane] = at.x;
    p->corner[corner][1][lane] = at.y;
    p->corner[corner][2][lane] = at.z;
}

/* Returns whether the primitive is a triangle. */
static bool write_lane(const struct wide_source *source, uint32_t primitive,
                       struct wide_pack *p, int lane)
{
    vec3 corners[3];
    p->primitive[lane] = primitive;
    if (!corners_of(source, primitive, corners))
        return false;
    for (int i = 0; i < 3; i++)
        write_corner(p, i, lane, corners[i]);
    return true;
}

static void write_nothing(struct wide_pack *p)
{
    for (int lane = 0; lane < WIDE; lane++) {
        p->primitive[lane] = NO_PRIMITIVE;
        for (int i = 0; i < 3; i++)
            for (int axis = 0; axis < 3; axis++)
                p->corner[i][axis][lane] = NAN;
    }
}

/* Returns how its parent refers to it. */
static uint32_t write_pack(const struct writer *w, const struct twig *twig,
                           uint32_t pack)
{
    uint32_t reference = WIDE_LEAF | pack;
    struct wide_pack *p = &w->packs[pack];
    write_nothing(p);
    for (uint32_t i = 0; i < twig->count; i++)
        if (!write_lane(w->source,
                        reference_primitive(&w->references[twig->first + i]), p,
                        (int)i))
            reference |= WIDE_OTHER;
    return reference;
}
//< wide.write_pack

static void write_box(struct wide_node *n, int lane, const aabb *box)
{
    n->planes[0][lane] = box->lower.x;
    n->planes[1][lane] = box->upper.x;
    n->planes[2][lane] = box->lower.y;
    n->planes[3][lane] = box->upper.y;
    n->planes[4][lane] = box->lower.z;
    n->planes[5][lane] = box->upper.z;
}

//> wide.write_node: Write a subtree's nodes, each to its own place
static void write_node(const struct writer *w, uint32_t index, uint32_t node,
                       uint32_t pack);

/* The subtree's nodes begin at *next, which is moved behind them. Large ones
 * are left to whichever thread has time. */
static uint32_t write_below(const struct writer *w, uint32_t index,
                            uint32_t *next, uint32_t pack)
{
    uint32_t node = *next;
    *next += w->twigs[index].nodes;
    if (w->twigs[index].leaves > SMALL_TASK) {
#pragma omp task
        write_node(w, index, node, pack);
    } else {
        write_node(w, index, node, pack);
    }
    return node;
}

/* Nodes and packs of a subtree lie one after the other from node and pack on,
 * so that every child's place is known before its neighbours are written. */
static void write_node(const struct writer *w, uint32_t index, uint32_t node,
                       uint32_t pack)
{
    uint32_t child[WIDE], next = node + 1;
    struct wide_node *n = &w->nodes[node];
    int count = twigs_open(w->twigs, index, child);
    const aabb empty = aabb_empty();
    for (int i = 0; i < WIDE; i++) {
        const struct twig *t = i < count ? &w->twigs[child[i]] : NULL;
        write_box(n, i, t != NULL ? &t->box : &empty);
        if (t == NULL)
            continue;
        if (t->children == 0)
            n->child[i] = write_pack(w, t, pack);
        else
            n->child[i] = write_below(w, child[i], &next, pack);
        pack += t->leaves;
    }
#pragma omp taskwait
}
//< wide.write_node

//> wide.make_room: Room for packs and nodes
static void *at_cache_line(void *memory)
{
    uintptr_t address = (uintptr_t)memory;
    return (char *)memory + (CACHE_LINE - address % CACHE_LINE) % CACHE_LINE;
}

/* Packs come first: their size is a multiple of a cache line's. */
static void make_room(struct wide *tree, struct writer *w)
{
    size_t packs = tree->pack_count * sizeof *w->packs;
    size_t nodes = tree->node_count * sizeof *w->nodes;
    tree->memory = mem_alloc(packs + nodes + CACHE_LINE, 1);
    w->packs = at_cache_line(tree->memory);
    w->nodes = (struct wide_node *)(w->packs + tree->pack_count);
    tree->packs = w->packs;
    tree->nodes = w->nodes;
}
//< wide.make_room

//> wide.write_tree: Write the whole tree
static void write_tree(struct wide *tree, struct writer *w)
{
    struct twig *root = w->twigs;
    tree->box = root->box;
    if (root->children != 0) {
#pragma omp parallel
#pragma omp single
        count_nodes(w->twigs, 0);
        tree->node_count = root->nodes;
    }
    tree->pack_count = root->leaves;
    make_room(tree, w);
    tree->root = 0;
    if (root->children == 0)
        tree->root = write_pack(w, root, 0);
    else
#pragma omp parallel
#pragma omp single
        write_node(w, 0, 0, 0);
}
//< wide.write_tree

struct wide wide_build(const struct wide_source *source)
{
    struct wide tree = {.box = aabb_empty()};
    if (source->count == 0)
        return tree;
    struct reference *references = make_references(source);
    struct twig *twigs = mem_alloc(source->count, 2 * sizeof *twigs);
    struct writer w = {source, references, twigs, NULL, NULL};
    twigs_grow(references, source->count, WIDE_MAX_DEPTH, twigs);
    write_tree(&tree, &w);
    mem_free(twigs);
    mem_free(references);
    return tree;
}

void wide_free(struct wide *tree)
{
    static const struct wide none;
    mem_free(tree->memory);
    *tree = none;
}
