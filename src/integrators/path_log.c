/* path_log.c - see path_log.h. */
#include "integrators/path_log.h"

#include <stdarg.h>

/* One line, indented by the depth of the path. */
static void line(struct path_log *log, const char *format, ...)
{
    va_list args;
    fprintf(log->out, "%*s", 2 + 2 * log->depth, "");
    va_start(args, format);
    vfprintf(log->out, format, args);
    va_end(args);
    fputc('\n', log->out);
}

#define POINT_FORMAT "(%.6g, %.6g, %.6g)"
#define POINT(v) (double)(v).x, (double)(v).y, (double)(v).z
#define COLOR(c) (double)(c).r, (double)(c).g, (double)(c).b

void path_log_camera(struct path_log *log, uint32_t sample, vec2 place,
                     const ray *r)
{
    if (log == NULL)
        return;
    log->depth = 0;
    fprintf(log->out,
            "sample %lu through (%.4f, %.4f): from " POINT_FORMAT
            " along " POINT_FORMAT "\n",
            (unsigned long)sample, (double)place.x, (double)place.y,
            POINT(r->origin), POINT(r->direction));
}

static const char *const material_kinds[] = {"diffuse", "refraction", "glass",
                                             "roughconductor"};
static const char *const object_kinds[] = {"mesh", "sphere", "rect"};
static const char *const light_kinds[] = {
    "point", "directional", "spot", "rect", "sphere", "mesh", "environment"};

void path_log_hit(struct path_log *log, const struct scene *scene,
                  const struct object *object, const struct surface *s, float t)
{
    if (log == NULL)
        return;
    log->depth++;
    line(log, "hit object %td (%s, %s%s) at t = %.6g, " POINT_FORMAT,
         object - scene->objects, object_kinds[object->kind],
         object->material ? material_kinds[object->material->kind]
                          : "no material",
         object->light >= 0 ? ", a light" : "", (double)t, POINT(s->position));
    line(log,
         "  normal " POINT_FORMAT ", shading " POINT_FORMAT ", uv (%.5g, %.5g)",
         POINT(s->geometric_normal), POINT(s->shading_normal), (double)s->uv.x,
         (double)s->uv.y);
}

void path_log_miss(struct path_log *log)
{
    if (log == NULL)
        return;
    log->depth++;
    line(log, "leaves the scene");
}

void path_log_light(struct path_log *log, const struct scene *scene,
                    const struct light *light, const struct light_sample *s,
                    rgb bsdf, rgb found)
{
    if (log == NULL)
        return;
    line(log, "  asks light %td (%s): direction " POINT_FORMAT,
         light - scene->lights, light_kinds[light->kind], POINT(s->direction));
    line(log, "    radiance " POINT_FORMAT ", bsdf " POINT_FORMAT ", %s %.5g",
         COLOR(s->radiance), COLOR(bsdf), s->delta ? "delta, pdf" : "pdf",
         (double)s->pdf);
    line(log, "    gives " POINT_FORMAT "%s", COLOR(found),
         rgb_is_black(found) && !rgb_is_black(bsdf) ? ": hidden" : "");
}

void path_log_scatter(struct path_log *log, const struct scatter *way)
{
    if (log == NULL)
        return;
    line(log,
         "  goes on along " POINT_FORMAT
         " (%s%s, pdf %.5g, weight " POINT_FORMAT ")",
         POINT(way->incoming), way->specular ? "specular" : "rough",
         way->transmitted ? ", through" : "", (double)way->pdf,
         COLOR(way->weight));
}

void path_log_found(struct path_log *log, rgb radiance, float share,
                    rgb throughput)
{
    if (log == NULL)
        return;
    line(log,
         "  finds light " POINT_FORMAT ", share %.4g, throughput " POINT_FORMAT,
         COLOR(radiance), (double)share, COLOR(throughput));
}

void path_log_result(struct path_log *log, rgb radiance)
{
    if (log == NULL)
        return;
    log->depth = 0;
    line(log, "= " POINT_FORMAT, COLOR(radiance));
}
