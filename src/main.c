/* main.c - raybook: renders a scene file into an image. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/options.h"
#include "program/results.h"
#include "program/session.h"
#include "program/version.h"
#include "scene/json_reader.h"

enum { EXIT_BAD_INPUT = 2 };

/* The exit code. */
static int render_scene(struct session *s, const struct results *r,
                        struct error *err)
{
    if (!session_load(s, err) || !results_possible(r, &s->options, err))
        return EXIT_BAD_INPUT;
    session_render(s);
    return results_write(r, s, err) ? EXIT_SUCCESS : EXIT_FAILURE;
}

static int run(struct session *s, int argc, char *argv[], struct error *err)
{
    if (s->options.help) {
        options_print_help();
        return EXIT_SUCCESS;
    }
    if (s->options.version) {
        puts("raybook " RAYBOOK_VERSION " (" RAYBOOK_VARIANT ")");
        return EXIT_SUCCESS;
    }
    struct results r = results_make(&s->options, argc, argv);
    int code = render_scene(s, &r, err);
    results_free(&r);
    return code;
}

int main(int argc, char *argv[])
{
    struct session s;
    struct error err = {""};
    memset(&s, 0, sizeof s);
    json_set_up();
    int code = EXIT_BAD_INPUT;
    if (options_parse(argc, argv, &s.options, &err))
        code = run(&s, argc, argv, &err);
    if (code != EXIT_SUCCESS)
        fprintf(stderr, "raybook: %s\n", err.text);
    session_free(&s);
    return code;
}
