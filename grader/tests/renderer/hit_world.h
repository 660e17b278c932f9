/* hit_world.h - a mesh, the structures over it, and rays that are hard on them.
 *
 * The mesh stands in the world as it is, or is shown PLACES times: turned,
 * stretched, mirrored and moved, all by chance and overlapping. */
#ifndef RAYBOOK_TESTS_HIT_WORLD_H
#define RAYBOOK_TESTS_HIT_WORLD_H

#include <stddef.h>
#include <stdint.h>

#include "base/box.h"
#include "base/transform.h"
#include "scene/scene.h"

struct hit_world {
    const char *path;
    struct mesh mesh; /* in its own space */
    uint32_t places;  /* 0: once, as it is */
    aabb box;         /* of everything, about */
    vec3 *inside;     /* points inside a closed mesh, in its own space */
    size_t inside_count;
};

/* Says what is wrong and ends the program. */
void hit_stop(const char *what, const char *why);

/* Reads the mesh and the points inside, x y z each, perhaps none. */
struct hit_world hit_world_read(const char *mesh, const char *inside,
                                uint32_t places);

/* The whole world in a structure of this kind. */
struct scene hit_world_scene(const struct hit_world *w, enum accel_kind kind);

/* Does the ray of this number start inside the mesh? Every second one does if
 * there are points inside. */
bool hit_world_starts_inside(const struct hit_world *w, uint64_t index);

/* Ray number index of a seed. Four kinds take turns: between random points,
 * from a random point to a vertex, from a random point to a point of an edge,
 * and to a random point nearer by. It starts as if it left a surface that is
 * known exactly, so that it can be asked about in all ways. Returns its
 * direction. */
vec3 hit_world_ray(const struct hit_world *w, uint64_t seed, uint64_t index,
                   struct surface *start);

/* The program's other half: leaks.c. */
int leaks(int argc, char *argv[]);

#endif
