/* distribution.c - see distribution.h. */
#include "sampling/distribution.h"

#include <stddef.h>

#include "base/memory.h"
#include "base/minmax.h"
#include "sampling/warp.h"

//> distribution.sums: Turn weights into running sums
static struct distribution_1d start(uint32_t count)
{
    struct distribution_1d d = {count, NULL, 0.0, 0, NULL};
    d.cdf = mem_alloc((size_t)count + 1, sizeof *d.cdf);
    return d;
}

/* Turns running sums into a table from 0 to 1. */
static void normalize(struct distribution_1d *d)
{
    d->total = d->cdf[d->count];
    bool empty = !(d->total > 0.0);
    for (uint32_t i = 1; i <= d->count; i++)
        d->cdf[i] = empty ? (double)i / d->count : d->cdf[i] / d->total;
}

/* About as many parts as cells; but random numbers are multiples of 2^-24, and
 * finer parts would be of no use. */
static void make_guide(struct distribution_1d *d)
{
    uint32_t cell = 0;
    d->parts = 1;
    while (d->parts < d->count && d->parts < UINT32_C(1) << 24)
        d->parts *= 2;
    d->guide = mem_alloc(d->parts, sizeof *d->guide);
    for (uint32_t i = 0; i < d->parts; i++) {
        while (cell + 1 < d->count && d->cdf[cell + 1] <= (double)i / d->parts)
            cell++;
        d->guide[i] = cell;
    }
}

static void finish(struct distribution_1d *d)
{
    normalize(d);
    make_guide(d);
}

struct distribution_1d distribution_1d_make(const float weights[],
                                            uint32_t count)
{
    struct distribution_1d d = start(count);
    for (uint32_t i = 0; i < count; i++)
        d.cdf[i + 1] = d.cdf[i] + (double)weights[i];
    finish(&d);
    return d;
}
//< distribution.sums

//> distribution.pick: Find the cell that holds a number
/* The last cell that starts at or before random. A cell of weight 0 ends where
 * it starts, so a later one is found instead; since random is below 1, which
 * is where all cells end, there is one. */
static uint32_t find_cell(const struct distribution_1d *d, float random)
{
    float inside = float_min(float_max(random, 0.0f), ONE_MINUS_EPSILON);
    uint32_t cell = d->guide[(uint32_t)(inside * (float)d->parts)];
    while (d->cdf[cell + 1] <= (double)inside)
        cell++;
    return cell;
}

uint32_t distribution_1d_sample(const struct distribution_1d *d, float random,
                                float *remainder)
{
    uint32_t cell = find_cell(d, random);
    double start = d->cdf[cell], width = d->cdf[cell + 1] - start;
    float inside = (float)(((double)random - start) / width);
    if (remainder != NULL)
        *remainder = float_min(inside, ONE_MINUS_EPSILON);
    return cell;
}
//< distribution.pick

float distribution_1d_probability(const struct distribution_1d *d,
                                  uint32_t cell)
{
    return (float)(d->cdf[cell + 1] - d->cdf[cell]);
}

void distribution_1d_free(struct distribution_1d *d)
{
    mem_free(d->cdf);
    mem_free(d->guide);
    d->cdf = NULL;
    d->guide = NULL;
    d->count = 0;
}

//> distribution.square: Pick a row, then a column
/* How likely each row is: by the sum of its weights. */
static struct distribution_1d pick_rows(const struct distribution_1d *columns,
                                        uint32_t height)
{
    struct distribution_1d d = start(height);
    for (uint32_t y = 0; y < height; y++)
        d.cdf[y + 1] = d.cdf[y] + columns[y].total;
    finish(&d);
    return d;
}

struct distribution_2d distribution_2d_make(const float weights[],
                                            uint32_t width, uint32_t height)
{
    struct distribution_2d d = {width, height, {0}, NULL};
    d.columns = mem_alloc(height, sizeof *d.columns);
    for (uint32_t y = 0; y < height; y++)
        d.columns[y] = distribution_1d_make(weights + (size_t)y * width, width);
    d.rows = pick_rows(d.columns, height);
    return d;
}

void distribution_2d_pick(const struct distribution_2d *d, vec2 random,
                          uint32_t *column, uint32_t *row, vec2 *remainder)
{
    *row = distribution_1d_sample(&d->rows, random.y, &remainder->y);
    *column =
        distribution_1d_sample(&d->columns[*row], random.x, &remainder->x);
}
//< distribution.square

//> distribution.density: Turn a cell into a density
static float density(const struct distribution_2d *d, uint32_t column,
                     uint32_t row)
{
    float cell = distribution_1d_probability(&d->rows, row) *
                 distribution_1d_probability(&d->columns[row], column);
    return cell * (float)d->width * (float)d->height;
}

/* The cell of a coordinate in [0, 1]. */
static uint32_t cell_of(float coordinate, uint32_t count)
{
    float cell = float_max(0.0f, coordinate * (float)count);
    return cell < (float)count ? (uint32_t)cell : count - 1;
}

/* The coordinate in a cell; rounding must not carry it into the next one. */
static float coordinate_in(uint32_t cell, float remainder, uint32_t count)
{
    float middle = ((float)cell + 0.5f) / (float)count;
    float at = ((float)cell + remainder) / (float)count;
    while (cell_of(at, count) != cell && at != middle)
        at = nextafterf(at, middle);
    return at;
}

float distribution_2d_sample(const struct distribution_2d *d, vec2 random,
                             vec2 *point)
{
    uint32_t column, row;
    vec2 in_cell;
    distribution_2d_pick(d, random, &column, &row, &in_cell);
    point->x = coordinate_in(column, in_cell.x, d->width);
    point->y = coordinate_in(row, in_cell.y, d->height);
    return density(d, column, row);
}

float distribution_2d_pdf(const struct distribution_2d *d, vec2 point)
{
    return density(d, cell_of(point.x, d->width), cell_of(point.y, d->height));
}
//< distribution.density

void distribution_2d_free(struct distribution_2d *d)
{
    for (uint32_t y = 0; y < d->height; y++)
        distribution_1d_free(&d->columns[y]);
    distribution_1d_free(&d->rows);
    mem_free(d->columns);
    d->columns = NULL;
    d->height = 0;
}
