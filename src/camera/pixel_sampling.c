/* pixel_sampling.c - assignment 06: the samples of a pixel, and what becomes
 * of them.
 *
 * The contract is in pixel_sampling.h. */
#include "camera/pixel_sampling.h"

#include "base/todo.h"

//> pixel.sample: Choose where to look
struct pixel_sample pixel_sample(const struct filter *filter, int x, int y,
                                 struct sample_number number, vec2 random)
{
    struct pixel_sample sample;
    (void)number;
#ifndef TODO_pixel_sample
    /* Evenly spread numbers give evenly spread offsets: there is nothing left
     * to do with the sample's number. */
    vec2 offset = filter_sample(filter, random, &sample.weight);
    sample.place =
        vec2_make((float)x + 0.5f + offset.x, (float)y + 0.5f + offset.y);
#else
    /* TODO(pixel_sample): use the two random numbers to move the place off the
     * centre, as far as the filter reaches, and give it the weight that goes
     * with it. pixel_sampling.h says what must hold. */
    (void)filter, (void)random;
    TODO_WARN("06 antialiasing", "every sample at the pixel's centre");
    sample.place = vec2_make((float)x + 0.5f, (float)y + 0.5f);
    sample.weight = 1.0f;
#endif
    return sample;
}
//< pixel.sample

//> pixel.add: Gather a sample
void pixel_add(struct pixel_sums *sums, rgb radiance, float weight)
{
#ifndef TODO_pixel_add
    double w = (double)weight;
    sums->sum[0] += w * (double)radiance.r;
    sums->sum[1] += w * (double)radiance.g;
    sums->sum[2] += w * (double)radiance.b;
    sums->weight += w;
#else
    /* TODO(pixel_add): let the weight count, and gather the weights too. */
    (void)weight;
    TODO_WARN("06 antialiasing", "every sample counts alike");
    sums->sum[0] += (double)radiance.r;
    sums->sum[1] += (double)radiance.g;
    sums->sum[2] += (double)radiance.b;
#endif
    sums->samples++;
}
//< pixel.add

//> pixel.value: Average the samples
rgb pixel_value(const struct pixel_sums *sums)
{
#ifndef TODO_pixel_value
    double total = sums->weight;
    if (!(total > 0.1 * sums->samples))
        total = sums->samples;
#else
    /* TODO(pixel_value): divide by what the weights add up to. */
    double total = sums->samples;
    TODO_WARN("06 antialiasing", "dividing by the number of samples");
#endif
    double k = sums->samples > 0 ? 1.0 / total : 0.0;
    return rgb_make((float)(sums->sum[0] * k), (float)(sums->sum[1] * k),
                    (float)(sums->sum[2] * k));
}
//< pixel.value
