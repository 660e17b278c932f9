/* Places evenly over the filter's reach, and weights that do the rest. */
#include "camera/pixel_sampling.h"

struct pixel_sample pixel_sample(const struct filter *filter, int x, int y,
                                 struct sample_number number, vec2 random)
{
    float r = filter->radius;
    float dx = (2.0f * random.x - 1.0f) * r;
    float dy = (2.0f * random.y - 1.0f) * r;
    float mean = filter->integral / (2.0f * r);
    struct pixel_sample s;
    (void)number;
    s.place = vec2_make((float)x + 0.5f + dx, (float)y + 0.5f + dy);
    s.weight =
        filter_value(filter, dx) / mean * (filter_value(filter, dy) / mean);
    return s;
}

void pixel_add(struct pixel_sums *sums, rgb radiance, float weight)
{
    rgb weighted = rgb_scale(radiance, weight);
    sums->sum[0] += (double)weighted.r;
    sums->sum[1] += (double)weighted.g;
    sums->sum[2] += (double)weighted.b;
    sums->weight += (double)weight;
    sums->samples += 1;
}

rgb pixel_value(const struct pixel_sums *sums)
{
    double n = (double)sums->samples;
    double divisor = sums->weight < 0.1 * n ? n : sums->weight;
    if (sums->samples == 0)
        return rgb_grey(0.0f);
    return rgb_make((float)(sums->sum[0] / divisor),
                    (float)(sums->sum[1] / divisor),
                    (float)(sums->sum[2] / divisor));
}
