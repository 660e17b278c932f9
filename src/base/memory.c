/* memory.c - see memory.h. */
#include "base/memory.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void out_of_memory(size_t count, size_t size)
{
    fprintf(stderr, "raybook: out of memory: %zu x %zu bytes\n", count, size);
    exit(EXIT_FAILURE);
}

#ifdef RAYBOOK_TEST_ALLOCATION
/* Is this the allocation that is to fail? */
static bool fails_now(void)
{
    static unsigned long number;
    const char *chosen = getenv("RAYBOOK_FAIL_ALLOCATION");
    bool now;
#pragma omp critical(mem_fails_now)
    now = ++number == (chosen ? strtoul(chosen, NULL, 10) : 0);
    return now;
}
#else
static bool fails_now(void)
{
    return false;
}
#endif

void *mem_alloc(size_t count, size_t size)
{
    void *block = NULL;
    if (!fails_now())
        block = calloc(count > 0 ? count : 1, size > 0 ? size : 1);
    if (block == NULL)
        out_of_memory(count, size);
    return block;
}

void *mem_resize(void *block, size_t count, size_t size)
{
    if (size > 0 && count > SIZE_MAX / size)
        out_of_memory(count, size);
    size_t bytes = count * size;
    void *grown = NULL;
    if (!fails_now())
        grown = realloc(block, bytes > 0 ? bytes : 1);
    if (grown == NULL)
        out_of_memory(count, size);
    return grown;
}

char *mem_copy_string(const char *text)
{
    size_t bytes = strlen(text) + 1;
    return memcpy(mem_alloc(bytes, 1), text, bytes);
}

void mem_free(void *block)
{
    free(block);
}

void *mem_alloc_bytes(size_t bytes)
{
    return mem_alloc(bytes, 1);
}

void *mem_resize_bytes(void *block, size_t bytes)
{
    return mem_resize(block, bytes, 1);
}
