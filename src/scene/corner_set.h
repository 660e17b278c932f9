/* corner_set.h - the distinct corners of a mesh's faces.
 *
 * An OBJ file indexes position, texture coordinate and normal apart; a mesh
 * has one index for all three. Each distinct triple becomes one vertex. */
#ifndef RAYBOOK_SCENE_CORNER_SET_H
#define RAYBOOK_SCENE_CORNER_SET_H

#include <stddef.h>
#include <stdint.h>

#define NO_INDEX UINT32_MAX

/* A corner's indices, from 0; uv and normal may be NO_INDEX. */
struct corner {
    uint32_t position, uv, normal;
};

/* items[0 .. count) are the distinct corners in order of appearance; the set
 * owns them. All zero is the empty set. The rest is a hash table with
 * chaining: a chain starts at heads[hash & mask] and goes on at next[i];
 * NO_INDEX ends it. */
struct corner_set {
    struct corner *items;
    uint32_t *next, *heads;
    size_t count, capacity;
    uint32_t mask;
};

/* The place of c among the items; appends it when it is new. At most
 * NO_INDEX corners fit: the caller sees to that. */
uint32_t corner_set_find(struct corner_set *set, struct corner c);

void corner_set_free(struct corner_set *set);

#endif
