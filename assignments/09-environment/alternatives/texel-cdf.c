/* environment.c - assignment 09: one list of all texels with their running sum,
 * searched by halving. In a texel all directions are as likely. A texel's
 * weight is the mean of the blend over it times its solid angle. */
#include "lights/environment.h"

#include <stddef.h>

#include "base/memory.h"

static const double pi = 3.14159265358979323846;

struct environment_table {
    int width, height;
    double *sums; /* width x height + 1, from 0 to the sum of all weights */
};

static rgb pixel(const struct image *image, int x, int y)
{
    x = ((x % image->width) + image->width) % image->width;
    if (y < 0)
        y = 0;
    if (y >= image->height)
        y = image->height - 1;
    return image->pixels[y * image->width + x];
}

/* The mean of the blend over a texel: its neighbours count 1/8 each way. */
static double mean_luminance(const struct image *image, int x, int y)
{
    static const double share[3] = {0.125, 0.75, 0.125};
    double sum = 0.0;
    for (int i = -1; i <= 1; i++)
        for (int j = -1; j <= 1; j++)
            sum += share[i + 1] * share[j + 1] *
                   (double)rgb_luminance(pixel(image, x + i, y + j));
    return sum;
}

static double solid_angle(int width, int height, int row)
{
    double upper = cos(pi * row / height), lower = cos(pi * (row + 1) / height);
    return 2.0 * pi / width * (upper - lower);
}

struct environment_table *environment_table_make(const struct image *image)
{
    struct environment_table *t = mem_alloc(1, sizeof *t);
    int count = image->width * image->height;
    t->width = image->width;
    t->height = image->height;
    t->sums = mem_alloc((size_t)count + 1, sizeof *t->sums);
    for (int i = 0; i < count; i++) {
        int x = i % image->width, y = i / image->width;
        t->sums[i + 1] =
            t->sums[i] + mean_luminance(image, x, y) *
                             solid_angle(image->width, image->height, y);
    }
    return t;
}

void environment_table_free(struct environment_table *table)
{
    if (table)
        mem_free(table->sums);
    mem_free(table);
}

/* Texel coordinates, from 0 to width and to height. */
static void locate(const struct environment *e, vec3 d, double *x, double *y)
{
    const float(*m)[4] = e->to_world.m;
    /* The inverse of a rotation is its transpose. */
    double lx =
        (double)m[0][0] * d.x + (double)m[1][0] * d.y + (double)m[2][0] * d.z;
    double ly =
        (double)m[0][1] * d.x + (double)m[1][1] * d.y + (double)m[2][1] * d.z;
    double lz =
        (double)m[0][2] * d.x + (double)m[1][2] * d.y + (double)m[2][2] * d.z;
    double phi = atan2(ly, lx);
    if (phi < 0.0)
        phi += 2.0 * pi;
    *x = phi / (2.0 * pi) * e->image->width;
    *y = atan2(sqrt(lx * lx + ly * ly), lz) / pi * e->image->height;
}

rgb environment_radiance(const struct environment *e, vec3 direction)
{
    double x, y;
    locate(e, direction, &x, &y);
    x -= 0.5;
    y -= 0.5;
    int column = (int)floor(x), row = (int)floor(y);
    float a = (float)(x - column), b = (float)(y - row);
    float weights[4] = {(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b};
    rgb sum = rgb_grey(0.0f);
    for (int i = 0; i < 4; i++)
        sum =
            rgb_add(sum, rgb_scale(pixel(e->image, column + i % 2, row + i / 2),
                                   weights[i]));
    return rgb_scale(sum, e->scale);
}

static float density(const struct environment_table *t, int texel)
{
    double all = t->sums[t->width * t->height];
    double weight = t->sums[texel + 1] - t->sums[texel];
    double solid = solid_angle(t->width, t->height, texel / t->width);
    return all > 0.0 ? (float)(weight / all / solid) : 0.0f;
}

/* The texel whose share of the sum holds the target. */
static int find(const struct environment_table *t, double target)
{
    int low = 0, high = t->width * t->height;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (t->sums[middle] <= target)
            low = middle;
        else
            high = middle;
    }
    return low;
}

float environment_sample(const struct environment *e, vec2 random,
                         vec3 *direction)
{
    const struct environment_table *t = e->table;
    double target = random.x * t->sums[t->width * t->height];
    int texel = find(t, target);
    double weight = t->sums[texel + 1] - t->sums[texel];
    double inside = weight > 0.0 ? (target - t->sums[texel]) / weight : 0.5;
    double phi = 2.0 * pi * (texel % t->width + inside) / t->width;
    int row = texel / t->width;
    double upper = cos(pi * row / t->height);
    double lower = cos(pi * (row + 1) / t->height);
    double z = upper + random.y * (lower - upper);
    double side = sqrt(fmax(0.0, 1.0 - z * z));
    vec3 local = {(float)(side * cos(phi)), (float)(side * sin(phi)), (float)z};
    *direction = vec3_normalize(transform_direction(&e->to_world, local));
    return density(t, texel);
}

float environment_pdf(const struct environment *e, vec3 direction)
{
    double x, y;
    locate(e, direction, &x, &y);
    int column = (int)x, row = (int)y;
    if (column >= e->image->width)
        column = e->image->width - 1;
    if (row >= e->image->height)
        row = e->image->height - 1;
    return density(e->table, row * e->image->width + column);
}
