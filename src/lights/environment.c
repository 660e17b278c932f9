/* environment.c - assignment 09: light from everywhere around.
 *
 * The contract is in environment.h. */
#include "lights/environment.h"

#include <stddef.h>

#include "base/constants.h"
#include "base/memory.h"
#include "base/todo.h"
#include "sampling/distribution.h"
#include "sampling/warp.h"

//> environment: Light from a map of all directions
#ifndef TODO_environment
//> environment.patches: Cut the map between its texel centres
/* The picture is cut between the texel centres, not between the texels: in
 * such a patch the radiance is one bilinear blend of four texels.
 *
 *     . . . . . . . . . .    v = 0, a pole: above the first row of centres
 *     |     |     |     |    a patch of half the height; its upper two texels
 *     o - - o - - o - - o    are, by the clamp, the lower two again
 *     |     |     |     |
 *     |   patch   |     |    o = texel centre. Column i lies between the
 *     |     |     |     |    centres i and i + 1, row k between k - 1 and k:
 *     o - - o - - o - - o    width columns, height + 1 rows.
 *
 * A patch is picked by its power, mean luminance times solid angle, and in it a
 * place by the blend of its corners. Both together are a density of
 *
 *     (mean x solid / total) x (blend / mean) / solid = blend / total:
 *
 * the luminance itself, up to a factor. A place in a patch is (a, b) in the
 * unit square; a runs evenly with the azimuth, b with the cosine of theta, in
 * which equal steps are equal solid angles. */

/* Wraps in x, clamps in y; x at most one beyond the border. */
static rgb texel(const struct image *image, int x, int y)
{
    int width = image->width, column = x < 0 ? x + width : x;
    column = column < width ? column : column - width;
    int row = y < 0 ? 0 : y < image->height ? y : image->height - 1;
    return image->pixels[(size_t)row * (size_t)width + (size_t)column];
}

/* The four texels around a patch, in the order of warp_bilinear. */
static void patch_texels(const struct image *image, int column, int row,
                         rgb corners[4])
{
    for (int i = 0; i < 4; i++)
        corners[i] = texel(image, column + i % 2, row - 1 + i / 2);
}
//< environment.patches

//> environment.place: Find where a direction falls
static vec3 to_local(const struct environment *e, vec3 d)
{
    const float(*m)[4] = e->to_world.inverse;
    return vec3_make(m[0][0] * d.x + m[0][1] * d.y + m[0][2] * d.z,
                     m[1][0] * d.x + m[1][1] * d.y + m[1][2] * d.z,
                     m[2][0] * d.x + m[2][1] * d.y + m[2][2] * d.z);
}

/* Where a direction falls: a patch, and how far across (a) and down (b). */
struct place {
    int column, row;
    float a, b;
};

/* b is even in theta here, as in the image. atan2, not acos: near the poles z
 * has lost the digits that x and y still have. */
static struct place find_place(const struct image *image, vec3 local)
{
    float phi = atan2f(local.y, local.x);
    float theta = atan2f(sqrtf(local.x * local.x + local.y * local.y), local.z);
    float u = phi / (2.0f * PI) + (phi < 0.0f ? 1.0f : 0.0f);
    float x = u * (float)image->width - 0.5f;
    float y = theta / PI * (float)image->height + 0.5f;
    int row = y < (float)image->height ? (int)y : image->height;
    struct place p = {(int)floorf(x), row, x - floorf(x), y - (float)row};
    return p;
}
//< environment.place

//> environment.radiance: Blend the four texels around it
static rgb mix(rgb from, rgb to, float amount)
{
    return rgb_add(rgb_scale(from, 1.0f - amount), rgb_scale(to, amount));
}

rgb environment_radiance(const struct environment *e, vec3 direction)
{
    rgb c[4];
    struct place p = find_place(e->image, to_local(e, direction));
    patch_texels(e->image, p.column, p.row, c);
    rgb color = mix(mix(c[0], c[1], p.a), mix(c[2], c[3], p.a), p.b);
    return rgb_scale(color, e->scale);
}
//< environment.radiance

//> environment.powers: Weigh each patch by the light it sends
static void patch_luminances(const struct image *image, int column, int row,
                             float corners[4])
{
    rgb texels[4];
    patch_texels(image, column, row, texels);
    for (int i = 0; i < 4; i++)
        corners[i] = rgb_luminance(texels[i]);
}

/* The cosine of theta where a row of patches begins. In double: near the poles
 * the difference from one row to the next is small. */
static double row_cosine(const struct image *image, int row)
{
    double v = (row - 0.5) / image->height;
    return cos((double)PI * fmin(fmax(v, 0.0), 1.0));
}

/* The power of each patch of a row: mean luminance times solid angle. cosine:
 * where the row begins, and where it ends. */
