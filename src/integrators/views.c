/* views.c - see views.h. */
#include "integrators/views.h"

static float level_seen(const struct material *m, const struct surface *s)
{
    if (m == NULL || m->albedo == NULL || m->albedo->kind != TEXTURE_IMAGE)
        return 0.0f;
    vec2 scale = m->albedo->scale;
    vec2 dx = vec2_make(s->uv_dx.x * scale.x, s->uv_dx.y * scale.y);
    vec2 dy = vec2_make(s->uv_dy.x * scale.x, s->uv_dy.y * scale.y);
    return mipmap_level(&m->albedo->image.mipmap, dx, dy);
}

struct first_hit first_hit(const struct tracer *t, const ray *r,
                           const struct ray_differential *d)
{
    struct first_hit h = {.depth = 0.0f};
    struct vertex v;
    /* As a difference of integers: the totals outgrow a float's digits. */
    struct counters before = counters_mine;
    bool found = tracer_hit(t, r, d, &v);
    h.bvh_cost =
        (float)(counters_mine.boxes_tested - before.boxes_tested +
                counters_mine.primitives_tested - before.primitives_tested);
    if (!found)
        return h;
    const struct material *m = v.object->material;
    h.albedo = m ? material_albedo(m, &v.surface) : rgb_grey(0.0f);
    h.normal = v.surface.shading_normal;
    h.depth = v.t;
    h.uv = v.surface.uv;
    h.mip_level = level_seen(m, &v.surface);
    return h;
}

/* Blue, cyan, green, yellow, red for 0 to 1: straight lines between. */
static rgb heat(float x)
{
    x = fmaxf(0.0f, fminf(1.0f, x)) * 4.0f;
    return rgb_make(fmaxf(0.0f, fminf(1.0f, x - 2.0f)),
                    fmaxf(0.0f, fminf(1.0f, x < 2.0f ? x : 4.0f - x)),
                    fmaxf(0.0f, fminf(1.0f, 2.0f - x)));
}

rgb view_color(enum integrator_kind kind, const struct first_hit *h)
{
    bool hit = h->depth > 0.0f;
    switch (kind) {
    case INTEGRATOR_NORMAL:
        return hit ? rgb_make(0.5f * h->normal.x + 0.5f,
                              0.5f * h->normal.y + 0.5f,
                              0.5f * h->normal.z + 0.5f)
                   : rgb_grey(0.0f);
    case INTEGRATOR_DEPTH:
        return rgb_grey(h->depth);
    case INTEGRATOR_UV:
        return rgb_make(h->uv.x - floorf(h->uv.x), h->uv.y - floorf(h->uv.y),
                        0.0f);
    case INTEGRATOR_BVH_COST:
        return heat(h->bvh_cost / 200.0f);
    default:
        return hit ? heat(h->mip_level / 8.0f) : rgb_grey(0.0f);
    }
}
