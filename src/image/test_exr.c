/* test_exr.c - what is written is what is read back. */
#define _POSIX_C_SOURCE 200809L

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

#include "image/exr.h"
#include "image/read.h"

static char folder[] = "/tmp/raybook-exr-XXXXXX";
static char path[64];

void setUp(void)
{
    strcpy(folder, "/tmp/raybook-exr-XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/image.exr", folder);
}

void tearDown(void)
{
    remove(path);
    rmdir(folder);
}

/* xorshift32: G. Marsaglia, "Xorshift RNGs", 2003. */
static uint32_t next_random(uint32_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state;
}

/* Noise, then values that are all the same. */
static void fill(struct image *image, int noisy, uint32_t seed)
{
    float *values = &image->pixels[0].r;
    for (int i = 0; i < 3 * image->width * image->height; i++)
        values[i] =
            i < noisy ? (float)(next_random(&seed) >> 8) * 0x1p-24f : 0.5f;
}

static void round_trip(const struct image *image)
{
    struct image back;
    struct error err;
    TEST_ASSERT_TRUE(exr_write(path, image, NULL, 0, &err));
    TEST_ASSERT_TRUE(image_read(path, ENCODING_AUTO, &back, &err));
    size_t count = (size_t)image->width * (size_t)image->height;
    int different = memcmp(image->pixels, back.pixels, count * sizeof(rgb));
    image_free(&back);
    TEST_ASSERT_EQUAL_INT(0, different);
}

/* Noise grows by a few bytes when it is compressed, what is constant shrinks.
 * Somewhere in between are chunks that keep their size to the byte: for a
 * reader they are stored as they are. */
static void chunks_that_keep_their_size_survive(void)
{
    for (uint32_t seed = 1; seed <= 1200; seed++) {
        struct image image = image_make(40, 1);
        fill(&image, 60 + (int)(seed % 60), seed * 2654435761u);
        round_trip(&image);
        image_free(&image);
    }
}

/* The last chunk has fewer rows than the others. */
static void any_height_survives(void)
{
    for (int height = 1; height <= 35; height++) {
        struct image image = image_make(9, height);
        fill(&image, 1 << 20, (uint32_t)height);
        round_trip(&image);
        image_free(&image);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(chunks_that_keep_their_size_survive);
    RUN_TEST(any_height_survives);
    return UNITY_END();
}
