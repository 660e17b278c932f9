/* probe_rect_light.c - runs an area light module on many cases; judges nothing.
 *
 *   probe INPUT OUTPUT GROUP
 *
 * Both files are arrays of records of 32-bit little-endian words (IEEE single
 * but for the flags); OUTPUT has one record for each of INPUT, in order.
 * oracle_rect_light.py and oracle_lamp.py mirror this layout. A rect is 13
 * words: center, side_x, side_y, normal (x y z each), area.
 *
 * GROUP "density":
 *   in   10   point, on_light, normal, area
 *   out   1   area_light_pdf
 * GROUP "emitted":
 *   in    9   radiance (r g b), normal, outgoing
 *   out   3   area_light_emitted
 * Any other GROUP:
 *   in   21   rect, random x and y, point, radiance
 *   out   8   the place that was picked; area_light_pdf of it; what it emits
 *             towards the point (r g b); flags: 1 = the same numbers gave
 *             another place the second time */
#include "lights/rect_light.h"
#include "probe.h"

enum { OTHER_PLACE = 1 };

typedef void run_case(struct probe *p);

static void run_density(struct probe *p)
{
    vec3 point = take_vec3(p), on_light = take_vec3(p), normal = take_vec3(p);
    put_float(p, area_light_pdf(point, on_light, normal, take_float(p)));
}

static void run_emitted(struct probe *p)
{
    rgb radiance = take_rgb(p);
    vec3 normal = take_vec3(p), outgoing = take_vec3(p);
    put_rgb(p, area_light_emitted(radiance, normal, outgoing));
}

static struct rect take_rect(struct probe *p)
{
    struct rect rect;
    rect.center = take_vec3(p);
    rect.side_x = take_vec3(p);
    rect.side_y = take_vec3(p);
    rect.normal = take_vec3(p);
    rect.area = take_float(p);
    return rect;
}

/* Other numbers are asked between the two picks: none may be remembered. */
static void run_light(struct probe *p)
{
    const struct rect rect = take_rect(p);
    vec2 random = take_vec2(p);
    vec3 point = take_vec3(p);
    rgb radiance = take_rgb(p);
    vec3 place = rect_light_place(&rect, random);
    rect_light_place(&rect, vec2_make(0.5f * random.y, 0.5f * random.x));
    vec3 again = rect_light_place(&rect, random);
    put_vec3(p, place);
    put_float(p, area_light_pdf(point, place, rect.normal, rect.area));
    put_rgb(p,
            area_light_emitted(radiance, rect.normal, vec3_sub(point, place)));
    put_word(p, memcmp(&place, &again, sizeof place) != 0 ? OTHER_PLACE : 0);
}

int main(int argc, char **argv)
{
    struct probe p = probe_open("probe_rect_light", argc, argv);
    run_case *run = probe_is(&p, "density")   ? run_density
                    : probe_is(&p, "emitted") ? run_emitted
                                              : run_light;
    while (probe_more(&p))
        run(&p);
    return probe_close(&p);
}
