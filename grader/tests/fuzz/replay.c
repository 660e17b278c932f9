/* replay.c - runs a harness on files, without a fuzzer: replay FILE... */
#include <stdio.h>
#include <stdlib.h>

#include "fuzz_file.h"

static void run(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        perror(path);
        exit(2);
    }
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    rewind(file);
    uint8_t *data = malloc(size > 0 ? (size_t)size : 1);
    size_t got = data ? fread(data, 1, (size_t)size, file) : 0;
    fclose(file);
    fprintf(stderr, "%s\n", path); /* the last one told is the culprit */
    LLVMFuzzerTestOneInput(data, got);
    free(data);
}

int main(int argc, char *argv[])
{
    fuzz_tells = 1;
    for (int i = 1; i < argc; i++)
        run(argv[i]);
    return 0;
}
