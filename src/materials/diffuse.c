/* diffuse.c - see diffuse.h. */
#include "materials/diffuse.h"

#include "base/constants.h"
#include "materials/sides.h"
#include "materials/surface_color.h"
#include "sampling/warp.h"

static bool reflects(const struct material *m, const struct surface *s,
                     vec3 outgoing, vec3 incoming)
{
    int side = surface_side(s, outgoing);
    return (side > 0 || (side < 0 && m->two_sided)) &&
           surface_side(s, incoming) == side;
}

rgb diffuse_eval(const struct material *m, const struct surface *s,
                 vec3 outgoing, vec3 incoming)
{
    if (!reflects(m, s, outgoing, incoming))
        return rgb_grey(0.0f);
    return rgb_scale(surface_color(m->albedo, s), 1.0f / PI);
}

float diffuse_pdf(const struct material *m, const struct surface *s,
                  vec3 outgoing, vec3 incoming)
{
    if (!reflects(m, s, outgoing, incoming))
        return 0.0f;
    return fabsf(vec3_dot(incoming, s->shading_normal)) * (1.0f / PI);
}

bool diffuse_sample(const struct material *m, const struct surface *s,
                    vec3 outgoing, const float random[3], struct scatter *out)
{
    vec3 n = s->shading_normal, x, y;
    if (surface_side(s, outgoing) < 0)
        n = vec3_negate(n);
    vec3_frame(n, &x, &y);
    vec3 local = warp_cosine_hemisphere(vec2_make(random[0], random[1]));
    vec3 flat = vec3_step(vec3_scale(x, local.x), local.y, y);
    out->incoming = vec3_normalize(vec3_step(flat, local.z, n));
    out->pdf = diffuse_pdf(m, s, outgoing, out->incoming);
    out->specular = out->transmitted = false;
    if (out->pdf == 0.0f)
        return false;
    out->weight = surface_color(m->albedo, s);
    return true;
}
