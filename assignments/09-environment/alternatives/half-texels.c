/* environment.c - assignment 09: a table of rows and columns, four cells a
 * texel. A cell's weight is the blend in its middle times its solid angle, by
 * which it is constant in each. All in double but the table's weights. */
#include "lights/environment.h"

#include "base/memory.h"
#include "sampling/distribution.h"

#define TURN 6.283185307179586476925

struct environment_table {
    struct distribution_2d cells; /* 2 width x 2 height */
};

struct spot {
    double u, v;
};

static rgb weighted(const struct image *image, int x, int y, double share)
{
    int row = y < 0 ? 0 : y < image->height ? y : image->height - 1;
    int column = x % image->width;
    column += column < 0 ? image->width : 0;
    return rgb_scale(image->pixels[row * image->width + column], (float)share);
}

static rgb look_up(const struct image *image, struct spot at)
{
    double x = at.u * image->width - 0.5, y = at.v * image->height - 0.5;
    int i = (int)floor(x), j = (int)floor(y);
    double a = x - i, b = y - j;
    rgb upper = rgb_add(weighted(image, i, j, (1.0 - a) * (1.0 - b)),
                        weighted(image, i + 1, j, a * (1.0 - b)));
    rgb lower = rgb_add(weighted(image, i, j + 1, (1.0 - a) * b),
                        weighted(image, i + 1, j + 1, a * b));
    return rgb_add(upper, lower);
}

/* Of one of `rows` equal steps in v, all round. */
static double band(uint32_t row, uint32_t rows)
{
    double middle = 0.5 * TURN * (row + 0.5) / rows, step = 0.5 * TURN / rows;
    return TURN * 2.0 * sin(middle) * sin(0.5 * step);
}

struct environment_table *environment_table_make(const struct image *image)
{
    uint32_t columns = 2 * (uint32_t)image->width;
    uint32_t rows = 2 * (uint32_t)image->height;
    struct environment_table *t = mem_alloc(1, sizeof *t);
    float *weights = mem_alloc((size_t)columns * rows, sizeof *weights);
    for (uint32_t i = 0; i < columns * rows; i++) {
        struct spot middle = {(i % columns + 0.5) / columns,
                              ((double)(i / columns) + 0.5) / rows};
        double light = (double)rgb_luminance(look_up(image, middle));
        weights[i] = (float)(light * band(i / columns, rows));
    }
    t->cells = distribution_2d_make(weights, columns, rows);
    mem_free(weights);
    return t;
}

void environment_table_free(struct environment_table *table)
{
    if (table) {
        distribution_2d_free(&table->cells);
        mem_free(table);
    }
}

static struct spot spot_of(const struct environment *e, vec3 d)
{
    double local[3];
    for (int i = 0; i < 3; i++)
        local[i] = (double)e->to_world.inverse[i][0] * d.x +
                   (double)e->to_world.inverse[i][1] * d.y +
                   (double)e->to_world.inverse[i][2] * d.z;
    double phi = atan2(local[1], local[0]);
    double across = hypot(local[0], local[1]);
    struct spot at = {phi < 0.0 ? phi / TURN + 1.0 : phi / TURN,
                      atan2(across, local[2]) / (0.5 * TURN)};
    return at;
}

rgb environment_radiance(const struct environment *e, vec3 direction)
{
    return rgb_scale(look_up(e->image, spot_of(e, direction)), e->scale);
}

static float density_of(const struct distribution_2d *d, uint32_t column,
                        uint32_t row)
{
    if (!(d->rows.total > 0.0))
        return 0.0f;
    double share =
        (double)distribution_1d_probability(&d->rows, row) *
        (double)distribution_1d_probability(&d->columns[row], column);
    return (float)(share * d->width / band(row, d->height));
}

float environment_sample(const struct environment *e, vec2 random,
                         vec3 *direction)
{
    const struct distribution_2d *d = &e->table->cells;
    uint32_t column, row;
    vec2 rest;
    distribution_2d_pick(d, random, &column, &row, &rest);
    double upper = cos(0.5 * TURN * row / d->height);
    double lower = cos(0.5 * TURN * (row + 1) / d->height);
    double z = upper + (double)rest.y * (lower - upper);
    double phi = TURN * (column + (double)rest.x) / d->width;
    double across = sqrt(fmax(0.0, 1.0 - z * z));
    vec3 local = vec3_make((float)(across * cos(phi)),
                           (float)(across * sin(phi)), (float)z);
    *direction = vec3_normalize(transform_direction(&e->to_world, local));
    return density_of(d, column, row);
}

float environment_pdf(const struct environment *e, vec3 direction)
{
    const struct distribution_2d *d = &e->table->cells;
    struct spot at = spot_of(e, direction);
    uint32_t column = (uint32_t)(at.u * d->width);
    uint32_t row = (uint32_t)(at.v * d->height);
    column = column < d->width ? column : d->width - 1;
    row = row < d->height ? row : d->height - 1;
    return density_of(d, column, row);
}
