/* mesh.c - see mesh.h. */
#include "shapes/mesh.h"

#include <string.h>

#include "base/constants.h"
#include "base/memory.h"

void mesh_corners(const struct mesh *m, uint32_t triangle, vec3 corners[3])
{
    const uint32_t *index = &m->indices[3 * (size_t)triangle];
    for (int i = 0; i < 3; i++)
        corners[i] = m->positions[index[i]];
}

static void mesh_uvs(const struct mesh *m, uint32_t triangle, vec2 uv[3])
{
    static const vec2 barycentric[3] = {{0, 0}, {1, 0}, {0, 1}};
    const uint32_t *index = &m->indices[3 * (size_t)triangle];
    for (int i = 0; i < 3; i++)
        uv[i] = m->uvs != NULL ? m->uvs[index[i]] : barycentric[i];
}

static vec3 blend(const vec3 v[3], const float b[3])
{
    return vec3_step(vec3_step(vec3_scale(v[0], b[0]), b[1], v[1]), b[2], v[2]);
}

/* The position is a sum of three products: each of its three terms passes
 * through at most 7 roundings, b0 = 1 - b1 - b2 included. */
static vec3 blend_error(const vec3 v[3], const float b[3])
{
    const vec3 size[3] = {vec3_abs(v[0]), vec3_abs(v[1]), vec3_abs(v[2])};
    const float weight[3] = {fabsf(b[0]), fabsf(b[1]), fabsf(b[2])};
    return vec3_scale(blend(size, weight), rounding_bound(7));
}

static vec3 smooth_normal(const struct mesh *m, uint32_t triangle,
                          const float b[3], vec3 geometric)
{
    if (m->normals == NULL)
        return geometric;
    const uint32_t *index = &m->indices[3 * (size_t)triangle];
    const vec3 corner[3] = {m->normals[index[0]], m->normals[index[1]],
                            m->normals[index[2]]};
    vec3 n = blend(corner, b);
    float length = vec3_length(n);
    if (!(length > 0.0f))
        return geometric; /* opposite normals cancelled */
    n = vec3_scale(n, 1.0f / length);
    return vec3_dot(n, geometric) < 0.0f ? vec3_negate(n) : n;
}

/* The shading normal turns as the unnormalized blend of the vertex normals
 * does, less what only changes its length. It is found by the same 2x2
 * relation as the differentials of the position. */
static void normal_differentials(const struct mesh *m, uint32_t triangle,
                                 const vec2 uv[3], const float b[3],
                                 struct surface *out)
{
    if (m->normals == NULL)
        return;
    const uint32_t *index = &m->indices[3 * (size_t)triangle];
    const vec3 corner[3] = {m->normals[index[0]], m->normals[index[1]],
                            m->normals[index[2]]};
    vec3 n = out->shading_normal, du, dv;
    float length = vec3_dot(blend(corner, b), n); /* below 0: n was turned */
    if (!triangle_uv_differentials(corner, uv, &du, &dv))
        return;
    du = vec3_scale(du, 1.0f / length);
    dv = vec3_scale(dv, 1.0f / length);
    out->dn_du = vec3_step(du, -vec3_dot(du, n), n);
    out->dn_dv = vec3_step(dv, -vec3_dot(dv, n), n);
}

static void position_differentials(const vec3 p[3], const vec2 uv[3],
                                   struct surface *out)
{
    if (!triangle_uv_differentials(p, uv, &out->dp_du, &out->dp_dv))
        vec3_frame(out->geometric_normal, &out->dp_du, &out->dp_dv);
}

/* In double precision: the cross product of edges of 10^10 metres has a square
 * that no float can hold, and so has one of 10^-10. */
static vec3 unit_normal(const vec3 p[3])
{
    double a[3] = {(double)p[1].x - p[0].x, (double)p[1].y - p[0].y,
                   (double)p[1].z - p[0].z};
    double b[3] = {(double)p[2].x - p[0].x, (double)p[2].y - p[0].y,
                   (double)p[2].z - p[0].z};
    double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                   a[0] * b[1] - a[1] * b[0]};
    double k = 1.0 / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return vec3_make((float)(k * n[0]), (float)(k * n[1]), (float)(k * n[2]));
}

void mesh_surface(const struct mesh *m, uint32_t triangle,
                  const struct triangle_hit *hit, struct surface *out)
{
    static const struct surface nothing;
    vec3 p[3];
    vec2 uv[3];
    const float b[3] = {1.0f - hit->b1 - hit->b2, hit->b1, hit->b2};
    *out = nothing;
    mesh_corners(m, triangle, p);
    mesh_uvs(m, triangle, uv);
    out->position = blend(p, b);
    out->position_error = blend_error(p, b);
    out->geometric_normal = unit_normal(p);
    out->shading_normal = smooth_normal(m, triangle, b, out->geometric_normal);
    out->uv = vec2_make(b[0] * uv[0].x + b[1] * uv[1].x + b[2] * uv[2].x,
                        b[0] * uv[0].y + b[1] * uv[1].y + b[2] * uv[2].y);
    position_differentials(p, uv, out);
    normal_differentials(m, triangle, uv, b, out);
}

/* A mirror turns every winding round; turn it back, so that the geometric
 * normals stay on the side where they were. */
static void reverse_winding(struct mesh *m)
{
    for (size_t i = 0; i < 3 * (size_t)m->triangle_count; i += 3) {
        uint32_t swap = m->indices[i + 1];
        m->indices[i + 1] = m->indices[i + 2];
        m->indices[i + 2] = swap;
    }
}

void mesh_transform(struct mesh *m, const struct transform *to_world)
{
    if (transform_mirrors(to_world))
        reverse_winding(m);
    for (uint32_t i = 0; i < m->vertex_count; i++) {
        m->positions[i] = transform_point(to_world, m->positions[i]);
        if (m->normals == NULL)
            continue;
        vec3 n = transform_normal(to_world, m->normals[i]);
        float length = vec3_length(n);
        m->normals[i] = length > 0.0f ? vec3_scale(n, 1.0f / length) : n;
    }
}

/* NULL if there is nothing to copy. */
static void *copy(const void *items, size_t count, size_t size)
{
    if (items == NULL)
        return NULL;
    return memcpy(mem_alloc(count, size), items, count * size);
}

struct mesh mesh_copy(const struct mesh *m)
{
    struct mesh out = *m;
    size_t vertices = m->vertex_count, corners = 3 * (size_t)m->triangle_count;
    out.positions = copy(m->positions, vertices, sizeof *m->positions);
    out.normals = copy(m->normals, vertices, sizeof *m->normals);
    out.uvs = copy(m->uvs, vertices, sizeof *m->uvs);
    out.indices = copy(m->indices, corners, sizeof *m->indices);
    return out;
}

void mesh_free(struct mesh *m)
{
    mem_free(m->positions);
    mem_free(m->normals);
    mem_free(m->uvs);
    mem_free(m->indices);
}
