/* filter.c - see filter.h. */
#include "camera/filter.h"

#include <stddef.h>

#include "base/minmax.h"

const char *const filter_names[] = {"box", "tent", "gaussian", "mitchell",
                                    NULL};

//> filter.value: Evaluate the four filters
static float gaussian(const struct filter *f, float x)
{
    float edge = expf(-f->alpha * f->radius * f->radius);
    return float_max(0.0f, expf(-f->alpha * x * x) - edge);
}

/* Mitchell and Netravali's cubic, for 0 <= x <= 2. */
static float mitchell(const struct filter *f, float x)
{
    float b = f->b, c = f->c;
    if (x < 1.0f)
        return ((12.0f - 9.0f * b - 6.0f * c) * x * x * x +
                (-18.0f + 12.0f * b + 6.0f * c) * x * x + (6.0f - 2.0f * b)) /
               6.0f;
    return ((-b - 6.0f * c) * x * x * x + (6.0f * b + 30.0f * c) * x * x +
            (-12.0f * b - 48.0f * c) * x + (8.0f * b + 24.0f * c)) /
           6.0f;
}

float filter_value(const struct filter *f, float x)
{
    x = fabsf(x);
    if (!(x <= f->radius))
        return 0.0f;
    switch (f->kind) {
    case FILTER_TENT:
        return 1.0f - x / f->radius;
    case FILTER_GAUSSIAN:
        return gaussian(f, x);
    case FILTER_MITCHELL:
        return mitchell(f, 2.0f * x / f->radius);
    case FILTER_BOX:
        break;
    }
    return 1.0f;
}
//< filter.value

//> filter.table: Tabulate a filter
/* The middle of cell i. */
static float cell_place(const struct filter *f, float i)
{
    return f->radius * (2.0f * i / FILTER_CELLS - 1.0f);
}

struct filter filter_make(const struct film_settings *film)
{
    struct filter f = {film->filter, film->filter_radius,
                       film->alpha,  film->b,
                       film->c,      {0.0f},
                       1.0f,         1.0f};
    double sum = 0.0, signed_sum = 0.0, so_far[FILTER_CELLS + 1] = {0.0};
    for (int i = 0; i < FILTER_CELLS; i++) {
        double value = filter_value(&f, cell_place(&f, (float)i + 0.5f));
        sum += fabs(value);
        signed_sum += value;
        so_far[i + 1] = sum;
    }
    for (int i = 0; i <= FILTER_CELLS; i++)
        f.cdf[i] = (float)(so_far[i] / sum);
    f.mass = (float)(sum / signed_sum);
    f.integral = (float)(signed_sum * 2.0 * (double)f.radius / FILTER_CELLS);
    return f;
}
//< filter.table

//> filter.sample: Draw an offset from the table
/* The cell with cdf[cell] <= random < cdf[cell + 1], by halving. */
static int find_cell(const struct filter *f, float random)
{
    int low = 0, high = FILTER_CELLS;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (f->cdf[middle] <= random)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Of the filters only Mitchell and Netravali's has negative lobes. */
static bool is_negative(const struct filter *f, int cell)
{
    return f->kind == FILTER_MITCHELL &&
           filter_value(f, cell_place(f, (float)cell + 0.5f)) < 0.0f;
}

/* The density is constant in a cell: what the table says, not the function,
 * is what is sampled, and with 512 cells the two differ by less than 1e-3. */
static float sample_axis(const struct filter *f, float random, float *weight)
{
    int cell = find_cell(f, random);
    float width = f->cdf[cell + 1] - f->cdf[cell];
    float within = width > 0.0f ? (random - f->cdf[cell]) / width : 0.5f;
    *weight *= is_negative(f, cell) ? -f->mass : f->mass;
    return cell_place(f, (float)cell + within);
}

vec2 filter_sample(const struct filter *f, vec2 random, float *weight)
{
    *weight = 1.0f;
    if (f->kind == FILTER_BOX)
        return vec2_make(f->radius * (2.0f * random.x - 1.0f),
                         f->radius * (2.0f * random.y - 1.0f));
    float x = sample_axis(f, random.x, weight);
    float y = sample_axis(f, random.y, weight);
    return vec2_make(x, y);
}
//< filter.sample
