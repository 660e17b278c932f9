/* points.c - prints points of one pixel: points KIND COUNT, KIND as in
 * sampler_names. Each line has the coordinates of one point. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sampling/sampler.h"

static int print_points(enum sampler_kind kind, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        struct sampler s = sampler_start(kind, 1, 7, i, count);
        vec2 p = sampler_2d(&s);
        printf("%.9g %.9g\n", (double)p.x, (double)p.y);
    }
    return 0;
}

int main(int argc, char **argv)
{
    for (int kind = 0; argc == 3 && sampler_names[kind] != NULL; kind++)
        if (strcmp(argv[1], sampler_names[kind]) == 0)
            return print_points((enum sampler_kind)kind,
                                (uint32_t)strtoul(argv[2], NULL, 10));
    fprintf(stderr, "usage: points KIND COUNT\n");
    return 2;
}
