/* environment.c - the reference, but every direction is as likely as the
 * next: what variance.py compares the luminance table with. */
#define environment_sample sample_by_luminance
#define environment_pdf pdf_by_luminance
#include "lights/environment.c"
#undef environment_sample
#undef environment_pdf

#include "sampling/warp.h"

float environment_pdf(const struct environment *e, vec3 direction)
{
    (void)e;
    return warp_sphere_pdf(direction);
}

float environment_sample(const struct environment *e, vec2 random,
                         vec3 *direction)
{
    *direction = warp_sphere(random);
    return environment_pdf(e, *direction);
}
