/* rough_conductor.c - see rough_conductor.h. */
#include "materials/rough_conductor.h"

#include "materials/fresnel.h"
#include "materials/ggx.h"
#include "materials/mirror.h"
#include "materials/shading_frame.h"
#include "materials/sides.h"
#include "materials/surface_color.h"

//> rough_conductor.meet: Find the mirror between two directions
/* Two directions in the shading frame, and the normal halfway between. */
struct meeting {
    vec3 outgoing, incoming, half;
};

static bool meet(const struct surface *s, vec3 outgoing, vec3 incoming,
                 struct meeting *out)
{
    if (surface_side(s, outgoing) <= 0 || surface_side(s, incoming) <= 0)
        return false;
    struct shading_frame frame = shading_frame_make(s);
    out->outgoing = shading_frame_to_local(&frame, outgoing);
    out->incoming = shading_frame_to_local(&frame, incoming);
    out->half = vec3_normalize(vec3_add(out->outgoing, out->incoming));
    return true;
}
//< rough_conductor.meet

//> rough_conductor.color: The colour of the metal
static vec2 roughness(const struct material *m)
{
    return vec2_make(m->alpha_x, m->alpha_y);
}

static rgb reflectance(const struct material *m, float cosine)
{
    rgb eta = m->conductor_eta, k = m->conductor_k;
    return rgb_make(fresnel_conductor(cosine, eta.r, k.r),
                    fresnel_conductor(cosine, eta.g, k.g),
                    fresnel_conductor(cosine, eta.b, k.b));
}

static rgb tinted_reflectance(const struct material *m, const struct surface *s,
                              float cosine)
{
    return rgb_mul(surface_color(m->albedo, s), reflectance(m, cosine));
}
//< rough_conductor.color

//> rough_conductor.eval: Evaluate the BSDF
rgb rough_conductor_eval(const struct material *m, const struct surface *s,
                         vec3 outgoing, vec3 incoming)
{
    struct meeting d;
    vec2 alpha = roughness(m);
    if (!meet(s, outgoing, incoming, &d))
        return rgb_grey(0.0f);
    float mirrors = 0.25f * ggx_density(alpha, d.half) *
                    ggx_seen_over_cosine(alpha, d.outgoing) *
                    ggx_seen_over_cosine(alpha, d.incoming);
    rgb color = tinted_reflectance(m, s, vec3_dot(d.outgoing, d.half));
    return rgb_scale(color, mirrors);
}
//< rough_conductor.eval

//> rough_conductor.pdf: The density of a direction off metal
float rough_conductor_pdf(const struct material *m, const struct surface *s,
                          vec3 outgoing, vec3 incoming)
{
    struct meeting d;
    vec2 alpha = roughness(m);
    if (!meet(s, outgoing, incoming, &d))
        return 0.0f;
    /* A mirror that turns by an angle turns its image by twice that: the
     * density of normals over 4 (outgoing . half). */
    return 0.25f * ggx_density(alpha, d.half) *
           ggx_seen_over_cosine(alpha, d.outgoing);
}
//< rough_conductor.pdf

//> rough_conductor.sample: Pick a direction off metal
bool rough_conductor_sample(const struct material *m, const struct surface *s,
                            vec3 outgoing, const float random[3],
                            struct scatter *out)
{
    vec2 alpha = roughness(m);
    if (surface_side(s, outgoing) <= 0)
        return false;
    struct shading_frame frame = shading_frame_make(s);
    vec3 local = shading_frame_to_local(&frame, outgoing);
    vec3 normal =
        ggx_sample_seen(alpha, local, vec2_make(random[0], random[1]));
    vec3 incoming = mirror_direction(normal, local);
    out->incoming = vec3_normalize(shading_frame_to_world(&frame, incoming));
    out->pdf = rough_conductor_pdf(m, s, outgoing, out->incoming);
    out->specular = out->transmitted = false;
    if (!(out->pdf > 0.0f))
        return false;
    rgb color = tinted_reflectance(m, s, vec3_dot(local, normal));
    float seen = incoming.z * ggx_seen_over_cosine(alpha, incoming);
    out->weight = rgb_scale(color, seen);
    return true;
}
//< rough_conductor.sample

rgb rough_conductor_albedo(const struct material *m, const struct surface *s)
{
    return tinted_reflectance(m, s, 1.0f);
}
