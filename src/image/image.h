/* image.h - a picture in memory: linear RGB, one float a component. */
#ifndef RAYBOOK_IMAGE_IMAGE_H
#define RAYBOOK_IMAGE_IMAGE_H

#include <stddef.h>

#include "base/rgb.h"

/* Row 0 is the top; pixels[y * width + x]. The image owns its pixels. */
struct image {
    int width, height;
    rgb *pixels;
};

/* A black image; width and height at least 1. Release with image_free. */
struct image image_make(int width, int height);

void image_free(struct image *image);

#endif
