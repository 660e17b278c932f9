/* stb.c - stb_image as source, so that the fuzzer sees its branches and the
 * sanitizers its mistakes; the same version as the library's. */
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
