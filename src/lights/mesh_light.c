/* mesh_light.c - see mesh_light.h. */
#include "lights/mesh_light.h"

#include "base/memory.h"
#include "sampling/warp.h"

/* Twice the area long, along the geometric normal. */
static vec3 double_area(const struct mesh *m, uint32_t triangle)
{
    vec3 p[3];
    mesh_corners(m, triangle, p);
    return vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
}

struct distribution_1d mesh_light_table(const struct mesh *m, float *area)
{
    uint32_t count = m->triangle_count;
    float *areas = mem_alloc(count, sizeof *areas);
    for (uint32_t i = 0; i < count; i++) {
        float size = 0.5f * vec3_length(double_area(m, i));
        areas[i] = isfinite(size) ? size : 0.0f;
    }
    struct distribution_1d table = distribution_1d_make(areas, count);
    mem_free(areas);
    *area = (float)table.total;
    return table;
}

vec3 mesh_light_place(const struct mesh *m,
                      const struct distribution_1d *triangles, vec2 random,
                      vec3 *normal)
{
    vec3 p[3];
    uint32_t i = distribution_1d_sample(triangles, random.x, &random.x);
    vec2 b = warp_triangle(random);
    mesh_corners(m, i, p);
    *normal = vec3_normalize(double_area(m, i));
    vec3 place = vec3_step(p[0], b.x, vec3_sub(p[1], p[0]));
    return vec3_step(place, b.y, vec3_sub(p[2], p[0]));
}

float mesh_light_longest_edge(const struct mesh *m)
{
    float longest = 0.0f;
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        vec3 p[3];
        mesh_corners(m, i, p);
        for (int k = 0; k < 3; k++)
            longest =
                fmaxf(longest, vec3_length(vec3_sub(p[k], p[(k + 1) % 3])));
    }
    return isfinite(longest) ? longest : 0.0f;
}
