/* probe_triangle.c - runs a triangle module on many cases; judges nothing.
 *
 *   probe INPUT OUTPUT GROUP
 *
 * Both files are arrays of records of 32-bit little-endian words (f = IEEE
 * single, u = unsigned); OUTPUT has one record for each of INPUT, in order.
 * oracle_triangle.py and oracle_differentials.py mirror this layout.
 *
 * GROUP "differentials":
 *   in   15 f   corners p0 p1 p2 (x y z each), uv0 uv1 uv2 (u v each)
 *   out   8     u returned true (1) or false (0), 3 f dp_du, 3 f dp_dv,
 *               u flags
 * GROUP "hostile": the layout of "differentials" is laid over that of any
 *   other, and both functions are called; what they say is not told.
 * Any other GROUP:
 *   in   17 f   corners p0 p1 p2, ray origin, direction, t_min, t_max
 *   out   5     u returned true (1) or false (0), f t, f b1, f b2, u flags
 *
 * A function that returned false has zeros for its vectors or t, b1, b2.
 * Flags: 1 = returned false, yet wrote to its results; 2 = changed the ray. */
#include "probe.h"
#include "shapes/triangle.h"

enum { WROTE_ON_FALSE = 1, CHANGED_RAY = 2 };
enum { INTERSECT_IN = 17, INTERSECT_OUT = 5 };
enum { DIFFERENTIALS_IN = 15, DIFFERENTIALS_OUT = 8 };

/* What results hold before the call: no case has this for an answer. */
static const float UNTOUCHED = -12345.6787f;

typedef void run_case(const float *in, uint32_t *out);

static vec3 vec3_of(const float *in)
{
    return vec3_make(in[0], in[1], in[2]);
}

static void write_vec3(uint32_t *out, vec3 v)
{
    out[0] = word_of(v.x);
    out[1] = word_of(v.y);
    out[2] = word_of(v.z);
}

static void run_intersect(const float *in, uint32_t *out)
{
    const vec3 p[3] = {vec3_of(in), vec3_of(in + 3), vec3_of(in + 6)};
    const ray given =
        ray_make(vec3_of(in + 9), vec3_of(in + 12), in[15], in[16]);
    const struct triangle_hit untouched = {UNTOUCHED, UNTOUCHED, UNTOUCHED};
    ray used = given;
    struct triangle_hit hit = untouched;
    bool found = triangle_intersect(p, &used, &hit);
    if (found) {
        out[0] = 1;
        out[1] = word_of(hit.t);
        out[2] = word_of(hit.b1);
        out[3] = word_of(hit.b2);
    } else if (memcmp(&hit, &untouched, sizeof hit) != 0) {
        out[4] |= WROTE_ON_FALSE;
    }
    if (memcmp(&used, &given, sizeof used) != 0)
        out[4] |= CHANGED_RAY;
}

static void run_differentials(const float *in, uint32_t *out)
{
    const vec3 p[3] = {vec3_of(in), vec3_of(in + 3), vec3_of(in + 6)};
    const vec2 uv[3] = {{in[9], in[10]}, {in[11], in[12]}, {in[13], in[14]}};
    const vec3 untouched = {UNTOUCHED, UNTOUCHED, UNTOUCHED};
    vec3 dp_du = untouched, dp_dv = untouched;
    if (triangle_uv_differentials(p, uv, &dp_du, &dp_dv)) {
        out[0] = 1;
        write_vec3(out + 1, dp_du);
        write_vec3(out + 4, dp_dv);
    } else if (memcmp(&dp_du, &untouched, sizeof dp_du) != 0 ||
               memcmp(&dp_dv, &untouched, sizeof dp_dv) != 0) {
        out[7] |= WROTE_ON_FALSE;
    }
}

static void run_both(const float *in, uint32_t *out)
{
    run_differentials(in, out);
    run_intersect(in, out);
}

int main(int argc, char **argv)
{
    struct probe p = probe_open("probe_triangle", argc, argv);
    bool differentials = probe_is(&p, "differentials");
    run_case *run = differentials             ? run_differentials
                    : probe_is(&p, "hostile") ? run_both
                                              : run_intersect;
    size_t words_in = differentials ? DIFFERENTIALS_IN : INTERSECT_IN;
    size_t words_out = differentials ? DIFFERENTIALS_OUT : INTERSECT_OUT;
    while (probe_more(&p)) {
        float in[INTERSECT_IN];
        uint32_t out[DIFFERENTIALS_OUT] = {0};
        take_floats(&p, in, words_in);
        run(in, out);
        put_words(&p, out, words_out);
    }
    return probe_close(&p);
}
