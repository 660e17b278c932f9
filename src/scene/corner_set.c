/* corner_set.c - see corner_set.h. */
#include "scene/corner_set.h"

#include <stdbool.h>
#include <string.h>

#include "base/memory.h"

/* Neighbours in the file stay neighbours in the table where there are only
 * positions; odd factors spread the other two. */
static uint32_t hash_corner(struct corner c)
{
    return c.position ^ c.uv * UINT32_C(0x9e3779b1) ^
           c.normal * UINT32_C(0x85ebca6b);
}

static bool corners_equal(struct corner a, struct corner b)
{
    return a.position == b.position && a.uv == b.uv && a.normal == b.normal;
}

static void link_corner(struct corner_set *set, uint32_t i)
{
    uint32_t *head = &set->heads[hash_corner(set->items[i]) & set->mask];
    set->next[i] = *head;
    *head = i;
}

/* Twice the room; all chains are made anew. */
static void grow_corners(struct corner_set *set)
{
    set->capacity = set->capacity > 0 ? 2 * set->capacity : 64;
    set->items = mem_resize(set->items, set->capacity, sizeof *set->items);
    set->next = mem_resize(set->next, set->capacity, sizeof *set->next);
    set->heads = mem_resize(set->heads, set->capacity, sizeof *set->heads);
    set->mask = (uint32_t)(set->capacity - 1);
    memset(set->heads, 0xff, set->capacity * sizeof *set->heads);
    for (size_t i = 0; i < set->count; i++)
        link_corner(set, (uint32_t)i);
}

uint32_t corner_set_find(struct corner_set *set, struct corner c)
{
    if (set->count == set->capacity)
        grow_corners(set);
    uint32_t i = set->heads[hash_corner(c) & set->mask];
    while (i != NO_INDEX && !corners_equal(set->items[i], c))
        i = set->next[i];
    if (i != NO_INDEX)
        return i;
    set->items[set->count] = c;
    link_corner(set, (uint32_t)set->count);
    return (uint32_t)set->count++;
}

void corner_set_free(struct corner_set *set)
{
    mem_free(set->items);
    mem_free(set->next);
    mem_free(set->heads);
    memset(set, 0, sizeof *set);
}