static void row_powers(const struct image *image, int row,
                       const double cosine[2], float powers[])
{
    float solid_angle =
        2.0f * PI / (float)image->width * (float)(cosine[0] - cosine[1]);
    for (int column = 0; column < image->width; column++) {
        float c[4];
        patch_luminances(image, column, row, c);
        powers[column] = 0.25f * (c[0] + c[1] + c[2] + c[3]) * solid_angle;
    }
}
//< environment.powers

//> environment.table: Make the table
struct environment_table {
    struct distribution_2d patches; /* their powers */
    double *cosines; /* where each row begins, and where the last one ends */
};

struct environment_table *environment_table_make(const struct image *image)
{
    struct environment_table *table = mem_alloc(1, sizeof *table);
    size_t width = (size_t)image->width, rows = (size_t)image->height + 1;
    float *powers = mem_alloc(width * rows, sizeof *powers);
    table->cosines = mem_alloc(rows + 1, sizeof *table->cosines);
    for (size_t row = 0; row <= rows; row++)
        table->cosines[row] = row_cosine(image, (int)row);
    for (size_t row = 0; row < rows; row++)
        row_powers(image, (int)row, table->cosines + row, powers + row * width);
    table->patches =
        distribution_2d_make(powers, (uint32_t)width, (uint32_t)rows);
    mem_free(powers);
    return table;
}

void environment_table_free(struct environment_table *table)
{
    if (table == NULL)
        return;
    distribution_2d_free(&table->patches);
    mem_free(table->cosines);
    mem_free(table);
}
//< environment.table

//> environment.pdf: The density of a direction
/* cos theta of a unit vector, with the digits that z lacks near the poles. */
static double polar_cosine(vec3 d)
{
    double side = (double)d.x * d.x + (double)d.y * d.y;
    return d.z > 0.0f ? 1.0 - side / (1.0 + d.z) : side / (1.0 - d.z) - 1.0;
}

/* b where equal steps are equal solid angles, from 0 to 1 over the row. */
static float even_solid_angle(const struct environment_table *table, int row,
                              vec3 local)
{
    const double *cosine = table->cosines + row;
    double b = (cosine[0] - polar_cosine(local)) / (cosine[0] - cosine[1]);
    return (float)fmin(fmax(b, 0.0), 1.0);
}

float environment_pdf(const struct environment *e, vec3 direction)
{
    float c[4];
    vec3 local = to_local(e, direction);
    struct place p = find_place(e->image, local);
    float b = even_solid_angle(e->table, p.row, local);
    patch_luminances(e->image, p.column, p.row, c);
    float upper = c[0] + p.a * (c[1] - c[0]);
    float lower = c[2] + p.a * (c[3] - c[2]);
    double total = e->table->patches.rows.total;
    return total > 0.0 ? (float)((upper + b * (lower - upper)) / total) : 0.0f;
}
//< environment.pdf

//> environment.sample: Pick a direction
/* The local direction at (a, b) of a patch. */
static vec3 patch_direction(const struct environment *e, uint32_t column,
                            uint32_t row, vec2 at)
{
    const double *cosine = e->table->cosines + row;
    double z = cosine[0] + (double)at.y * (cosine[1] - cosine[0]);
    float side = (float)sqrt(fmax(0.0, 1.0 - z * z));
    float turn = ((float)column + 0.5f + at.x) / (float)e->image->width;
    float phi = 2.0f * PI * turn;
    return vec3_make(side * cosf(phi), side * sinf(phi), (float)z);
}

float environment_sample(const struct environment *e, vec2 random,
                         vec3 *direction)
{
    uint32_t column, row;
    vec2 in_patch;
    float corners[4];
    distribution_2d_pick(&e->table->patches, random, &column, &row, &in_patch);
    patch_luminances(e->image, (int)column, (int)row, corners);
    vec2 at = warp_bilinear(in_patch, corners);
    vec3 local = patch_direction(e, column, row, at);
    *direction = vec3_normalize(transform_direction(&e->to_world, local));
    return environment_pdf(e, *direction);
}
//< environment.sample
#else
/* TODO(environment): what environment.h asks for: the radiance of a direction,
 * a table, and with it a way to pick bright directions often. A good order is
 * radiance first, then the table, pdf and sample together. Until then the sky
 * has one colour, and directions are picked evenly, which is right for it. */
rgb environment_radiance(const struct environment *e, vec3 direction)
{
    (void)direction;
    TODO_WARN("09 environment",
              "the sky has one colour, and all directions are as likely");
    const struct image *image = e->image;
    int middle = image->width / 2, row = image->height / 4;
    return rgb_scale(image->pixels[row * image->width + middle], e->scale);
}

struct environment_table *environment_table_make(const struct image *image)
{
    (void)image;
    return NULL;
}

void environment_table_free(struct environment_table *table)
{
    (void)table;
}

float environment_sample(const struct environment *e, vec2 random,
                         vec3 *direction)
{
    *direction = warp_sphere(random);
    return environment_pdf(e, *direction);
}

float environment_pdf(const struct environment *e, vec3 direction)
{
    (void)e;
    return warp_sphere_pdf(direction);
}
#endif
//< environment
