/* probe_aabb.c - runs a box module on many cases; judges nothing.
 *
 *   probe INPUT OUTPUT GROUP
 *
 * Both files are arrays of records of 32-bit little-endian words (f = IEEE
 * single, u = unsigned); OUTPUT has one record for each of INPUT, in order.
 * oracle_aabb.py mirrors this layout. GROUP makes no difference.
 *
 *   in   14 f   lower, upper, origin, direction (x y z each), t_min, t_max
 *   out   4     u returned true (1) or false (0), f t_enter, f t_exit, u flags
 *
 * A function that returned false has zeros for its results.
 * Flags: 1 = changed the ray or the box; 2 = returned true, yet left one of
 * its results as it was. */
#include "accel/aabb.h"
#include "probe.h"

enum { CHANGED_INPUT = 1, NOT_WRITTEN = 2 };

/* What results hold before the call: no case has this for an answer. */
static const float UNTOUCHED = -12345.6787f;

static bool is_untouched(float result)
{
    return word_of(result) == word_of(UNTOUCHED);
}

static void run(struct probe *p)
{
    const aabb box = take_box(p);
    const ray given = take_ray(p);
    aabb used_box = box;
    ray used = given;
    float t_enter = UNTOUCHED, t_exit = UNTOUCHED;
    uint32_t flags = 0;
    bool hit = aabb_intersect(&used_box, &used, &t_enter, &t_exit);
    if (hit && (is_untouched(t_enter) || is_untouched(t_exit)))
        flags |= NOT_WRITTEN;
    if (memcmp(&used, &given, sizeof used) != 0 ||
        memcmp(&used_box, &box, sizeof box) != 0)
        flags |= CHANGED_INPUT;
    put_word(p, hit);
    put_float(p, hit ? t_enter : 0.0f);
    put_float(p, hit ? t_exit : 0.0f);
    put_word(p, flags);
}

int main(int argc, char **argv)
{
    struct probe p = probe_open("probe_aabb", argc, argv);
    while (probe_more(&p))
        run(&p);
    return probe_close(&p);
}
