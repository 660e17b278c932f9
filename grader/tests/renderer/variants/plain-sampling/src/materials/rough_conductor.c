/* rough_conductor.c - the reference, but directions are picked by the cosine
 * alone: what variance.py compares the visible normals with. */
#define rough_conductor_sample sample_seen
#define rough_conductor_pdf pdf_seen
#include "materials/rough_conductor.c"
#undef rough_conductor_sample
#undef rough_conductor_pdf

#include "sampling/warp.h"

float rough_conductor_pdf(const struct material *m, const struct surface *s,
                          vec3 outgoing, vec3 incoming)
{
    struct meeting d;
    (void)m;
    if (!meet(s, outgoing, incoming, &d))
        return 0.0f;
    return warp_cosine_hemisphere_pdf(d.incoming);
}

bool rough_conductor_sample(const struct material *m, const struct surface *s,
                            vec3 outgoing, const float random[3],
                            struct scatter *out)
{
    struct shading_frame frame = shading_frame_make(s);
    vec3 local = warp_cosine_hemisphere(vec2_make(random[0], random[1]));
    out->incoming = shading_frame_to_world(&frame, local);
    out->pdf = rough_conductor_pdf(m, s, outgoing, out->incoming);
    out->specular = out->transmitted = false;
    if (!(out->pdf > 0.0f))
        return false;
    rgb found = rough_conductor_eval(m, s, outgoing, out->incoming);
    out->weight = rgb_scale(found, local.z / out->pdf);
    return true;
}
