/* image.c - see image.h. */
#include "image/image.h"

#include "base/memory.h"

struct image image_make(int width, int height)
{
    struct image image = {width, height, NULL};
    image.pixels = mem_alloc((size_t)width * (size_t)height, sizeof(rgb));
    return image;
}

void image_free(struct image *image)
{
    mem_free(image->pixels);
    image->pixels = NULL;
}
