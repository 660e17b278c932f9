/* environment.c - assignment 09: the textbook's way. A table over u and v of
 * luminance times sin theta, and the density over them divided by 2 pi^2 sin
 * theta, what a square of u and v covers on the sphere. Each texel counts as the
 * mean of itself and its neighbours, so that none beside a bright one is
 * missed. */
#include "lights/environment.h"

#include "base/constants.h"
#include "base/memory.h"
#include "sampling/distribution.h"

struct environment_table {
    struct distribution_2d texels;
};

static float smooth_luminance(const struct image *image, int x, int y)
{
    float sum = 0.0f;
    for (int j = y - 1; j <= y + 1; j++)
        for (int i = x - 1; i <= x + 1; i++) {
            int row = j < 0 ? 0 : j > image->height - 1 ? image->height - 1 : j;
            int column = (i + image->width) % image->width;
            sum += rgb_luminance(image->pixels[row * image->width + column]);
        }
    return sum / 9.0f;
}

struct environment_table *environment_table_make(const struct image *image)
{
    struct environment_table *table = mem_alloc(1, sizeof *table);
    int width = image->width, height = image->height;
    float *weights = mem_alloc((size_t)width * (size_t)height, sizeof *weights);
    for (int y = 0; y < height; y++) {
        float sine = sinf(PI * ((float)y + 0.5f) / (float)height);
        for (int x = 0; x < width; x++)
            weights[y * width + x] = smooth_luminance(image, x, y) * sine;
    }
    table->texels =
        distribution_2d_make(weights, (uint32_t)width, (uint32_t)height);
    mem_free(weights);
    return table;
}

void environment_table_free(struct environment_table *table)
{
    if (!table)
        return;
    distribution_2d_free(&table->texels);
    mem_free(table);
}

static vec2 to_uv(const struct environment *e, vec3 d)
{
    /* Normals turn with the inverse transpose; a rotation's is itself. */
    struct transform back = e->to_world;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            back.m[i][j] = e->to_world.inverse[i][j];
    vec3 local = vec3_normalize(transform_direction(&back, d));
    float u = atan2f(local.y, local.x) / (2.0f * PI);
    float v = acosf(fminf(1.0f, fmaxf(-1.0f, local.z))) / PI;
    return vec2_make(u - floorf(u), v);
}

static rgb texel(const struct image *image, float x, float y)
{
    int column = (int)x % image->width, row = (int)y;
    return image->pixels[row * image->width + column];
}

rgb environment_radiance(const struct environment *e, vec3 direction)
{
    const struct image *image = e->image;
    float width = (float)image->width, last = (float)image->height - 1.0f;
    vec2 uv = to_uv(e, direction);
    float x = uv.x * width + width - 0.5f; /* a turn on: above 0 */
    float y = uv.y * (float)image->height - 0.5f;
    y = fminf(fmaxf(y, 0.0f), last);
    float x0 = floorf(x), y0 = floorf(y), a = x - x0, b = y - y0;
    float y1 = fminf(y0 + 1.0f, last);
    rgb upper = rgb_add(rgb_scale(texel(image, x0, y0), 1.0f - a),
                        rgb_scale(texel(image, x0 + 1.0f, y0), a));
    rgb lower = rgb_add(rgb_scale(texel(image, x0, y1), 1.0f - a),
                        rgb_scale(texel(image, x0 + 1.0f, y1), a));
    return rgb_scale(rgb_add(rgb_scale(upper, 1.0f - b), rgb_scale(lower, b)),
                     e->scale);
}

float environment_sample(const struct environment *e, vec2 random,
                         vec3 *direction)
{
    vec2 uv;
    float pdf = distribution_2d_sample(&e->table->texels, random, &uv);
    float theta = PI * uv.y, phi = 2.0f * PI * uv.x;
    float sine = fmaxf(sinf(theta), 1e-6f);
    vec3 local = vec3_make(sine * cosf(phi), sine * sinf(phi), cosf(theta));
    *direction = vec3_normalize(transform_direction(&e->to_world, local));
    return pdf / (2.0f * PI * PI * sine);
}

float environment_pdf(const struct environment *e, vec3 direction)
{
    vec2 uv = to_uv(e, direction);
    float sine = sinf(PI * uv.y);
    if (sine < 1e-6f)
        return 0.0f;
    return distribution_2d_pdf(&e->table->texels, uv) / (2.0f * PI * PI * sine);
}
