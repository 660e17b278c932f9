/* bench_main.c - one program for all that is measured in C, so that it is
 * linked once: bench_programs.py. */
#include <stdio.h>
#include <string.h>

#include "bench_commands.h"

int main(int argc, char *argv[])
{
    static const struct {
        const char *name;
        int (*run)(int, char *[]);
    } commands[] = {{"cast", bench_cast},
                    {"build", bench_build},
                    {"work", bench_work},
                    {"load", bench_load},
                    {"image", bench_image}};
    for (size_t i = 0; argc > 1 && i < sizeof commands / sizeof *commands; i++)
        if (strcmp(commands[i].name, argv[1]) == 0)
            return commands[i].run(argc - 1, argv + 1);
    fprintf(stderr, "usage: bench cast|build|work|load|image ...\n");
    return 2;
}
