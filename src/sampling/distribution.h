/* distribution.h - picking by weight: tables over an interval, a square.
 *
 * Tables are in double: after a very bright cell the small steps of the dark
 * ones would be lost in float. */
#ifndef RAYBOOK_SAMPLING_DISTRIBUTION_H
#define RAYBOOK_SAMPLING_DISTRIBUTION_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

/* count cells of equal width over [0, 1), the density constant in each. The
 * distribution owns its tables.
 *
 * A number is looked up in guide first, which has cut the range into `parts` of
 * the same length and says in which cell each begins. From there the search
 * goes on cell by cell, on average by no more than count / parts steps, however
 * long the table: H. Chen and Y. Asau, "On Generating Random Variates from an
 * Empirical Distribution", AIIE Transactions 6(2), 1974. */
struct distribution_1d {
    uint32_t count;
    double *cdf;     /* count + 1 values from 0 to 1 */
    double total;    /* sum of the weights */
    uint32_t parts;  /* a power of two: cutting by it does not round */
    uint32_t *guide; /* parts cells */
};

/* From weights, none below 0; if all are 0 every cell is as likely. Release
 * with distribution_1d_free. */
struct distribution_1d distribution_1d_make(const float weights[],
                                            uint32_t count);

/* Picks a cell with a number in [0, 1); never one of weight 0. *remainder (may
 * be NULL) is where in the cell the number fell, in [0, 1): a fresh random
 * number. count must not be 0. */
uint32_t distribution_1d_sample(const struct distribution_1d *d, float random,
                                float *remainder);

/* The probability of a cell. */
float distribution_1d_probability(const struct distribution_1d *d,
                                  uint32_t cell);

void distribution_1d_free(struct distribution_1d *d);

/* width x height cells over the unit square, row by row. */
struct distribution_2d {
    uint32_t width, height;
    struct distribution_1d rows;     /* which row; its total is the sum of
                                        all weights */
    struct distribution_1d *columns; /* which column, for each row */
};

struct distribution_2d distribution_2d_make(const float weights[],
                                            uint32_t width, uint32_t height);

/* Picks a cell: random.y decides the row, random.x the column. *remainder is
 * where in the cell they fell, in [0, 1) x [0, 1). */
void distribution_2d_pick(const struct distribution_2d *d, vec2 random,
                          uint32_t *column, uint32_t *row, vec2 *remainder);

/* Picks a point of the unit square; returns its density there (over the
 * square, mean 1). */
float distribution_2d_sample(const struct distribution_2d *d, vec2 random,
                             vec2 *point);

/* The density at a point of the unit square. */
float distribution_2d_pdf(const struct distribution_2d *d, vec2 point);

void distribution_2d_free(struct distribution_2d *d);

#endif
