/* test_density.h - for tests: does a sample function follow its density?
 *
 * The domain is cut into cells. The density is summed over each cell, the
 * samples are counted, and Pearson's chi-squared says whether the two fit.
 * Seeds are fixed, so a test gives the same answer each time; had they been
 * drawn freshly, a right pair would fail once in 1e8 times. */
#ifndef RAYBOOK_SAMPLING_TEST_DENSITY_H
#define RAYBOOK_SAMPLING_TEST_DENSITY_H

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "base/vec.h"
#include "sampling/random.h"

/* sample: false where a pick failed; those are a cell of their own, which is to
 * hold failed_share of all.
 *
 * The domain is the rectangle lower..upper of the plane z = 0 or, if axis is
 * not zero, the directions within a cone around it (1 - cosine up to
 * one_minus_cosine). In each cell the density is taken at subdivisions^2
 * places. */
struct density_test {
    const void *context;
    bool (*sample)(const void *context, vec2 random, vec3 *point);
    double (*pdf)(const void *context, vec3 point);
    vec3 axis;
    double one_minus_cosine;
    double failed_share;
    vec2 lower, upper;
    int rows, columns, subdivisions, samples;
};

/* chi_squared is to be below limit; outside counts samples beyond the domain.
 * integral is that of the density over the domain. */
struct density_result {
    double integral, chi_squared, limit;
    int outside;
};

static inline vec3 density_point(const struct density_test *t, double s,
                                 double v)
{
    vec3 x, y;
    if (vec3_length(t->axis) == 0.0f)
        return vec3_make(t->lower.x + (float)s * (t->upper.x - t->lower.x),
                         t->lower.y + (float)v * (t->upper.y - t->lower.y),
                         0.0f);
    vec3_frame(t->axis, &x, &y);
    double below = v * t->one_minus_cosine, phi = 2.0 * acos(-1.0) * s;
    double side = sqrt(below * (2.0 - below));
    vec3 across = vec3_add(vec3_scale(x, (float)(side * cos(phi))),
                           vec3_scale(y, (float)(side * sin(phi))));
    return vec3_step(across, (float)(1.0 - below), t->axis);
}

static inline double density_domain(const struct density_test *t)
{
    if (vec3_length(t->axis) > 0.0f)
        return 2.0 * acos(-1.0) * t->one_minus_cosine;
    return (double)(t->upper.x - t->lower.x) * (t->upper.y - t->lower.y);
}

/* The inverse of density_point; s and v in [0, 1) inside the domain. */
static inline void density_coordinates(const struct density_test *t, vec3 p,
                                       double *s, double *v)
{
    if (vec3_length(t->axis) == 0.0f) {
        *s = (double)(p.x - t->lower.x) / (t->upper.x - t->lower.x);
        *v = (double)(p.y - t->lower.y) / (t->upper.y - t->lower.y);
        return;
    }
    vec3 x, y;
    vec3_frame(t->axis, &x, &y);
    double a = vec3_dot(p, x), b = vec3_dot(p, y), c = vec3_dot(p, t->axis);
    double side = a * a + b * b;
    *s = atan2(b, a) / (2.0 * acos(-1.0));
    *s += *s < 0.0 ? 1.0 : 0.0;
    *v = (c > 0.0 ? side / (1.0 + c) : 1.0 - c) / t->one_minus_cosine;
}

/* The mean of the density over a cell. */
static inline double density_of_cell(const struct density_test *t, int row,
                                     int column)
{
    int n = t->subdivisions;
    double sum = 0.0;
    for (int i = 0; i < n * n; i++) {
        double s = (column + (i % n + 0.5) / n) / t->columns;
        double v = (row + (i / n + 0.5) / n) / t->rows;
        sum += t->pdf(t->context, density_point(t, s, v));
    }
    return sum / (n * n);
}

/* Wilson and Hilferty's approximation of the quantile at 1 - 1e-8. */
static inline double chi_squared_limit(int degrees)
{
    double k = 2.0 / (9.0 * degrees);
    return degrees * pow(1.0 - k + 5.612 * sqrt(k), 3.0);
}

/* Cells that expect less than 10 are put together: chi-squared holds for large
 * numbers only. */
static inline void compare_counts(const double expected[],
                                  const double counted[], int cells,
                                  struct density_result *out)
{
    double rest_expected = 0.0, rest_counted = 0.0;
    int used = 0;
    for (int i = 0; i < cells; i++) {
        double difference = counted[i] - expected[i];
        if (expected[i] < 10.0) {
            rest_expected += expected[i];
            rest_counted += counted[i];
            continue;
        }
        out->chi_squared += difference * difference / expected[i];
        used++;
    }
    double difference = rest_counted - rest_expected;
    out->chi_squared += difference * difference / fmax(rest_expected, 1.0);
    out->limit = chi_squared_limit(used > 0 ? used : 1);
}

static inline void count_samples(const struct density_test *t, double counted[],
                                 struct density_result *out)
{
    int cells = t->rows * t->columns;
    for (int i = 0; i < t->samples; i++) {
        uint64_t key = random_key(1, 0, (uint64_t)i);
        vec2 random = vec2_make(random_float(key, 0), random_float(key, 1));
        vec3 point;
        double s, v;
        if (!t->sample(t->context, random, &point)) {
            counted[cells] += 1.0;
            continue;
        }
        density_coordinates(t, point, &s, &v);
        int column = (int)floor(s * t->columns), row = (int)floor(v * t->rows);
        if (row < 0 || row >= t->rows || column < 0 || column >= t->columns)
            out->outside++;
        else
            counted[row * t->columns + column] += 1.0;
    }
}

static inline struct density_result
density_compare(const struct density_test *t)
{
    struct density_result out = {0.0, 0.0, 0.0, 0};
    int cells = t->rows * t->columns;
    double *expected = calloc((size_t)cells + 1, sizeof *expected);
    double *counted = calloc((size_t)cells + 1, sizeof *counted);
    for (int i = 0; i < cells; i++) {
        double share = density_domain(t) / cells *
                       density_of_cell(t, i / t->columns, i % t->columns);
        out.integral += share;
        expected[i] = share * t->samples;
    }
    expected[cells] = t->failed_share * t->samples;
    count_samples(t, counted, &out);
    compare_counts(expected, counted, cells + 1, &out);
    free(expected);
    free(counted);
    return out;
}

#endif
