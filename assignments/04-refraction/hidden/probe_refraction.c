/* probe_refraction.c - runs refraction_direction on many cases; judges nothing.
 *
 *   probe INPUT OUTPUT GROUP
 *
 * Both files are arrays of records of 32-bit little-endian words (f = IEEE
 * single, u = unsigned); OUTPUT has one record for each of INPUT, in order.
 * oracle_refraction.py mirrors this layout. GROUP is not looked at.
 *
 *   in    7 f   normal, outgoing, eta_inside_over_outside
 *   out   4     u returned true (1) or false (0), 3 f incoming
 *
 * incoming is three NaNs before each call. */
#include "materials/refraction.h"
#include "probe.h"

static void run(struct probe *p)
{
    vec3 incoming = {NAN, NAN, NAN};
    vec3 normal = take_vec3(p), outgoing = take_vec3(p);
    float eta = take_float(p);
    put_word(p, refraction_direction(normal, outgoing, eta, &incoming));
    put_vec3(p, incoming);
}

int main(int argc, char **argv)
{
    struct probe p = probe_open("probe_refraction", argc, argv);
    while (probe_more(&p))
        run(&p);
    return probe_close(&p);
}
