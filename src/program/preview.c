/* preview.c - see preview.h. */
#define _POSIX_C_SOURCE 200809L

#include "program/preview.h"

#include <stdio.h>
#include <unistd.h>

#include "image/png.h"
#include "program/progress.h"

/* The mean of the film's pixels under one of the preview's. */
static rgb block_mean(const struct image *image, int x, int y, int size)
{
    rgb sum = rgb_grey(0.0f);
    int count = 0;
    for (int j = y * size; j < (y + 1) * size && j < image->height; j++)
        for (int i = x * size; i < (x + 1) * size && i < image->width; i++) {
            size_t at = (size_t)j * (size_t)image->width + (size_t)i;
            sum = rgb_add(sum, image->pixels[at]);
            count++;
        }
    return rgb_scale(sum, count > 0 ? 1.0f / (float)count : 0.0f);
}

static void set_color(int layer, rgb c)
{
    fprintf(stderr, "\033[%d;2;%d;%d;%dm", layer, srgb_encode(c.r),
            srgb_encode(c.g), srgb_encode(c.b));
}

static void show_row(const struct image *image, int row, int columns, int size)
{
    enum { FOREGROUND = 38, BACKGROUND = 48 };
    for (int x = 0; x < columns; x++) {
        set_color(FOREGROUND, block_mean(image, x, 2 * row, size));
        set_color(BACKGROUND, block_mean(image, x, 2 * row + 1, size));
        fputs("\342\226\200", stderr);
    }
    fputs("\033[0m\n", stderr);
}

/* The side of a block, so that the picture fits the terminal's width and 40
 * lines. */
static int block_size(const struct image *image)
{
    int columns = progress_terminal_width() - 1;
    int size = 1;
    while (image->width > size * columns || image->height > size * 80)
        size++;
    return size;
}

void preview_show(struct preview *p, const struct film *film,
                  const struct window *w)
{
    if (!p->shown || isatty(STDERR_FILENO) != 1)
        return;
    struct image image = film_develop(film, w->x0, w->y0, w->x1, w->y1);
    int size = block_size(&image);
    int columns = (image.width + size - 1) / size;
    int rows = (image.height + 2 * size - 1) / (2 * size);
    fputs("\r\033[K", stderr);
    if (p->rows > 0)
        fprintf(stderr, "\033[%dA", p->rows);
    for (int row = 0; row < rows; row++)
        show_row(&image, row, columns, size);
    p->rows = rows;
    image_free(&image);
}
