/* probe_lights.c - runs the two modules of assignment 07; judges nothing.
 *
 *   probe INPUT OUTPUT GROUP
 *
 * Both files are arrays of 32-bit little-endian words (f = IEEE single, u =
 * unsigned) in records of varying length; OUTPUT has one record for each of
 * INPUT, in order. oracle_table.py and oracle_lights.py mirror this layout.
 *
 * A record of INPUT, whatever the group:
 *   u number of lights, u by power (1) or evenly (0), f radius of the scene,
 *   u number of random numbers (steps), then for each light 10 words:
 *   u kind (enum light_kind), 3 f position, 3 f colour (flux, irradiance,
 *   intensity or radiance), f beam angle, f cutoff angle, f area
 *
 * GROUP "sum"; the lights are points over a floor:
 *   out  u flags, 3 f all_lights of all lights, 3 f of the first half of them,
 *        3 f mean of one_light over the random numbers (2 i + 1) / (2 steps),
 *        then for each light: f probability
 * Any other GROUP; the random numbers are 0, 1/steps, 2/steps ... and at last
 * the largest number below 1:
 *   out  u flags, then for each light: f probability, u how often it is picked
 * Flags: 1 = picked an index that is not a light's; 2 = the probability of a
 * pick is not that of light_table_probability; 4 = it is not above 0; 8 = the
 * count of a new table is wrong; 16 = light_table_free leaves something; 32 =
 * the lights have changed; 64 = asking again gives something else; 128 =
 * all_lights does not ask each light once; 256 = one_light does not ask one
 * light once. */
#include "base/constants.h"
#include "base/memory.h"
#include "integrators/several_lights.h"
#include "probe.h"

enum {
    NO_LIGHT = 1,
    OTHER_PROBABILITY = 2,
    NOT_POSITIVE = 4,
    WRONG_COUNT = 8,
    NOT_RELEASED = 16,
    CHANGED_LIGHTS = 32,
    NOT_REPEATABLE = 64,
    NOT_EACH_ONCE = 128,
    NOT_ONE_ONCE = 256
};
enum { LIGHTS_MAX = 4096 };

struct job {
    uint32_t count, steps;
    bool by_power;
    float radius;
    struct light *lights;
};

static struct light take_light(struct probe *p)
{
    struct light light;
    memset(&light, 0, sizeof light);
    light.kind = (enum light_kind)take_word(p);
    light.position = take_vec3(p);
    light.direction = vec3_make(0.0f, -1.0f, 0.0f);
    rgb color = take_rgb(p);
    light.flux = light.irradiance = light.intensity = light.radiance = color;
    light.beam_angle = take_float(p);
    light.cutoff_angle = take_float(p);
    light.area = take_float(p);
    return light;
}

static struct job take_job(struct probe *p)
{
    struct job job;
    job.count = take_word(p);
    if (job.count > LIGHTS_MAX)
        probe_fail(p, p->input_name, "more lights than a record may have");
    job.by_power = take_word(p) != 0;
    job.radius = take_float(p);
    job.steps = take_word(p);
    job.lights = mem_alloc(job.count, sizeof *job.lights);
    for (uint32_t i = 0; i < job.count; i++)
        job.lights[i] = take_light(p);
    return job;
}

/* --- The table ------------------------------------------------------------ */

static struct light_table make_table(const struct job *job, uint32_t *flags)
{
    size_t bytes = job->count * sizeof *job->lights;
    struct light *before = mem_alloc(job->count, sizeof *before);
    memcpy(before, job->lights, bytes);
    struct light_table t =
        light_table_make(job->lights, job->count, job->by_power, job->radius);
    if (t.count != job->count)
        *flags |= WRONG_COUNT;
    if (memcmp(before, job->lights, bytes) != 0)
        *flags |= CHANGED_LIGHTS;
    mem_free(before);
    return t;
}

static void free_table(struct light_table *t, uint32_t *flags)
{
    light_table_free(t);
    if (t->count != 0 || t->choices != NULL)
        *flags |= NOT_RELEASED;
    light_table_free(t);
}

static void count_pick(const struct job *job, const struct light_table *t,
                       float random, uint32_t *picks, uint32_t *flags)
{
    float probability = -1.0f;
    uint32_t light = light_table_pick(t, random, &probability);
    if (light >= job->count) {
        *flags |= NO_LIGHT;
        return;
    }
    float known = light_table_probability(t, light);
    if (!(fabsf(probability - known) <= 1e-5f * known))
        *flags |= OTHER_PROBABILITY;
    if (!(probability > 0.0f))
        *flags |= NOT_POSITIVE;
    picks[light]++;
}

