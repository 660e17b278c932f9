/* environment.c - assignment 09: an alias table, which picks a cell in two
 * steps whatever their number (M. Vose, "A Linear Algorithm for Generating
 * Random Numbers with a Given Distribution", IEEE Transactions on Software
 * Engineering 17(9), 1991). A cell lies between four texel centres; in it all
 * directions are as likely. */
#include "lights/environment.h"

#include <stddef.h>

#include "base/constants.h"
#include "base/memory.h"

struct cell {
    double probability; /* of the cell */
    double keep;        /* the share of its slot that is its own */
    int alias;          /* whose the rest is */
};

struct environment_table {
    int columns, rows;
    bool black;
    struct cell *cells;
};

static rgb wrapped(const struct image *image, int x, int y)
{
    while (x < 0)
        x += image->width;
    while (x >= image->width)
        x -= image->width;
    y = y < 0 ? 0 : y;
    y = y > image->height - 1 ? image->height - 1 : y;
    return image->pixels[y * image->width + x];
}

/* Row r of cells begins at the centres of row r - 1. */
static double cosine_at(int row, int height)
{
    double theta = (double)PI * (row - 0.5) / height;
    return cos(fmin(fmax(theta, 0.0), (double)PI));
}

static double cell_weight(const struct image *image, int column, int row)
{
    double sum = 0.0;
    for (int i = 0; i < 4; i++)
        sum += (double)rgb_luminance(
            wrapped(image, column + i % 2, row - 1 + i / 2));
    return sum *
           (cosine_at(row, image->height) - cosine_at(row + 1, image->height));
}

/* Fills the small from the large ones until all are even. */
static void even_out(struct environment_table *t, int count)
{
    int *order = mem_alloc((size_t)count, sizeof *order);
    int small = 0, large = count;
    for (int i = 0; i < count; i++) {
        t->cells[i].keep = t->cells[i].probability * count;
        t->cells[i].alias = i;
        if (t->cells[i].keep < 1.0)
            order[small++] = i;
        else
            order[--large] = i;
    }
    while (small > 0 && large < count) {
        struct cell *poor = &t->cells[order[--small]];
        int rich = order[large];
        poor->alias = rich;
        t->cells[rich].keep -= 1.0 - poor->keep;
        if (t->cells[rich].keep < 1.0) {
            large++;
            order[small++] = rich;
        }
    }
    while (small > 0) /* what rounding has left */
        t->cells[order[--small]].keep = 1.0;
    mem_free(order);
}

struct environment_table *environment_table_make(const struct image *image)
{
    struct environment_table *t = mem_alloc(1, sizeof *t);
    t->columns = image->width;
    t->rows = image->height + 1;
    int count = t->columns * t->rows;
    t->cells = mem_alloc((size_t)count, sizeof *t->cells);
    double total = 0.0;
    for (int i = 0; i < count; i++) {
        t->cells[i].probability =
            cell_weight(image, i % t->columns, i / t->columns);
        total += t->cells[i].probability;
    }
    t->black = !(total > 0.0);
    for (int i = 0; i < count; i++)
        t->cells[i].probability =
            t->black ? 1.0 / count : t->cells[i].probability / total;
    even_out(t, count);
    return t;
}

void environment_table_free(struct environment_table *table)
{
    if (table != NULL)
        mem_free(table->cells);
    mem_free(table);
}

static double turn_back(const struct environment *e, int axis, vec3 d)
{
    const float *row = e->to_world.inverse[axis];
    return (double)row[0] * d.x + (double)row[1] * d.y + (double)row[2] * d.z;
}

/* In cells: x from 0 to columns, y from 0 to rows. */
static void find_cell(const struct environment *e, vec3 d, double *x, double *y)
{
    double a = turn_back(e, 0, d), b = turn_back(e, 1, d);
    double c = turn_back(e, 2, d);
    double u = atan2(b, a) / (2.0 * (double)PI);
    *x = (u < 0.0 ? u + 1.0 : u) * e->image->width - 0.5;
    *x += *x < 0.0 ? e->image->width : 0.0;
    *y = atan2(hypot(a, b), c) / (double)PI * e->image->height + 0.5;
}

rgb environment_radiance(const struct environment *e, vec3 direction)
{
    double x, y;
    find_cell(e, direction, &x, &y);
    int column = (int)x, row = (int)y;
    float a = (float)(x - column), b = (float)(y - row);
    rgb sum = rgb_grey(0.0f);
    for (int i = 0; i < 4; i++) {
        float share = (i % 2 ? a : 1.0f - a) * (i / 2 ? b : 1.0f - b);
        rgb value = wrapped(e->image, column + i % 2, row - 1 + i / 2);
        sum = rgb_add(sum, rgb_scale(value, share * e->scale));
    }
    return sum;
}

static float cell_density(const struct environment *e, int cell)
{
    const struct environment_table *t = e->table;
    int row = cell / t->columns;
    double band =
        cosine_at(row, e->image->height) - cosine_at(row + 1, e->image->height);
    double solid = 2.0 * (double)PI / t->columns * band;
    return (float)(t->cells[cell].probability / solid);
}

float environment_sample(const struct environment *e, vec2 random,
                         vec3 *direction)
{
    const struct environment_table *t = e->table;
    int count = t->columns * t->rows;
    double slot = (double)random.x * count;
    int cell = (int)slot;
    double rest = slot - cell;
    double keep = t->cells[cell].keep;
    /* What is left of the number serves again. */
    double across = rest < keep ? rest / keep : (rest - keep) / (1.0 - keep);
    if (!(rest < keep))
        cell = t->cells[cell].alias;
    int row = cell / t->columns;
    double upper = cosine_at(row, e->image->height);
    double lower = cosine_at(row + 1, e->image->height);
    double z = upper + (double)random.y * (lower - upper);
    double phi =
        2.0 * (double)PI * (cell % t->columns + 0.5 + across) / t->columns;
    double side = sqrt(fmax(0.0, 1.0 - z * z));
    vec3 local =
        vec3_make((float)(side * cos(phi)), (float)(side * sin(phi)), (float)z);
    *direction = vec3_normalize(transform_direction(&e->to_world, local));
    return cell_density(e, cell);
}

float environment_pdf(const struct environment *e, vec3 direction)
{
    double x, y;
    if (e->table->black)
        return 1.0f / (4.0f * PI);
    find_cell(e, direction, &x, &y);
    return cell_density(e, (int)y * e->table->columns + (int)x);
}
