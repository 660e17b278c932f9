/* Hammersley's points, shaken: the first coordinate counts up, the second is
 * the same number with its binary digits in reverse, some of them flipped, others
 * in each pixel. Each point moves within its own n-th of the pixel. Where n is no power of two the second coordinate
 * is left to chance. */
#include "camera/pixel_sampling.h"

static uint32_t reversed(uint32_t i, uint32_t count)
{
    uint32_t out = 0;
    for (uint32_t bit = 1; bit < count; bit *= 2) {
        out = 2 * out + (i & 1u);
        i /= 2;
    }
    return out;
}

static float in_part(uint32_t part, uint32_t parts, float random)
{
    return fminf(((float)part + random) / (float)parts, 0x1.fffffep-1f);
}

struct pixel_sample pixel_sample(const struct filter *filter, int x, int y,
                                 struct sample_number number, vec2 random)
{
    struct pixel_sample s;
    uint32_t n = number.count;
    if ((n & (n - 1)) == 0) {
        uint32_t row = reversed(number.index, n) ^ (number.shared & (n - 1));
        random.x = in_part(number.index, n, random.x);
        random.y = in_part(row, n, random.y);
    }
    vec2 offset = filter_sample(filter, random, &s.weight);
    vec2 centre = vec2_make((float)x + 0.5f, (float)y + 0.5f);
    s.place = vec2_make(centre.x + offset.x, centre.y + offset.y);
    return s;
}

void pixel_add(struct pixel_sums *sums, rgb radiance, float weight)
{
    sums->samples++;
    sums->weight += (double)weight;
    sums->sum[0] += (double)(weight * radiance.r);
    sums->sum[1] += (double)(weight * radiance.g);
    sums->sum[2] += (double)(weight * radiance.b);
}

rgb pixel_value(const struct pixel_sums *sums)
{
    double n = sums->samples, w = sums->weight;
    if (n == 0.0)
        return rgb_make(0.0f, 0.0f, 0.0f);
    w = w > 0.1 * n ? w : n;
    return rgb_make((float)(sums->sum[0] / w), (float)(sums->sum[1] / w),
                    (float)(sums->sum[2] / w));
}
