/* path.c - see path.h. */
#include "integrators/path.h"

#include "base/minmax.h"
#include "integrators/bounce.h"
#include "integrators/mis.h"
#include "integrators/next_event.h"

//> path.state: A path under way
/* A path under way. */
struct path {
    const struct tracer *t;
    ray r;
    struct ray_differential d;
    rgb throughput; /* what a unit of radiance here adds to the pixel */
    rgb radiance;   /* found so far */
    vec3 from;      /* the last vertex */
    float pdf;      /* with which the ray's direction was picked there */
    bool specular;  /* the last vertex could not have asked for the light */
    int scattered, rough; /* events so far; those not specular */
    int max_scattered, max_rough;
    enum path_profile profile;
};
//< path.state

//> path.share: What it counts to hit a light
/* The share of light that a path hits, beside what a vertex would have got by
 * asking: asked_pdf is how likely it was to ask in this direction. */
static float share_of_hit(const struct path *p, float asked_pdf)
{
    if (p->specular || p->profile == PROFILE_RW)
        return 1.0f;
    return p->profile == PROFILE_NEE ? 0.0f
                                     : power_heuristic(p->pdf, asked_pdf);
}
//< path.share

//> path.found: Add what the path has hit
static void add(struct path *p, rgb radiance, float share)
{
    rgb part = rgb_scale(rgb_mul(p->throughput, radiance), share);
    p->radiance = rgb_add(p->radiance, part);
    path_log_found(p->t->log, radiance, share, p->throughput);
}

static void add_emitted(struct path *p, const struct vertex *v)
{
    rgb emitted = vertex_emitted(p->t, v);
    if (rgb_is_black(emitted))
        return;
    float asked = 0.0f;
    if (!p->specular)
        asked = next_event_pdf(p->t->scene, (uint32_t)v->object->light, p->from,
                               vec3_negate(v->outgoing), v->surface.position,
                               v->surface.geometric_normal);
    add(p, emitted, share_of_hit(p, asked));
}

static void add_environment(struct path *p)
{
    const struct scene *scene = p->t->scene;
    if (scene->environment < 0)
        return;
    const struct light *light = &scene->lights[scene->environment];
    vec3 direction = vec3_normalize(p->r.direction);
    rgb radiance = environment_radiance(&light->environment, direction);
    vec3 nowhere = vec3_make(0.0f, 0.0f, 0.0f);
    float asked = 0.0f;
    if (!p->specular)
        asked = next_event_pdf(scene, (uint32_t)scene->environment, p->from,
                               direction, nowhere, nowhere);
    add(p, radiance, share_of_hit(p, asked));
}
//< path.found

//> path.ask: Ask the lights
static void ask_lights(struct path *p, const struct vertex *v)
{
    if (p->profile == PROFILE_RW)
        return;
    rgb found = next_event(p->t, v, p->profile == PROFILE_MIS);
    p->radiance = rgb_add(p->radiance, rgb_mul(p->throughput, found));
}
//< path.ask

//> path.survive: End a path that carries little
/* A path that carries little ends with a probability, and one that survives
 * counts for those that did not: J. Arvo and D. Kirk, "Particle Transport and
 * Image Synthesis", SIGGRAPH 1990. Never surely: 5 % survive at least. */
static bool survives(struct path *p)
{
    rgb w = p->throughput;
    float most = float_max(w.r, float_max(w.g, w.b));
    if (most >= p->t->scene->integrator.rr_threshold)
        return true;
    float chance = float_max(0.05f, most);
    if (sampler_1d(p->t->sampler) >= chance)
        return false;
    p->throughput = rgb_scale(w, 1.0f / chance);
    return true;
}
//< path.survive

//> path.scatter: Go on from a vertex
static bool scatter_on(struct path *p, const struct vertex *v)
{
    struct scatter way;
    if (!bounce(p->t, v, &p->r, &p->d, &way))
        return false;
    p->throughput = rgb_mul(p->throughput, way.weight);
    p->from = v->surface.position;
    p->pdf = way.pdf;
    p->specular = way.specular;
    p->scattered++;
    p->rough += way.specular ? 0 : 1;
    return !rgb_is_black(p->throughput) && survives(p);
}
//< path.scatter

//> path.walk: Walk from vertex to vertex
/* A path that may not scatter any more only looks for light. */
static bool at_end(const struct path *p)
{
    return p->scattered >= p->max_scattered || p->rough >= p->max_rough;
}

static bool next_vertex(const struct path *p, struct vertex *v)
{
    return at_end(p) ? tracer_light(p->t, &p->r, &p->d, v)
                     : tracer_hit(p->t, &p->r, &p->d, v);
}

static rgb walk(struct path *p)
{
    for (;;) {
        struct vertex v;
        if (!next_vertex(p, &v)) {
            add_environment(p);
            break;
        }
        add_emitted(p, &v);
        const struct material *material = v.object->material;
        if (material == NULL || at_end(p))
            break;
        if (!material_is_specular(material))
            ask_lights(p, &v);
        if (!scatter_on(p, &v))
            break;
    }
    return p->radiance;
}
//< path.walk

//> path.start: Begin at the camera
static struct path start(const struct tracer *t, ray r,
                         struct ray_differential d)
{
    struct path p = {.t = t, .r = r, .d = d};
    p.throughput = rgb_grey(1.0f);
    p.radiance = rgb_grey(0.0f);
    p.from = r.origin;
    p.specular = true; /* the camera asks nobody */
    p.max_scattered = p.max_rough = t->scene->integrator.max_depth;
    p.profile = t->scene->integrator.profile;
    return p;
}

rgb path_radiance(const struct tracer *t, ray r, struct ray_differential d)
{
    struct path p = start(t, r, d);
    return walk(&p);
}

rgb direct_radiance(const struct tracer *t, ray r, struct ray_differential d)
{
    struct path p = start(t, r, d);
    p.max_rough = 1;
    p.profile = PROFILE_MIS;
    return walk(&p);
}
//< path.start
