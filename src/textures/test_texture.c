/* test_texture.c - constants, checkerboards, images, uv' = uv scale + delta. */
#include "textures/texture.h"

#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static struct texture_point at(float u, float v)
{
    struct texture_point p = {{u, v}, {0, 0}, {0, 0}};
    return p;
}

static struct texture texture_of(enum texture_kind kind)
{
    struct texture t = {0};
    t.kind = kind;
    t.color[0] = rgb_make(0.1f, 0.2f, 0.3f);
    t.color[1] = rgb_make(0.6f, 0.7f, 0.8f);
    t.scale = vec2_make(1, 1);
    return t;
}

/* Texel x of a row of size is x. */
static struct texture row_texture(int size, enum texture_filter filter)
{
    struct texture t = texture_of(TEXTURE_IMAGE);
    struct image row = image_make(size, 1);
    for (int i = 0; i < size; i++)
        row.pixels[i] = rgb_grey((float)i);
    t.image.filter = filter;
    t.image.max_anisotropy = 8;
    t.image.mipmap = mipmap_make(row, WRAP_REPEAT, true);
    return t;
}

static float red(const struct texture *t, float u, float v)
{
    struct texture_point p = at(u, v);
    return texture_color(t, &p).r;
}

static void test_a_constant_is_the_same_everywhere(void)
{
    struct texture t = texture_of(TEXTURE_CONSTANT);
    TEST_ASSERT_EQUAL_FLOAT(0.1f, red(&t, 0, 0));
    TEST_ASSERT_EQUAL_FLOAT(0.1f, red(&t, NAN, 1e30f));
    TEST_ASSERT_EQUAL_FLOAT(0.1f, texture_mean(&t).r);
    TEST_ASSERT_FALSE(texture_uses_footprint(&t));
}

static void test_a_checkerboard_alternates(void)
{
    struct texture t = texture_of(TEXTURE_CHECKERBOARD);
    for (int j = -7; j < 7; j++)
        for (int i = -7; i < 7; i++) {
            float u = 0.5f * (float)i + 0.25f, v = 0.5f * (float)j + 0.25f;
            TEST_ASSERT_EQUAL_FLOAT((i + j) % 2 == 0 ? 0.1f : 0.6f,
                                    red(&t, u, v));
        }
}

static void test_a_checkerboard_at_its_edges(void)
{
    struct texture t = texture_of(TEXTURE_CHECKERBOARD);
    TEST_ASSERT_EQUAL_FLOAT(0.1f, red(&t, 0, 0));
    TEST_ASSERT_EQUAL_FLOAT(0.6f, red(&t, 0.5f, 0));
    TEST_ASSERT_EQUAL_FLOAT(0.6f, red(&t, -1e-6f, 0));
    TEST_ASSERT_EQUAL_FLOAT(0.1f, red(&t, -1e-6f, -1e-6f));
    TEST_ASSERT_EQUAL_FLOAT(0.1f, red(&t, NAN, INFINITY));
    TEST_ASSERT_EQUAL_FLOAT(0.1f, red(&t, 3e38f, -3e38f));
}

static void test_scale_and_delta_move_a_checkerboard(void)
{
    struct texture t = texture_of(TEXTURE_CHECKERBOARD);
    t.scale = vec2_make(4, 1);
    t.delta = vec2_make(0.5f, 0);
    /* floor(2 (4 u + 0.5)) = 1 up to u = 0.125 */
    TEST_ASSERT_EQUAL_FLOAT(0.6f, red(&t, 0.1f, 0.1f));
    TEST_ASSERT_EQUAL_FLOAT(0.1f, red(&t, 0.13f, 0.1f));
    TEST_ASSERT_EQUAL_FLOAT(0.6f, red(&t, 0.13f, 0.6f));
}

static void check_checkerboard_mean(float su, float sv, float du, float dv)
{
    enum { SIDE = 400 };
    double sum = 0.0;
    struct texture t = texture_of(TEXTURE_CHECKERBOARD);
    t.scale = vec2_make(su, sv);
    t.delta = vec2_make(du, dv);
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i++)
            sum += red(&t, ((float)i + .5f) / SIDE, ((float)j + .5f) / SIDE);
    TEST_ASSERT_DOUBLE_WITHIN(3e-3, sum / (SIDE * SIDE), texture_mean(&t).r);
}

static void test_the_mean_of_a_checkerboard(void)
{
    check_checkerboard_mean(1, 1, 0, 0);
    check_checkerboard_mean(0.5f, 0.25f, 0, 0);
    check_checkerboard_mean(1.3f, 0.7f, -0.2f, 0.6f);
    check_checkerboard_mean(-1.7f, 0.4f, 0.1f, -3.3f);
    check_checkerboard_mean(0, 0.3f, 0.6f, 0.1f);
}

