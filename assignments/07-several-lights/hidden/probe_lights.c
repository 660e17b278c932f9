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
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/memory.h"
#include "integrators/several_lights.h"

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
enum { HEAD = 4, LIGHT_WORDS = 10, LIGHTS_MAX = 4096 };

struct job {
    uint32_t count, steps;
    bool by_power;
    float radius;
    struct light *lights;
};

static void fail(const char *file, const char *what)
{
    fprintf(stderr, "probe_lights: %s: %s\n", file, what);
    exit(2);
}

static FILE *open_or_fail(const char *name, const char *mode)
{
    FILE *file = fopen(name, mode);
    if (!file)
        fail(name, "cannot be opened");
    return file;
}

/* --- Words ---------------------------------------------------------------- */

static bool read_words(FILE *file, const char *name, uint32_t *words,
                       size_t count)
{
    for (size_t i = 0; i < count; i++) {
        unsigned char b[4];
        size_t got = fread(b, 1, 4, file);
        if (got == 0 && i == 0 && !ferror(file))
            return false;
        if (got != 4)
            fail(name, "ends inside a record; expected whole records of cases");
        words[i] = (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 |
                   (uint32_t)b[3] << 24;
    }
    return true;
}

static void put(FILE *file, uint32_t word)
{
    for (int shift = 0; shift < 32; shift += 8)
        fputc((int)(word >> shift & 255), file);
}

static float as_float(uint32_t word)
{
    float value;
    memcpy(&value, &word, sizeof value);
    return value;
}

static void put_float(FILE *file, float value)
{
    uint32_t word;
    memcpy(&word, &value, sizeof word);
    put(file, word);
}

static void put_rgb(FILE *file, rgb c)
{
    put_float(file, c.r);
    put_float(file, c.g);
    put_float(file, c.b);
}

static struct light light_of(const uint32_t *w)
{
    rgb color = rgb_make(as_float(w[4]), as_float(w[5]), as_float(w[6]));
    struct light light;
    memset(&light, 0, sizeof light);
    light.kind = (enum light_kind)w[0];
    light.position = vec3_make(as_float(w[1]), as_float(w[2]), as_float(w[3]));
    light.direction = vec3_make(0.0f, -1.0f, 0.0f);
    light.flux = light.irradiance = light.intensity = light.radiance = color;
    light.beam_angle = as_float(w[7]);
    light.cutoff_angle = as_float(w[8]);
    light.area = as_float(w[9]);
    return light;
}

static bool read_job(FILE *file, const char *name, struct job *job)
{
    uint32_t head[HEAD], words[LIGHT_WORDS];
    if (!read_words(file, name, head, HEAD))
        return false;
    if (head[0] > LIGHTS_MAX)
        fail(name, "more lights than a record may have");
    job->count = head[0];
    job->by_power = head[1] != 0;
    job->radius = as_float(head[2]);
    job->steps = head[3];
    job->lights = mem_alloc(job->count, sizeof *job->lights);
    for (uint32_t i = 0; i < job->count; i++) {
        if (!read_words(file, name, words, LIGHT_WORDS))
            fail(name, "ends inside a record; expected whole records of cases");
        job->lights[i] = light_of(words);
    }
    return true;
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

static void run_table(const struct job *job, FILE *out)
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
    put(out, flags);
    for (uint32_t i = 0; i < job->count; i++) {
        put_float(out, chance[i]);
        put(out, picks[i]);
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

static void prepare(struct stage *s, const struct job *job)
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
        fail("scene", err.text);
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
        fail("scene", "the floor is not seen");
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

static void run_sum(const struct job *job, FILE *out)
{
    uint32_t flags = 0;
    struct stage s;
    prepare(&s, job);
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
    put(out, flags);
    put_rgb(out, all);
    put_rgb(out, half);
    put_rgb(out, rgb_make((float)mean[0], (float)mean[1], (float)mean[2]));
    for (uint32_t i = 0; i < job->count; i++)
        put_float(out, light_table_probability(&t, i));
    light_table_free(&t);
    tidy(&s);
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: probe_lights INPUT OUTPUT GROUP\n");
        return 2;
    }
    bool sum = strcmp(argv[3], "sum") == 0;
    FILE *input = open_or_fail(argv[1], "rb");
    FILE *output = open_or_fail(argv[2], "wb");
    struct job job;
    while (read_job(input, argv[1], &job)) {
        if (sum)
            run_sum(&job, output);
        else
            run_table(&job, output);
        mem_free(job.lights);
    }
    if (fclose(output) != 0)
        fail(argv[2], "cannot be written");
    fclose(input);
    return 0;
}
