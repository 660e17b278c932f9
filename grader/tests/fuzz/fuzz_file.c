/* fuzz_file.c - see fuzz_file.h. */
#include "fuzz_file.h"

#include <stdio.h>
#include <stdlib.h>

const char *fuzz_file(const char *name, const uint8_t *data, size_t size)
{
    FILE *file = fopen(name, "wb");
    if (file == NULL || fwrite(data, 1, size, file) != size ||
        fclose(file) != 0) {
        perror(name);
        abort();
    }
    return name;
}

int fuzz_tells;

void fuzz_check_message(int fine, const char *message)
{
    if (fuzz_tells)
        fprintf(stderr, "  %s%s\n", fine ? "read" : "refused: ", message);
    if (fine == (message[0] == '\0'))
        return;
    fprintf(stderr, "answer %d with the message \"%s\"\n", fine, message);
    abort();
}
