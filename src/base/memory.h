/* memory.h - the program's one allocator, with one out-of-memory path.
 *
 * mem_alloc and mem_resize never return NULL for a size above zero: when
 * memory runs out the program says how much it asked for and exits with
 * status 1. What a user's input can make too large (a film, a mesh) is
 * checked by its reader before it comes here. The libraries that let us choose
 * (cJSON, OpenEXRCore, stb) allocate here too.
 *
 * In a build with RAYBOOK_TEST_ALLOCATION the environment's variable
 * RAYBOOK_FAIL_ALLOCATION is the number, from 1, of the allocation that fails:
 * grader/tests/renderer/test_allocation.py tries them all. */
#ifndef RAYBOOK_BASE_MEMORY_H
#define RAYBOOK_BASE_MEMORY_H

#include <stddef.h>

/* count x size bytes set to zero; the caller owns them: mem_free. */
void *mem_alloc(size_t count, size_t size);

/* block (NULL, or from this allocator) with room for count x size bytes; new
 * bytes are not set. The old pointer is dead afterwards. */
void *mem_resize(void *block, size_t count, size_t size);

/* Owned copy of a string. */
char *mem_copy_string(const char *text);

/* Releases a block; NULL is fine. */
void mem_free(void *block);

/* mem_alloc, and mem_resize, as libraries want them: of so many bytes. */
void *mem_alloc_bytes(size_t bytes);
void *mem_resize_bytes(void *block, size_t bytes);

#endif
