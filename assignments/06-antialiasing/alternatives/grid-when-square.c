/* A square number of samples: each has its own cell of a grid, whatever the
 * scene's sampler does. Any other number: the random numbers as they come. */
#include "camera/pixel_sampling.h"

static uint32_t whole_root(uint32_t n)
{
    uint32_t root = (uint32_t)sqrt((double)n);
    return root * root == n ? root : 0;
}

struct pixel_sample pixel_sample(const struct filter *filter, int x, int y,
                                 struct sample_number number, vec2 random)
{
    struct pixel_sample s;
    uint32_t side = whole_root(number.count);
    if (side > 0) {
        random.x = ((float)(number.index % side) + random.x) / (float)side;
        random.y = ((float)(number.index / side) + random.y) / (float)side;
    }
    vec2 off = filter_sample(filter, random, &s.weight);
    s.place.x = (float)x + (0.5f + off.x);
    s.place.y = (float)y + (0.5f + off.y);
    return s;
}

void pixel_add(struct pixel_sums *sums, rgb radiance, float weight)
{
    const float c[3] = {radiance.r, radiance.g, radiance.b};
    for (int i = 0; i < 3; i++)
        sums->sum[i] += (double)c[i] * (double)weight;
    sums->weight += (double)weight;
    ++sums->samples;
}

rgb pixel_value(const struct pixel_sums *sums)
{
    float c[3] = {0.0f, 0.0f, 0.0f};
    double over = sums->weight;
    if (over <= 0.1 * (double)sums->samples)
        over = (double)sums->samples;
    for (int i = 0; i < 3 && sums->samples > 0; i++)
        c[i] = (float)(sums->sum[i] / over);
    return rgb_make(c[0], c[1], c[2]);
}
