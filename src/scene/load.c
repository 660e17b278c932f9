/* load.c - the top level of a scene file; see load.h. */
#include "scene/load.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/nearest.h"
#include "scene/json_reader.h"
#include "scene/load_parts.h"

int find_named(struct json_reader *j, const cJSON *members, const cJSON *node,
               const char *kind)
{
    const char *name = json_string(j, node, "");
    int index = 0, count = cJSON_GetArraySize(members);
    const char **names = mem_alloc((size_t)count + 1, sizeof *names);
    int found = -1;
    for (const cJSON *m = members ? members->child : NULL; m; m = m->next) {
        if (strcmp(m->string, name) == 0)
            found = index;
        names[index++] = m->string;
    }
    const char *near = nearest_name(name, names);
    if (found < 0 && near != NULL)
        json_fault(j, node, "unknown %s \"%.64s\": did you mean \"%s\"?", kind,
                   name, near);
    else if (found < 0)
        json_fault(j, node, "unknown %s \"%.64s\", expected a name from /%ss",
                   kind, name, kind);
    mem_free(names);
    return found;
}

char *resolve_path(const struct json_reader *j, const char *path)
{
    const char *slash = strrchr(j->file, '/');
    size_t folder = slash ? (size_t)(slash - j->file) + 1 : 0;
    if (path[0] == '/')
        folder = 0;
    char *full = mem_alloc(folder + strlen(path) + 1, 1);
    memcpy(full, j->file, folder);
    strcpy(full + folder, path);
    return full;
}

int read_type(struct json_reader *j, const cJSON *node,
              const char *const names[])
{
    if (!cJSON_IsObject(node)) {
        json_unexpected(j, node, "an object { ... }");
        return -1;
    }
    const cJSON *type = json_require(j, node, "type");
    int kind = json_name(j, type, names);
    return json_fine(j) ? kind : -1;
}

static void load_all(struct json_reader *j, struct scene *scene)
{
    static const char *const keys[] = {
        "$schema",         "integrator", "film",    "camera",
        "textures",        "materials",  "objects", "sampler",
        "environment_map", "lights",     NULL};
    const cJSON *root = j->root;
    if (!json_keys(j, root, keys))
        return;
    json_string(j, json_get(root, "$schema"), "");
    load_integrator(j, json_get(root, "integrator"), scene);
    load_film(j, json_get(root, "film"), scene);
    load_camera(j, json_get(root, "camera"), scene);
    load_sampler(j, json_get(root, "sampler"), scene);
    load_textures(j, json_get(root, "textures"), scene);
    load_materials(j, json_get(root, "textures"), json_get(root, "materials"),
                   scene);
    load_lights(j, json_get(root, "lights"), scene);
    load_environment(j, json_get(root, "textures"),
                     json_get(root, "environment_map"), scene);
    load_objects(j, json_get(root, "materials"), json_get(root, "objects"),
                 scene);
    if (scene->object_count == 0)
        json_fault(j, root, "there are no objects, so nothing would be seen");
}

/* RFC 7396: members of the patch replace, null removes, objects merge. */
static void merge_patch(cJSON *target, const cJSON *patch)
{
    for (const cJSON *p = patch->child; p != NULL; p = p->next) {
        cJSON *old = cJSON_GetObjectItemCaseSensitive(target, p->string);
        if (cJSON_IsObject(p) && cJSON_IsObject(old)) {
            merge_patch(old, p);
            continue;
        }
        cJSON_DeleteItemFromObjectCaseSensitive(target, p->string);
        if (!cJSON_IsNull(p))
            cJSON_AddItemToObject(target, p->string, cJSON_Duplicate(p, 1));
    }
}

/* Merges the option's text into the document. */
static bool merge_text(struct json_reader *j, const char *override)
{
    struct json_reader patch;
    if (!json_open_text(&patch, "--override", override, j->err))
        return false;
    if (!cJSON_IsObject(patch.root)) {
        json_unexpected(&patch, patch.root, "an object { ... }");
        json_close(&patch);
        return false;
    }
    if (cJSON_IsObject(j->root))
        merge_patch(j->root, patch.root);
    json_close(&patch);
    return true;
}

bool scene_load(const char *path, const char *override, struct scene *out,
                struct error *err)
{
    struct json_reader j;
    memset(out, 0, sizeof *out);
    out->environment = -1;
    if (!json_open(&j, path, err))
        return false;
    if (override == NULL || merge_text(&j, override))
        load_all(&j, out);
    json_close(&j);
    return err->text[0] == '\0';
}