static void run_table(struct probe *p, const struct job *job)
{
    uint32_t flags = 0;
    uint32_t *picks = mem_alloc(job->count, sizeof *picks);
    float *chance = mem_alloc(job->count, sizeof *chance);
    struct light_table t = make_table(job, &flags);
    for (uint32_t i = 0; job->count > 0 && i < job->steps; i++)
        count_pick(job, &t, (float)((double)i / job->steps), picks, &flags);
    if (job->count > 0)
        count_pick(job, &t, 0x1.fffffep-1f, picks, &flags);
    for (uint32_t i = 0; i < job->count; i++)
        chance[i] = light_table_probability(&t, i);
    free_table(&t, &flags);
    put_word(p, flags);
    for (uint32_t i = 0; i < job->count; i++) {
        put_float(p, chance[i]);
        put_word(p, picks[i]);
    }
    mem_free(picks);
    mem_free(chance);
}

/* --- The light of several ------------------------------------------------- */

/* A floor at y = 0 under the lights, seen from above. */
struct stage {
    struct texture paint;
    struct material material;
    struct scene scene;
    struct sampler sampler;
    struct tracer tracer;
    struct vertex vertex;
};

static void prepare(struct probe *p, struct stage *s, const struct job *job)
{
    struct error err = {{0}};
    memset(s, 0, sizeof *s);
    s->paint.color[0] = rgb_make(0.5f, 0.25f, 1.0f);
    s->material.albedo = &s->paint;
    s->scene.environment = -1;
    s->scene.objects = mem_alloc(1, sizeof *s->scene.objects);
    s->scene.object_count = 1;
    struct object *floor = s->scene.objects;
    floor->kind = OBJECT_RECT;
    floor->material = &s->material;
    floor->light = -1;
    floor->rect.side_x = vec3_make(10.0f, 0.0f, 0.0f);
    floor->rect.side_y = vec3_make(0.0f, 0.0f, -10.0f);
    floor->rect.normal = vec3_make(0.0f, 1.0f, 0.0f);
    floor->rect.area = 100.0f;
    if (!scene_prepare(&s->scene, ACCEL_BVH, &err))
        probe_fail(p, "scene", err.text);
    s->scene.lights = job->lights;
    s->scene.light_count = job->count;
    s->sampler = sampler_start(SAMPLER_INDEPENDENT, 1, 1, 0, 1);
    s->tracer.scene = &s->scene;
    s->tracer.sampler = &s->sampler;
    ray down = ray_make(vec3_make(0.0f, 3.0f, 0.0f),
                        vec3_make(0.0f, -1.0f, 0.0f), 0.0f, INFINITY);
    struct ray_differential none;
    memset(&none, 0, sizeof none);
    if (!tracer_hit(&s->tracer, &down, &none, &s->vertex))
        probe_fail(p, "scene", "the floor is not seen");
}

/* The lights are the job's. */
static void tidy(struct stage *s)
{
    s->scene.lights = NULL;
    s->scene.light_count = 0;
    scene_free(&s->scene);
}

/* Each light that is asked takes two dimensions of the sampler. */
static bool asks(const struct stage *s, uint32_t before, uint32_t lights)
{
    return s->sampler.dimension - before == 2 * lights;
}

static void run_sum(struct probe *p, const struct job *job)
{
    uint32_t flags = 0;
    struct stage s;
    prepare(p, &s, job);
    const struct asking asking = {&s.tracer, &s.vertex, false};

    uint32_t before = s.sampler.dimension;
    rgb all = all_lights(&asking, job->count);
    if (!asks(&s, before, job->count))
        flags |= NOT_EACH_ONCE;
    rgb half = all_lights(&asking, job->count / 2);
    rgb again = all_lights(&asking, job->count);
    if (memcmp(&all, &again, sizeof all) != 0)
        flags |= NOT_REPEATABLE;

    struct light_table t = make_table(job, &flags);
    double mean[3] = {0.0, 0.0, 0.0};
    for (uint32_t i = 0; job->count > 0 && i < job->steps; i++) {
        before = s.sampler.dimension;
        float random = (float)((2.0 * i + 1.0) / (2.0 * job->steps));
        rgb one = one_light(&asking, &t, random);
        if (!asks(&s, before, 1))
            flags |= NOT_ONE_ONCE;
        mean[0] += (double)one.r / job->steps;
        mean[1] += (double)one.g / job->steps;
        mean[2] += (double)one.b / job->steps;
    }
    put_word(p, flags);
    put_rgb(p, all);
    put_rgb(p, half);
    put_rgb(p, rgb_make((float)mean[0], (float)mean[1], (float)mean[2]));
    for (uint32_t i = 0; i < job->count; i++)
        put_float(p, light_table_probability(&t, i));
    light_table_free(&t);
    tidy(&s);
}

int main(int argc, char **argv)
{
    struct probe p = probe_open("probe_lights", argc, argv);
    bool sum = probe_is(&p, "sum");
    while (probe_more(&p)) {
        struct job job = take_job(&p);
        if (sum)
            run_sum(&p, &job);
        else
            run_table(&p, &job);
        mem_free(job.lights);
    }
    return probe_close(&p);
}
