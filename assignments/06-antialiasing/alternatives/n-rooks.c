/* N rooks (P. Shirley, "Discrepancy as a Quality Measure for Sample
 * Distributions", Eurographics 1991): n columns and n rows, and in each of them
 * one sample. The row of a column is a multiplication modulo n, and a shift that is
 * another one in each pixel. */
#include "camera/pixel_sampling.h"

static uint32_t greatest_common_divisor(uint32_t a, uint32_t b)
{
    while (b != 0) {
        uint32_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* Near the golden section of n, and without a common divisor. */
static uint32_t stride(uint32_t n)
{
    uint32_t k = (uint32_t)(0.618 * (double)n);
    while (k > 1 && greatest_common_divisor(k, n) != 1)
        k--;
    return k > 0 ? k : 1;
}

struct pixel_sample pixel_sample(const struct filter *filter, int x, int y,
                                 struct sample_number number, vec2 random)
{
    struct pixel_sample s;
    uint32_t n = number.count;
    uint64_t steps = (uint64_t)number.index * stride(n) + number.shared % n;
    vec2 u = vec2_make(((float)number.index + random.x) / (float)n,
                       ((float)(steps % n) + random.y) / (float)n);
    vec2 moved = filter_sample(filter, u, &s.weight);
    s.place = vec2_make(moved.x + (float)x + 0.5f, moved.y + (float)y + 0.5f);
    return s;
}

/* Keeps the running mean, so that sums of any length are of one size. */
void pixel_add(struct pixel_sums *sums, rgb radiance, float weight)
{
    double n = (double)++sums->samples, w = (double)weight;
    sums->weight += (w - sums->weight) / n;
    sums->sum[0] += (w * (double)radiance.r - sums->sum[0]) / n;
    sums->sum[1] += (w * (double)radiance.g - sums->sum[1]) / n;
    sums->sum[2] += (w * (double)radiance.b - sums->sum[2]) / n;
}

rgb pixel_value(const struct pixel_sums *sums)
{
    double mean = sums->weight > 0.1 ? sums->weight : 1.0;
    return rgb_make((float)(sums->sum[0] / mean), (float)(sums->sum[1] / mean),
                    (float)(sums->sum[2] / mean));
}
