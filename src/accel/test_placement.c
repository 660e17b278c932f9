/* test_placement.c - a moved ray is within its margin of where it should be,
 * and placed triangles are hit like moved ones. */
#include "accel/placement.h"

#include <math.h>
#include <string.h>

#include "accel/nearest.h"
#include "accel/wide.h"
#include "sampling/random.h"
#include "shapes/mesh.h"
#include "unity.h"

enum { MAPS = 4000, TRIANGLES = 300, RAYS = 400 };

void setUp(void)
{
}

void tearDown(void)
{
}

static vec3 random_vec(uint64_t key, uint32_t first, float size)
{
    return vec3_make(size * (random_float(key, first) - 0.5f),
                     size * (random_float(key, first + 1) - 0.5f),
                     size * (random_float(key, first + 2) - 0.5f));
}

/* 2^-range to 2^range. */
static float random_scale(uint64_t key, uint32_t dimension, float range)
{
    return exp2f(range * (2.0f * random_float(key, dimension) - 1.0f));
}

/* Any nine numbers, each column of a size of its own, and a step. */
static bool random_map(uint64_t key, float uneven, float step,
                       struct transform *out)
{
    float rows[16] = {0};
    for (uint32_t i = 0; i < 3; i++) {
        vec3 column = random_vec(key, 3 * i, random_scale(key, 9 + i, uneven));
        for (uint32_t k = 0; k < 3; k++)
            rows[4 * k + i] = vec3_axis(column, (int)k);
        rows[4 * i + 3] = step * (random_float(key, 12 + i) - 0.5f);
    }
    rows[15] = 1.0f;
    return transform_from_rows(rows, out);
}

/* Exactly, or nearly so --------------------------------------------------- */

/* Solves A x = b by Cramer's rule. */
static void solve(const struct transform *t, const long double b[3],
                  long double x[3])
{
    long double c[3][3], determinant = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int r1 = (i + 1) % 3, r2 = (i + 2) % 3;
            int c1 = (j + 1) % 3, c2 = (j + 2) % 3;
            c[i][j] = (long double)t->m[r1][c1] * t->m[r2][c2] -
                      (long double)t->m[r1][c2] * t->m[r2][c1];
        }
    for (int j = 0; j < 3; j++)
        determinant += t->m[0][j] * c[0][j];
    for (int j = 0; j < 3; j++)
        x[j] = (c[0][j] * b[0] + c[1][j] * b[1] + c[2][j] * b[2]) / determinant;
}

static void subtract(vec3 a, vec3 b, long double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (long double)vec3_axis(a, i) - vec3_axis(b, i);
}

static vec3 offset_of(const struct transform *t)
{
    return vec3_make(t->m[0][3], t->m[1][3], t->m[2][3]);
}

/* The world's point in the mesh's space. */
static void bring_back(const struct transform *t, vec3 p, long double out[3])
{
    long double moved[3];
    subtract(p, offset_of(t), moved);
    solve(t, moved, out);
}

static long double farthest(const long double a[3], vec3 b)
{
    long double most = 0;
    for (int i = 0; i < 3; i++)
        most = fmaxl(most, fabsl(a[i] - vec3_axis(b, i)));
    return most;
}

/* The margin --------------------------------------------------------------- */

/* Where the ray aims at a corner that was moved to the world: how far is the
 * mesh's corner from the moved ray, in units of what the margin allows? */
static long double share_of_margin(const struct placement *p, uint64_t key)
{
    vec3 corner = random_vec(key, 20, 2.0f), world[3];
    const vec3 local[3] = {corner, corner, corner};
    placement_corners(p, local, world);
    vec3 from = random_vec(key, 23, random_scale(key, 26, 12.0f));
    from = vec3_add(from, offset_of(&p->to_world));
    ray r = ray_make(from, vec3_sub(world[0], from), 0.0f, INFINITY);
    ray seen = placement_ray(p, &r);
    /* Not r.direction itself: what the hit is off by in the world already. */
    long double origin[3], direction[3], at[3], away[3], reach = 0, size = 0;
    bring_back(&p->to_world, from, origin);
    for (int i = 0; i < 3; i++)
        away[i] = vec3_axis(r.direction, i);
    solve(&p->to_world, away, direction);
    for (int i = 0; i < 3; i++) {
        at[i] = origin[i] + direction[i];
        reach = fmaxl(reach, fabsl(direction[i]));
        size = fmaxl(size, fabsl(origin[i]));
    }
    long double off = farthest(origin, seen.origin) +
                      farthest(direction, seen.direction) +
                      farthest(at, corner);
    return off / (p->margin.factor * (size + reach) + p->margin.length);
}

