/* exr.h - OpenEXR files, through OpenEXRCore's C interface. */
#ifndef RAYBOOK_IMAGE_EXR_H
#define RAYBOOK_IMAGE_EXR_H

#include <stdbool.h>

#include "base/error.h"
#include "image/image.h"

/* One line of the file's header. */
struct exr_attribute {
    const char *name, *value;
};

/* One channel of an image: width x height values, row 0 at the top, `stride`
 * floats from one to the next. */
struct exr_channel {
    const char *name;
    const float *values;
    int stride;
};

/* Writes the channels as 32-bit floats, ZIP compressed, scanlines from the
 * top, with the attributes in the header. Half floats would turn everything
 * above 65504 into infinity. The file is complete or absent: it is written
 * beside and then renamed. false: *err says why. */
bool exr_write_channels(const char *path, int width, int height,
                        const struct exr_channel channels[], int channel_count,
                        const struct exr_attribute attributes[],
                        int attribute_count, struct error *err);

/* The same for an image's R, G and B. */
bool exr_write(const char *path, const struct image *image,
               const struct exr_attribute attributes[], int attribute_count,
               struct error *err);

#endif
