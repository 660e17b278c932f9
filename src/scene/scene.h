/* scene.h - everything that a scene file describes, checked and ready.
 *
 * scene_load fills a struct scene; scene_prepare builds the structure that
 * answers what a ray hits; after that the scene does not change and any number
 * of threads may ask it. scene_free releases all of it. */
#ifndef RAYBOOK_SCENE_SCENE_H
#define RAYBOOK_SCENE_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "accel/accel.h"
#include "base/counters.h"
#include "base/error.h"
#include "lights/light.h"
#include "lights/selection.h"
#include "materials/material.h"
#include "scene/settings.h"
#include "shapes/mesh.h"
#include "shapes/rect.h"
#include "shapes/sphere.h"
#include "textures/texture.h"

enum object_kind { OBJECT_MESH, OBJECT_SPHERE, OBJECT_RECT };

/* A mesh in a space of its own, that objects show: models.h. */
struct model {
    char *path; /* of its file */
    struct mesh mesh;
    aabb box;         /* of the mesh */
    uint32_t shown;   /* the number of objects that do */
    struct wide tree; /* over its triangles, from scene_prepare on */
};

/* material NULL: the object does not reflect (a light may be so). light < 0: it
 * does not emit; otherwise the index of its area light. */
struct object {
    enum object_kind kind;
    struct mesh mesh;    /* OBJECT_MESH, in world space; or else, empty: */
    struct model *model; /* a mesh in another space, NULL if there is none */
    struct placement
        place;            /* where it shows the model; to_world is set first */
    aabb box;             /* and the box of that, from scene_prepare on */
    struct sphere sphere; /* OBJECT_SPHERE */
    struct rect rect;     /* OBJECT_RECT */
    const struct material *material;
    int32_t light;
};

/* Something that a ray can hit, with a copy of what its test reads: a mesh's
 * vertices lie all over memory. */
struct primitive {
    uint32_t number; /* in the order of the file */
    uint32_t object;
    vec3 corners[3]; /* of a triangle */
};

struct scene {
    struct film_settings film;
    struct camera_settings camera;
    struct integrator_settings integrator;

    struct texture *textures;
    uint32_t texture_count;
    struct material *materials;
    struct model *models; /* room for as many as there are objects */
    uint32_t model_count;
    struct object *objects;
    uint32_t object_count;
    struct light *lights;
    uint32_t light_count;
    int32_t environment; /* index of the environment light; < 0: none */
    struct image environment_image;

    /* from scene_prepare on */
    uint32_t primitive_count;
    uint32_t *first_primitive;    /* of each object; one more, the count */
    struct primitive *primitives; /* as leaves name them; NULL: ACCEL_WIDE */
    struct accel accel;
    float radius; /* of a sphere that holds everything */
    struct light_table light_table;
};

/* Where a ray met something. Ask scene_object and scene_surface
 * for more. */
struct scene_hit {
    uint32_t primitive; /* its number, in the order of the file */
    float t;
    float b1, b2; /* barycentric coordinates, of a triangle */
};

/* Counts the primitives and builds the acceleration structure. Returns false
 * and fills *err when there are 2^30 of them or more. */
bool scene_prepare(struct scene *scene, enum accel_kind kind,
                   struct error *err);

/* The nearest hit in the ray's range; false on a miss. */
bool scene_nearest(const struct scene *scene, const ray *r,
                   struct scene_hit *hit);

/* Is anything in the ray's range, wherever? Counts as a shadow ray. Most ask
 * one of the two questions below, which see to it that the ray starts off the
 * surface that it leaves. */
bool scene_any(const struct scene *scene, const ray *r);

/* The object that was hit, and its surface where this ray hit it. */
const struct object *scene_object(const struct scene *scene,
                                  const struct scene_hit *hit);
void scene_surface(const struct scene *scene, const ray *r,
                   const struct scene_hit *hit, const struct object *object,
                   struct surface *out);

/* Is anything in this direction, however far? The query starts off the
 * surface. */
bool scene_direction_blocked(const struct scene *scene, const struct surface *s,
                             vec3 direction);

/* Is the straight way from the surface to the point blocked? The query starts
 * off the surface and ends at the point: it cannot hit the surface that it
 * leaves, nor anything behind the point. */
bool scene_segment_blocked(const struct scene *scene, const struct surface *s,
                           vec3 point);

void scene_free(struct scene *scene);

#endif
