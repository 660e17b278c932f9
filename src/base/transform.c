/* transform.c - see transform.h. */
#include "base/transform.h"

#include <float.h>
#include <string.h>

struct transform transform_identity(void)
{
    struct transform t = {
        {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}},
        {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    return t;
}

/* The signed 2x2 minors that make the inverse of the linear part; in double,
 * so that a badly scaled map keeps its digits. */
static double cofactor(const struct transform *t, int row, int column)
{
    int r1 = (row + 1) % 3, r2 = (row + 2) % 3;
    int c1 = (column + 1) % 3, c2 = (column + 2) % 3;
    return (double)t->m[r1][c1] * t->m[r2][c2] -
           (double)t->m[r1][c2] * t->m[r2][c1];
}

static double determinant(const struct transform *t)
{
    return t->m[0][0] * cofactor(t, 0, 0) + t->m[0][1] * cofactor(t, 0, 1) +
           t->m[0][2] * cofactor(t, 0, 2);
}

static double row_length(const struct transform *t, int row)
{
    double x = t->m[row][0], y = t->m[row][1], z = t->m[row][2];
    return sqrt(x * x + y * y + z * z);
}

/* The determinant is computed with fewer than 16 roundings of terms no larger
 * than the product of the rows' lengths: below that it may as well be 0. */
static bool is_flat(const struct transform *t, double det)
{
    double volume = row_length(t, 0) * row_length(t, 1) * row_length(t, 2);
    return !(fabs(det) > 16.0 * DBL_EPSILON * volume);
}

/* Fills t->inverse from t->m; false if the map is flat or a number of the
 * inverse is not finite. */
static bool invert(struct transform *t)
{
    double det = determinant(t);
    if (is_flat(t, det))
        return false;
    for (int i = 0; i < 3; i++) {
        double moved = 0.0;
        for (int j = 0; j < 3; j++) {
            double entry = cofactor(t, j, i) / det;
            t->inverse[i][j] = (float)entry;
            moved -= entry * t->m[j][3];
            if (!isfinite(t->inverse[i][j]))
                return false;
        }
        t->inverse[i][3] = (float)moved;
        t->inverse[3][i] = 0.0f;
        if (!isfinite(t->inverse[i][3]))
            return false;
    }
    t->inverse[3][3] = 1.0f;
    return true;
}

bool transform_from_rows(const float rows[16], struct transform *out)
{
    memcpy(out->m, rows, sizeof out->m);
    bool affine = rows[12] == 0.0f && rows[13] == 0.0f && rows[14] == 0.0f &&
                  rows[15] == 1.0f;
    return affine && invert(out);
}

struct transform transform_translated(struct transform a, vec3 offset)
{
    const float step[3] = {offset.x, offset.y, offset.z};
    for (int i = 0; i < 3; i++)
        a.m[i][3] += step[i];
    invert(&a);
    return a;
}

vec3 transform_point(const struct transform *t, vec3 p)
{
    vec3 moved = transform_direction(t, p);
    return vec3_make(moved.x + t->m[0][3], moved.y + t->m[1][3],
                     moved.z + t->m[2][3]);
}

vec3 transform_direction(const struct transform *t, vec3 d)
{
    const float(*m)[4] = t->m;
    return vec3_make(m[0][0] * d.x + m[0][1] * d.y + m[0][2] * d.z,
                     m[1][0] * d.x + m[1][1] * d.y + m[1][2] * d.z,
                     m[2][0] * d.x + m[2][1] * d.y + m[2][2] * d.z);
}

vec3 transform_normal(const struct transform *t, vec3 n)
{
    const float(*m)[4] = t->inverse;
    return vec3_make(m[0][0] * n.x + m[1][0] * n.y + m[2][0] * n.z,
                     m[0][1] * n.x + m[1][1] * n.y + m[2][1] * n.z,
                     m[0][2] * n.x + m[1][2] * n.y + m[2][2] * n.z);
}

bool transform_mirrors(const struct transform *t)
{
    return determinant(t) < 0.0;
}
