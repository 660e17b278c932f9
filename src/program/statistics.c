/* statistics.c - see statistics.h. */
#define _POSIX_C_SOURCE 200809L

#include "program/statistics.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

#include "image/replace.h"

static void add_rays(cJSON *root, const struct statistics *s)
{
    const struct counters *c = &s->counters;
    cJSON *rays = cJSON_AddObjectToObject(root, "rays");
    cJSON_AddNumberToObject(rays, "camera", (double)c->camera_rays);
    cJSON_AddNumberToObject(rays, "specular", (double)c->specular_rays);
    cJSON_AddNumberToObject(rays, "bounce", (double)c->bounce_rays);
    cJSON_AddNumberToObject(rays, "shadow", (double)c->shadow_rays);
}

static void add_work(cJSON *root, const struct statistics *s)
{
    const struct counters *c = &s->counters;
    cJSON_AddNumberToObject(root, "boxes_tested", (double)c->boxes_tested);
    cJSON_AddNumberToObject(root, "leaves_visited", (double)c->leaves_visited);
    cJSON_AddNumberToObject(root, "primitives_tested",
                            (double)c->primitives_tested);
    cJSON_AddNumberToObject(root, "samples", (double)c->samples);
    cJSON_AddNumberToObject(root, "samples_per_second",
                            (double)c->samples / s->render_seconds);
}

static void add_scene(cJSON *root, const struct statistics *s)
{
    cJSON_AddStringToObject(root, "accel", s->accel);
    cJSON_AddNumberToObject(root, "primitives", s->scene->primitive_count);
    cJSON_AddNumberToObject(root, "bvh_nodes", s->scene->accel.node_count);
    cJSON_AddNumberToObject(root, "threads", s->threads);
}

static void add_times(cJSON *root, const struct statistics *s)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    cJSON_AddNumberToObject(root, "load_seconds", s->load_seconds);
    cJSON_AddNumberToObject(root, "build_seconds", s->build_seconds);
    cJSON_AddNumberToObject(root, "render_seconds", s->render_seconds);
    cJSON_AddNumberToObject(root, "peak_memory_bytes",
                            1024.0 * (double)usage.ru_maxrss);
}

static bool write_text(const char *path, const char *text, struct error *err)
{
    struct replacement aside;
    if (!replace_begin(&aside, path, err))
        return false;
    FILE *file = fopen(aside.temporary, "w");
    bool fine = file != NULL && fputs(text, file) >= 0;
    if (file != NULL && fclose(file) != 0)
        fine = false;
    if (fine)
        return replace_commit(&aside, err);
    replace_abandon(&aside);
    return error_set(err, "%s: cannot write the statistics", path);
}

bool statistics_write(const struct statistics *s, const char *path,
                      struct error *err)
{
    cJSON *root = cJSON_CreateObject();
    add_scene(root, s);
    add_rays(root, s);
    add_work(root, s);
    add_times(root, s);
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    bool fine = true;
    if (strcmp(path, "-") == 0)
        puts(text);
    else
        fine = write_text(path, text, err);
    cJSON_free(text);
    return fine;
}