static void test_an_image_is_scaled_and_moved(void)
{
    struct texture t = row_texture(8, FILTER_NEAREST);
    t.scale = vec2_make(2, 1);
    t.delta = vec2_make(0.25f, 0);
    TEST_ASSERT_EQUAL_FLOAT(2, red(&t, 0, 0));
    TEST_ASSERT_EQUAL_FLOAT(7, red(&t, 0.37f, 0));
    TEST_ASSERT_EQUAL_FLOAT(0, red(&t, 0.38f, 0)); /* repeats */
    texture_free(&t);
}

/* Each filter answers by its own function of mipmap.h. */
static void test_filters(void)
{
    struct texture t = row_texture(64, FILTER_NEAREST);
    const struct mipmap *m = &t.image.mipmap;
    struct texture_point p = {{.33f, .5f}, {.3f, 0}, {0, .1f}};
    TEST_ASSERT_EQUAL_FLOAT(21, texture_color(&t, &p).r);
    t.image.filter = FILTER_BILINEAR;
    TEST_ASSERT_EQUAL_FLOAT(.33f * 64 - .5f, texture_color(&t, &p).r);
    t.image.filter = FILTER_TRILINEAR;
    TEST_ASSERT_EQUAL_FLOAT(mipmap_trilinear(m, p.uv, p.uv_dx, p.uv_dy).r,
                            texture_color(&t, &p).r);
    t.image.filter = FILTER_EWA;
    TEST_ASSERT_EQUAL_FLOAT(mipmap_ewa(m, p.uv, p.uv_dx, p.uv_dy, 8).r,
                            texture_color(&t, &p).r);
    texture_free(&t);
}

static void test_scale_enlarges_the_footprint(void)
{
    struct texture t = row_texture(64, FILTER_TRILINEAR);
    struct texture_point p = {{.3f, .5f}, {1.0f / 64, 0}, {0, 0}};
    t.scale = vec2_make(8, 1);
    vec2 uv = vec2_make(.3f * 8, .5f);
    /* 8 texels: level 3 */
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, mipmap_bilinear(&t.image.mipmap, 3, uv).r,
                             texture_color(&t, &p).r);
    texture_free(&t);
}

static void test_who_uses_the_footprint(void)
{
    struct texture t = row_texture(4, FILTER_NEAREST);
    TEST_ASSERT_FALSE(texture_uses_footprint(&t));
    t.image.filter = FILTER_BILINEAR;
    TEST_ASSERT_FALSE(texture_uses_footprint(&t));
    t.image.filter = FILTER_TRILINEAR;
    TEST_ASSERT_TRUE(texture_uses_footprint(&t));
    t.image.filter = FILTER_EWA;
    TEST_ASSERT_TRUE(texture_uses_footprint(&t));
    texture_free(&t);
    t = texture_of(TEXTURE_CHECKERBOARD);
    t.image.filter = FILTER_EWA;
    TEST_ASSERT_FALSE(texture_uses_footprint(&t));
}

static void test_the_mean_of_an_image(void)
{
    struct texture whole = row_texture(7, FILTER_EWA);
    TEST_ASSERT_EQUAL_FLOAT(3, texture_mean(&whole).g);
    struct texture single = row_texture(7, FILTER_BILINEAR);
    for (int i = 1; i < single.image.mipmap.level_count; i++)
        image_free(&single.image.mipmap.levels[i]);
    single.image.mipmap.level_count = 1;
    TEST_ASSERT_EQUAL_FLOAT(3, texture_mean(&single).g);
    texture_free(&whole);
    texture_free(&single);
}

static void test_freeing_what_was_never_loaded(void)
{
    struct texture t = texture_of(TEXTURE_IMAGE);
    texture_free(&t);
    TEST_ASSERT_EQUAL_INT(0, t.image.mipmap.level_count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_constant_is_the_same_everywhere);
    RUN_TEST(test_a_checkerboard_alternates);
    RUN_TEST(test_a_checkerboard_at_its_edges);
    RUN_TEST(test_scale_and_delta_move_a_checkerboard);
    RUN_TEST(test_the_mean_of_a_checkerboard);
    RUN_TEST(test_an_image_is_scaled_and_moved);
    RUN_TEST(test_filters);
    RUN_TEST(test_scale_enlarges_the_footprint);
    RUN_TEST(test_who_uses_the_footprint);
    RUN_TEST(test_the_mean_of_an_image);
    RUN_TEST(test_freeing_what_was_never_loaded);
    return UNITY_END();
}
