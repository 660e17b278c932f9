/* Each kind of filter by the way that suits it: a tent is a sum of two evenly
 * spread numbers, found by its inverse; the others as the framework has them.
 * Everything in double precision. */
#include "camera/pixel_sampling.h"

/* Where the share u of a tent over [-1, 1] lies to the left. */
static double tent_place(double u)
{
    return u < 0.5 ? sqrt(2.0 * u) - 1.0 : 1.0 - sqrt(2.0 - 2.0 * u);
}

struct pixel_sample pixel_sample(const struct filter *filter, int x, int y,
                                 struct sample_number number, vec2 random)
{
    double r = (double)filter->radius, dx, dy;
    float weight = 1.0f;
    (void)number;
    if (filter->kind == FILTER_BOX) {
        dx = r * (2.0 * (double)random.x - 1.0);
        dy = r * (2.0 * (double)random.y - 1.0);
    } else if (filter->kind == FILTER_TENT) {
        dx = r * tent_place((double)random.x);
        dy = r * tent_place((double)random.y);
    } else {
        vec2 offset = filter_sample(filter, random, &weight);
        dx = (double)offset.x;
        dy = (double)offset.y;
    }
    struct pixel_sample s = {
        vec2_make((float)(x + 0.5 + dx), (float)(y + 0.5 + dy)), weight};
    return s;
}

void pixel_add(struct pixel_sums *sums, rgb radiance, float weight)
{
    double w = (double)weight;
    sums->sum[0] = sums->sum[0] + w * (double)radiance.r;
    sums->sum[1] = sums->sum[1] + w * (double)radiance.g;
    sums->sum[2] = sums->sum[2] + w * (double)radiance.b;
    sums->weight = sums->weight + w;
    sums->samples = sums->samples + 1;
}

rgb pixel_value(const struct pixel_sums *sums)
{
    const double *sum = sums->sum;
    double k = 0.0;
    if (sums->weight > 0.1 * sums->samples)
        k = 1.0 / sums->weight;
    else if (sums->samples > 0)
        k = 1.0 / sums->samples;
    return rgb_make((float)(k * sum[0]), (float)(k * sum[1]),
                    (float)(k * sum[2]));
}
