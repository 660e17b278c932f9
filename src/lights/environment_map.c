/* environment_map.c - see environment_map.h. */
#include "lights/environment_map.h"

#include <stddef.h>

#include "base/constants.h"

struct environment environment_make(const struct image *image, float scale,
                                    struct transform to_world)
{
    struct environment e = {image, scale, to_world, NULL};
    e.table = environment_table_make(image);
    return e;
}

/* The mean luminance of a row of texels; beyond the first and the last row
 * theirs goes on. */
static double row_luminance(const struct image *image, int row)
{
    int y = row < 0 ? 0 : row < image->height ? row : image->height - 1;
    const rgb *texels = image->pixels + (size_t)y * (size_t)image->width;
    double sum = 0.0;
    for (int x = 0; x < image->width; x++)
        sum += (double)rgb_luminance(texels[x]);
    return sum / image->width;
}

/* How high on a sphere of radius 1 the centres of a row are. */
static double row_height(const struct image *image, int row)
{
    double v = (row + 0.5) / image->height;
    return cos((double)PI * fmin(fmax(v, 0.0), 1.0));
}

/* Between the centres of two rows lies a band that has the mean of both. Its
 * share of the sphere is its share of the height (Archimedes). */
float environment_mean_luminance(const struct environment *e)
{
    double mean = 0.0, above = row_luminance(e->image, -1);
    for (int row = 0; row <= e->image->height; row++) {
        double here = row_luminance(e->image, row);
        double band = row_height(e->image, row - 1) - row_height(e->image, row);
        mean += 0.5 * band * 0.5 * (above + here);
        above = here;
    }
    return e->scale * (float)mean;
}

void environment_free(struct environment *e)
{
    environment_table_free(e->table);
    e->table = NULL;
}
