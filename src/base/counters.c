/* counters.c - see counters.h. */
#include "base/counters.h"

__thread struct counters counters_mine;

void counters_flush(struct counters *total)
{
    static const struct counters zero;
    total->camera_rays += counters_mine.camera_rays;
    total->specular_rays += counters_mine.specular_rays;
    total->bounce_rays += counters_mine.bounce_rays;
    total->shadow_rays += counters_mine.shadow_rays;
    total->boxes_tested += counters_mine.boxes_tested;
    total->leaves_visited += counters_mine.leaves_visited;
    total->primitives_tested += counters_mine.primitives_tested;
    total->samples += counters_mine.samples;
    counters_mine = zero;
}
