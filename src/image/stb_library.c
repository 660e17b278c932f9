/* stb_library.c - stb_image and stb_image_write, compiled here and not taken
 * from the system's library, so that they allocate where everything else does,
 * and so that formats which we do not read are not in the program. */
#include <assert.h>

#include "base/memory.h"

#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_MALLOC(bytes) mem_alloc_bytes(bytes)
#define STBI_REALLOC(block, bytes) mem_resize_bytes(block, bytes)
#define STBI_FREE(block) mem_free(block)
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>

#define STBIW_MALLOC(bytes) mem_alloc_bytes(bytes)
#define STBIW_REALLOC(block, bytes) mem_resize_bytes(block, bytes)
#define STBIW_FREE(block) mem_free(block)
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
