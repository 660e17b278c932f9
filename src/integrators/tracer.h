/* tracer.h - what every integrator works with: one sample's state, and the
 * point where a ray ends. */
#ifndef RAYBOOK_INTEGRATORS_TRACER_H
#define RAYBOOK_INTEGRATORS_TRACER_H

#include "base/ray_differential.h"
#include "integrators/path_log.h"
#include "sampling/sampler.h"
#include "scene/scene.h"

/* One sample of one pixel. log is NULL but for --pixel. */
struct tracer {
    const struct scene *scene;
    struct sampler *sampler;
    struct path_log *log;
};

/* Where a ray met the scene. */
struct vertex {
    struct surface surface;
    const struct object *object; /* of the scene; its material may be NULL */
    vec3 outgoing;               /* the unit vector back along the ray */
    float t;                     /* of the ray */
};

/* The nearest hit as a vertex, with the footprint of d. false on a miss: *out
 * is then as it was. */
bool tracer_hit(const struct tracer *t, const ray *r,
                const struct ray_differential *d, struct vertex *out);

/* The same for who looks for light only: of a vertex that does not shine no
 * more than the object is filled in. */
bool tracer_light(const struct tracer *t, const ray *r,
                  const struct ray_differential *d, struct vertex *out);

/* The radiance that the vertex itself emits back along the ray. */
rgb vertex_emitted(const struct tracer *t, const struct vertex *v);

#endif
