/* progress.c - see progress.h. */
#define _POSIX_C_SOURCE 200809L

#include "program/progress.h"

#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

double progress_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

struct progress_bar progress_start(uint64_t total_samples, bool quiet)
{
    struct progress_bar bar = {!quiet && isatty(STDERR_FILENO) == 1,
                               progress_clock(), 0.0, total_samples};
    return bar;
}

int progress_terminal_width(void)
{
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
        return 80;
    return size.ws_col;
}

/* "[#####.....]" of the given number of columns, or nothing when there is no
 * room for it. */
static void draw_bar(double part, int columns, char *out)
{
    int inner = columns - 2, filled = (int)(part * inner);
    out[0] = '\0';
    if (inner < 1)
        return;
    out[0] = '[';
    memset(out + 1, '#', (size_t)filled);
    memset(out + 1 + filled, '.', (size_t)(inner - filled));
    strcpy(out + 1 + inner, "] ");
}

void progress_update(struct progress_bar *bar, uint64_t samples_done)
{
    double now = progress_clock(), elapsed = now - bar->started;
    char words[80], picture[64];
    if (!bar->shown || now - bar->drawn < 0.1 || samples_done == 0)
        return;
    bar->drawn = now;
    double part = (double)samples_done / (double)bar->total;
    double left = elapsed / part - elapsed;
    int length =
        snprintf(words, sizeof words, "%3.0f %%  %.2f Msamples/s  %.0f s left",
                 100.0 * part, 1e-6 * (double)samples_done / elapsed, left);
    int room = progress_terminal_width() - length - 3;
    draw_bar(part, room < 40 ? room : 40, picture);
    fprintf(stderr, "\r\033[K%s%.*s", picture, progress_terminal_width() - 1,
            words);
    fflush(stderr);
}

void progress_end(struct progress_bar *bar)
{
    if (bar->shown)
        fprintf(stderr, "\r\033[K");
    bar->shown = false;
}