static void moved_rays_stay_within_their_margin(void)
{
    const aabb box = {{-1, -1, -1}, {1, 1, 1}};
    long double most = 0;
    int used = 0;
    for (uint64_t i = 0; i < MAPS; i++) {
        uint64_t key = random_key(5, i, 0);
        struct transform t;
        struct placement p;
        float step = random_scale(key, 30, 8.0f);
        if (!random_map(key, 6.0f, step, &t) ||
            !placement_make(&t, 0, &box, &p))
            continue;
        used++;
        most = fmaxl(most, share_of_margin(&p, key));
    }
    TEST_ASSERT_GREATER_THAN_INT(MAPS / 4, used);
    TEST_ASSERT_TRUE_MESSAGE(most < 1.0L, "outside of the margin");
    TEST_ASSERT_TRUE_MESSAGE(most > 0.01L, "the margin is far too wide");
}

static void what_beams_cannot_serve_is_refused(void)
{
    const aabb box = {{-1, -1, -1}, {1, 1, 1}}, point = {{1, 1, 1}, {1, 1, 1}};
    struct transform flat = transform_identity(), far = flat, fine = flat;
    struct placement p;
    flat.m[1][1] = 0x1p-12f;
    flat.inverse[1][1] = 0x1p12f;
    far = transform_translated(far, vec3_make(0, 0x1p17f, 0));
    fine = transform_translated(fine, vec3_make(0, 1000, 0));
    TEST_ASSERT_FALSE(placement_make(&flat, 0, &box, &p));
    TEST_ASSERT_FALSE(placement_make(&far, 0, &box, &p));
    TEST_ASSERT_FALSE(placement_make(&fine, 0, &point, &p));
    TEST_ASSERT_TRUE(placement_make(&fine, 0, &box, &p));
}

/* Hits --------------------------------------------------------------------- */

static vec3 positions[3 * TRIANGLES], moved_positions[3 * TRIANGLES];
static uint32_t indices[3 * TRIANGLES], moved_indices[3 * TRIANGLES];

static bool corners_of(const void *mesh, uint32_t triangle, vec3 corners[3])
{
    mesh_corners(mesh, triangle, corners);
    return true;
}

static struct mesh scatter(void)
{
    struct mesh m = {positions, NULL, NULL, indices, 3 * TRIANGLES, TRIANGLES};
    for (uint32_t i = 0; i < 3 * TRIANGLES; i++) {
        uint64_t key = random_key(6, i / 3, 0);
        positions[i] = vec3_add(random_vec(key, 0, 2.0f),
                                random_vec(key, 3 + 3 * (i % 3), 0.5f));
        indices[i] = i;
    }
    return m;
}

/* Through the placed tree, and through one over the moved copy. */
static int compare(const struct wide *placed, const struct placement *p,
                   const struct wide *moved, uint64_t key)
{
    vec3 from = random_vec(key, 0, 8.0f), to = random_vec(key, 3, 2.0f);
    from = transform_point(&p->to_world, from);
    to = transform_point(&p->to_world, to);
    ray r = ray_make(from, vec3_sub(to, from), 0.0f, 0x1p40f);
    struct nearest want = {NO_PRIMITIVE, r.t_max, 0.0f, 0.0f}, got = want,
                   limit = want;
    ray near = r, also = r, any = r;
    bool hit = wide_nearest(moved, &near, NULL, NULL, &want);
    TEST_ASSERT_EQUAL(hit, wide_nearest_placed(placed, p, &also, &got));
    TEST_ASSERT_EQUAL(hit, wide_any_placed(placed, p, &any, &limit));
    if (hit)
        want.primitive += p->first_primitive;
    TEST_ASSERT_EQUAL_MEMORY(&want, &got, sizeof want);
    return hit;
}

static void placed_triangles_are_hit_like_moved_ones(void)
{
    struct mesh m = scatter(), moved = m;
    const struct wide_source source = {TRIANGLES, NULL, &m, corners_of, NULL};
    const struct wide_source other = {TRIANGLES, NULL, &moved, corners_of,
                                      NULL};
    struct wide tree = wide_build(&source);
    int hits = 0, used = 0;
    moved.positions = moved_positions;
    moved.indices = moved_indices;
    for (uint64_t i = 0; i < 40; i++) {
        struct transform t;
        struct placement p;
        uint64_t key = random_key(7, i, 0);
        if (!random_map(key, 2.0f, random_scale(key, 30, 6.0f), &t) ||
            !placement_make(&t, 1000, &tree.box, &p))
            continue;
        memcpy(moved_positions, positions, sizeof positions);
        memcpy(moved_indices, indices, sizeof indices);
        mesh_transform(&moved, &t);
        struct wide world = wide_build(&other);
        for (uint64_t k = 0; k < RAYS; k++)
            hits += compare(&tree, &p, &world, random_key(8, i, (uint32_t)k));
        wide_free(&world);
        used++;
    }
    wide_free(&tree);
    TEST_ASSERT_GREATER_THAN_INT(20, used);
    TEST_ASSERT_GREATER_THAN_INT(used * RAYS / 4, hits);
    TEST_ASSERT_LESS_THAN_INT(used * RAYS, hits);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(moved_rays_stay_within_their_margin);
    RUN_TEST(what_beams_cannot_serve_is_refused);
    RUN_TEST(placed_triangles_are_hit_like_moved_ones);
    return UNITY_END();
}
