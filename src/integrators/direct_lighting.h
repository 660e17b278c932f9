/* direct_lighting.h - the light that arrives without detours. */
#ifndef RAYBOOK_INTEGRATORS_DIRECT_LIGHTING_H
#define RAYBOOK_INTEGRATORS_DIRECT_LIGHTING_H

#include "scene/scene.h"

/* The radiance that the surface sends towards `outgoing` (unit, away from the
 * surface) because of one point light: BSDF x irradiance x cosine, and
 * nothing where the light is hidden. */
rgb direct_point_light(const struct scene *scene, const struct surface *s,
                       const struct material *material, vec3 outgoing,
                       const struct point_light *light);

#endif
