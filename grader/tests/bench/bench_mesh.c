/* bench_mesh.c - see bench_mesh.h. */
#include "bench_mesh.h"

#include <math.h>
#include <string.h>

#include "base/constants.h"
#include "base/memory.h"

/* Building ---------------------------------------------------------------- */

/* One vertex more: Embree reads 16 bytes of each position, which has 12. */
static void make_room(struct mesh *m, uint32_t vertices, uint32_t triangles)
{
    m->positions = mem_alloc(vertices + 1, sizeof *m->positions);
    m->indices = mem_alloc(triangles, 3 * sizeof *m->indices);
}

static void add_vertex(struct mesh *m, vec3 p)
{
    m->positions[m->vertex_count++] = p;
}

static void add_triangle(struct mesh *m, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *corner = &m->indices[3 * (size_t)m->triangle_count++];
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
}

/* The parallelogram with a corner and two sides. */
static void add_quad(struct mesh *m, vec3 corner, vec3 u, vec3 v)
{
    uint32_t first = m->vertex_count;
    add_vertex(m, corner);
    add_vertex(m, vec3_add(corner, u));
    add_vertex(m, vec3_add(vec3_add(corner, u), v));
    add_vertex(m, vec3_add(corner, v));
    add_triangle(m, first, first + 1, first + 2);
    add_triangle(m, first, first + 2, first + 3);
}

/* Two triangles for each square of a grid of columns x rows squares, whose
 * points lie row by row from `first` on; `wrap` joins the last to the first. */
static void add_grid(struct mesh *m, uint32_t first, uint32_t columns,
                     uint32_t rows, bool wrap)
{
    uint32_t wide = wrap ? columns : columns + 1;
    for (uint32_t j = 0; j < rows; j++)
        for (uint32_t i = 0; i < columns; i++) {
            uint32_t right = wrap ? (i + 1) % columns : i + 1;
            uint32_t above = first + j * wide;
            uint32_t below = first + (wrap ? (j + 1) % rows : j + 1) * wide;
            add_triangle(m, above + i, below + i, above + right);
            add_triangle(m, above + right, below + i, below + right);
        }
}

static void look(struct bench_mesh *b, vec3 from, vec3 at, float fov)
{
    b->camera.position = from;
    b->camera.look_at = at;
    b->camera.up = vec3_make(0.0f, 1.0f, 0.0f);
    b->camera.vertical_fov = fov;
}

static void hang_lamp(struct bench_mesh *b, vec3 corner, vec3 u, vec3 v)
{
    b->lamp = corner;
    b->lamp_u = u;
    b->lamp_v = v;
}

/* Noise ------------------------------------------------------------------- */

/* Uniform in [0, 1], the same for the same whole numbers. */
static float lattice(int x, int y)
{
    uint32_t h = (uint32_t)x * 374761393u + (uint32_t)y * 668265263u;
    h = (h ^ (h >> 13)) * 1274126177u;
    return (float)(h ^ (h >> 16)) * 0x1p-32f;
}

/* Smooth in between: "value noise". */
static float noise(float x, float y)
{
    int i = (int)floorf(x), j = (int)floorf(y);
    float s = x - (float)i, t = y - (float)j;
    s = s * s * (3.0f - 2.0f * s);
    t = t * t * (3.0f - 2.0f * t);
    float above = lattice(i, j) * (1.0f - s) + lattice(i + 1, j) * s;
    float below = lattice(i, j + 1) * (1.0f - s) + lattice(i + 1, j + 1) * s;
    return above * (1.0f - t) + below * t;
}

/* Octaves of noise, each half as high and twice as dense as the one before. */
static float fractal_noise(float x, float y, int octaves)
{
    float sum = 0.0f, height = 0.5f;
    for (int i = 0; i < octaves; i++) {
        sum += height * noise(x, y);
        x = x * 2.03f + 17.1f;
        y = y * 2.03f - 3.7f;
        height *= 0.5f;
    }
    return sum;
}

/* box --------------------------------------------------------------------- */

enum { BALL_AROUND = 17, BALL_DOWN = 16 };

static void add_ball(struct mesh *m, vec3 centre, float radius)
{
    uint32_t first = m->vertex_count;
    for (int j = 0; j <= BALL_DOWN; j++)
        for (int i = 0; i <= BALL_AROUND; i++) {
            float theta = PI * (float)j / BALL_DOWN;
            float phi = 2.0f * PI * (float)i / BALL_AROUND;
            vec3 out = vec3_make(sinf(theta) * cosf(phi), cosf(theta),
                                 sinf(theta) * sinf(phi));
            add_vertex(m, vec3_step(centre, radius, out));
        }
    add_grid(m, first, BALL_AROUND, BALL_DOWN, false);
}

