/* environment.c - assignment 09: directions are thrown and kept by chance. A
 * band between two rows of texel centres is picked by its light; directions in
 * it are tried until one is kept, which is as likely as it is bright. So the
 * density is the luminance over all light. More numbers than the two come from
 * a hash of them. */
#include "lights/environment.h"

#include <string.h>

#include "base/constants.h"
#include "base/memory.h"
#include "sampling/distribution.h"
#include "sampling/random.h"

enum { TRIES = 100000 };

struct environment_table {
    struct distribution_1d bands; /* height + 1 of them */
    float *brightest;             /* texel of each band */
    double total;                 /* luminance over the sphere */
};

static const rgb *row_of(const struct image *image, int row)
{
    int y = row < 0 ? 0 : row < image->height ? row : image->height - 1;
    return image->pixels + (size_t)y * (size_t)image->width;
}

static double theta_at(const struct image *image, double row)
{
    double theta = (double)PI * (row + 0.5) / image->height;
    return fmin(fmax(theta, 0.0), (double)PI);
}

/* The sum of a row, in colour once round: azimuths are even in it. */
static double row_sum(const struct image *image, int row)
{
    const rgb *texels = row_of(image, row);
    double sum = 0.0;
    for (int x = 0; x < image->width; x++)
        sum += (double)rgb_luminance(texels[x]);
    return sum * 2.0 * (double)PI / image->width;
}

/* The integral over a band: a line between two rows' sums, times sin theta.
 * That is (p + q theta) sin theta; its integral is below. */
static double band_light(const struct image *image, int band)
{
    double from = theta_at(image, band - 1), to = theta_at(image, band);
    double centre = (double)PI * (band - 0.5) / image->height;
    double upper = row_sum(image, band - 1), lower = row_sum(image, band);
    double q = (lower - upper) * image->height / (double)PI;
    double p = upper - q * centre;
    double at_to = -(p + q * to) * cos(to) + q * sin(to);
    double at_from = -(p + q * from) * cos(from) + q * sin(from);
    return fmax(0.0, at_to - at_from);
}

static float brightest_of(const struct image *image, int band)
{
    float most = 0.0f;
    for (int x = 0; x < image->width; x++) {
        most = fmaxf(most, rgb_luminance(row_of(image, band - 1)[x]));
        most = fmaxf(most, rgb_luminance(row_of(image, band)[x]));
    }
    return most;
}

struct environment_table *environment_table_make(const struct image *image)
{
    struct environment_table *t = mem_alloc(1, sizeof *t);
    size_t count = (size_t)image->height + 1;
    float *light = mem_alloc(count, sizeof *light);
    t->brightest = mem_alloc(count, sizeof *t->brightest);
    for (size_t i = 0; i < count; i++) {
        double band = band_light(image, (int)i);
        light[i] = (float)band;
        t->total += band;
        t->brightest[i] = brightest_of(image, (int)i);
    }
    t->bands = distribution_1d_make(light, (uint32_t)count);
    mem_free(light);
    return t;
}

void environment_table_free(struct environment_table *table)
{
    if (table == NULL)
        return;
    distribution_1d_free(&table->bands);
    mem_free(table->brightest);
    mem_free(table);
}

static rgb blend(rgb a, rgb b, float share)
{
    return rgb_make(a.r + share * (b.r - a.r), a.g + share * (b.g - a.g),
                    a.b + share * (b.b - a.b));
}

static rgb local_radiance(const struct image *image, vec3 d)
{
    float across = sqrtf(d.x * d.x + d.y * d.y);
    float y = atan2f(across, d.z) / PI * (float)image->height - 0.5f;
    float x = atan2f(d.y, d.x) / (2.0f * PI) * (float)image->width - 0.5f;
    int column = (int)floorf(x), row = (int)floorf(y);
    float a = x - (float)column, b = y - (float)row;
    column = (column % image->width + image->width) % image->width;
    int next = (column + 1) % image->width;
    const rgb *upper = row_of(image, row), *lower = row_of(image, row + 1);
    return blend(blend(upper[column], upper[next], a),
                 blend(lower[column], lower[next], a), b);
}

static vec3 local_direction(const struct environment *e, vec3 d)
{
    const float(*m)[4] = e->to_world.inverse;
    vec3 x = {m[0][0], m[0][1], m[0][2]}, y = {m[1][0], m[1][1], m[1][2]};
    vec3 z = {m[2][0], m[2][1], m[2][2]};
    return vec3_make(vec3_dot(x, d), vec3_dot(y, d), vec3_dot(z, d));
}

rgb environment_radiance(const struct environment *e, vec3 direction)
{
    vec3 local = local_direction(e, direction);
    return rgb_scale(local_radiance(e->image, local), e->scale);
}

float environment_pdf(const struct environment *e, vec3 direction)
{
    rgb light = local_radiance(e->image, local_direction(e, direction));
    if (!(e->table->total > 0.0))
        return 0.0f;
    return (float)((double)rgb_luminance(light) / e->table->total);
}

static vec3 try_direction(const struct image *image, int band, uint64_t key,
                          uint32_t number)
{
    double upper = cos(theta_at(image, band - 1));
    double lower = cos(theta_at(image, band));
    double z = upper + (double)random_float(key, number) * (lower - upper);
    float phi = 2.0f * PI * random_float(key, number + 1);
    float side = (float)sqrt(fmax(0.0, 1.0 - z * z));
    return vec3_make(side * cosf(phi), side * sinf(phi), (float)z);
}

static uint64_t hash_of(vec2 random)
{
    uint32_t x, y;
    memcpy(&x, &random.x, sizeof x);
    memcpy(&y, &random.y, sizeof y);
    return random_key(x, y, 9);
}

float environment_sample(const struct environment *e, vec2 random,
                         vec3 *direction)
{
    const struct environment_table *t = e->table;
    uint64_t key = hash_of(random);
    int band = (int)distribution_1d_sample(&t->bands, random.y, NULL);
    vec3 local = {0.0f, 0.0f, 1.0f};
    for (uint32_t i = 0; i < TRIES && t->total > 0.0; i++) {
        local = try_direction(e->image, band, key, 3 * i);
        float chance = random_float(key, 3 * i + 2) * t->brightest[band];
        if (chance < rgb_luminance(local_radiance(e->image, local)))
            break;
    }
    *direction = vec3_normalize(transform_direction(&e->to_world, local));
    return environment_pdf(e, *direction);
}
