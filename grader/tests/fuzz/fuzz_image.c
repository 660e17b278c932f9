/* fuzz_image.c - the image readers: EXR, HDR, PNG and JPEG. */
#include "fuzz_file.h"
#include "image/read.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *path = fuzz_file("fuzz.image", data, size);
    for (int encoding = ENCODING_AUTO; encoding <= ENCODING_LINEAR;
         encoding++) {
        struct image image;
        struct error err = {""};
        int fine =
            image_read(path, (enum image_encoding)encoding, &image, &err);
        fuzz_check_message(fine, err.text);
        image_free(&image);
    }
    return 0;
}