static void make_box(struct bench_mesh *b)
{
    const vec3 x = {2.0f, 0.0f, 0.0f}, y = {0.0f, 2.0f, 0.0f},
               z = {0.0f, 0.0f, 2.0f};
    struct mesh *m = &b->mesh;
    make_room(m, 700, 1200);
    add_quad(m, vec3_make(-1.0f, -1.0f, -1.0f), x, z);
    add_quad(m, vec3_make(-1.0f, 1.0f, -1.0f), z, x);
    add_quad(m, vec3_make(-1.0f, -1.0f, -1.0f), y, x);
    add_quad(m, vec3_make(-1.0f, -1.0f, -1.0f), z, y);
    add_quad(m, vec3_make(1.0f, -1.0f, -1.0f), y, z);
    add_ball(m, vec3_make(-0.4f, -0.6f, -0.3f), 0.4f);
    add_ball(m, vec3_make(0.45f, -0.65f, 0.3f), 0.35f);
    look(b, vec3_make(0.0f, 0.0f, 3.6f), vec3_make(0.0f, 0.0f, 0.0f), 38.0f);
    hang_lamp(b, vec3_make(-0.25f, 0.97f, -0.25f), vec3_make(0.5f, 0.0f, 0.0f),
              vec3_make(0.0f, 0.0f, 0.5f));
}

/* knot -------------------------------------------------------------------- */

enum { KNOT_ALONG = 1250, KNOT_AROUND = 40 };

/* The axis of the tube: twice around the z axis while it goes three times
 * around its own ring. */
static vec3 knot_axis(float t)
{
    float r = 1.0f + 0.45f * cosf(3.0f * t);
    return vec3_make(r * cosf(2.0f * t), r * sinf(2.0f * t),
                     0.6f * sinf(3.0f * t));
}

static void add_knot_ring(struct mesh *m, int i)
{
    float t = 2.0f * PI * (float)i / KNOT_ALONG;
    vec3 centre = knot_axis(t);
    vec3 along = vec3_normalize(vec3_sub(knot_axis(t + 0.001f), centre));
    vec3 side = vec3_normalize(vec3_make(along.y, -along.x, 0.0f));
    vec3 up = vec3_cross(side, along);
    for (int j = 0; j < KNOT_AROUND; j++) {
        float s = 2.0f * PI * (float)j / KNOT_AROUND;
        float r = 0.26f + 0.05f * noise((float)i * 0.11f, (float)j * 0.25f) +
                  0.02f * sinf(5.0f * s + 40.0f * t);
        vec3 p = vec3_step(centre, r * cosf(s), side);
        add_vertex(m, vec3_step(p, r * sinf(s), up));
    }
}

static void make_knot(struct bench_mesh *b)
{
    struct mesh *m = &b->mesh;
    make_room(m, KNOT_ALONG * KNOT_AROUND + 8,
              2 * KNOT_ALONG * KNOT_AROUND + 4);
    add_quad(m, vec3_make(-4.0f, -1.6f, -4.0f), vec3_make(8.0f, 0.0f, 0.0f),
             vec3_make(0.0f, 0.0f, 8.0f));
    add_quad(m, vec3_make(-4.0f, -1.6f, -3.0f), vec3_make(0.0f, 5.6f, 0.0f),
             vec3_make(8.0f, 0.0f, 0.0f));
    uint32_t first = m->vertex_count;
    for (int i = 0; i < KNOT_ALONG; i++)
        add_knot_ring(m, i);
    add_grid(m, first, KNOT_AROUND, KNOT_ALONG, true);
    look(b, vec3_make(0.6f, 1.2f, 4.2f), vec3_make(0.0f, -0.1f, 0.0f), 45.0f);
    hang_lamp(b, vec3_make(-1.0f, 3.5f, 1.0f), vec3_make(2.0f, 0.0f, 0.0f),
              vec3_make(0.0f, 0.0f, 2.0f));
}

/* terrain ----------------------------------------------------------------- */

enum { TERRAIN_SIDE = 1000 };

/* The points are shifted a little, so that no plane is shared by many. */
static vec3 terrain_point(int i, int j)
{
    float x = 2.0f * (float)i / TERRAIN_SIDE - 1.0f;
    float z = 2.0f * (float)j / TERRAIN_SIDE - 1.0f;
    float h = fractal_noise(4.0f * x + 9.0f, 4.0f * z + 5.0f, 9);
    float dx = noise((float)i * 1.7f, (float)j * 1.3f) - 0.5f;
    float dz = noise((float)i * 1.1f + 50.0f, (float)j * 1.9f) - 0.5f;
    return vec3_make(x + 0.0006f * dx, 0.63f * h * h, z + 0.0006f * dz);
}

static void make_terrain(struct bench_mesh *b)
{
    struct mesh *m = &b->mesh;
    make_room(m, (TERRAIN_SIDE + 1) * (TERRAIN_SIDE + 1),
              2 * TERRAIN_SIDE * TERRAIN_SIDE);
    for (int j = 0; j <= TERRAIN_SIDE; j++)
        for (int i = 0; i <= TERRAIN_SIDE; i++)
            add_vertex(m, terrain_point(i, j));
    add_grid(m, 0, TERRAIN_SIDE, TERRAIN_SIDE, false);
    look(b, vec3_make(0.0f, 0.55f, 1.25f), vec3_make(0.0f, 0.1f, 0.0f), 50.0f);
    hang_lamp(b, vec3_make(-3.0f, 2.0f, -2.0f), vec3_make(0.6f, 0.0f, 0.0f),
              vec3_make(0.0f, 0.0f, 0.6f));
}

bool bench_mesh_make(const char *name, struct bench_mesh *out)
{
    static const struct {
        const char *name;
        void (*make)(struct bench_mesh *);
    } known[] = {
        {"box", make_box}, {"knot", make_knot}, {"terrain", make_terrain}};
    memset(out, 0, sizeof *out);
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(known[i].name, name) == 0) {
            known[i].make(out);
            return true;
        }
    return false;
}
