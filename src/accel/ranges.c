/* ranges.c - see ranges.h. */
#include "accel/ranges.h"

#include <string.h>

#include "accel/lanes.h"

enum { BINS = 16 };

//> ranges.bounds: Join boxes of eight floats
static const float largest_side = 1e30f;

static const struct bounds nowhere = {{INFINITY, INFINITY, INFINITY, INFINITY,
                                       INFINITY, INFINITY, INFINITY, INFINITY}};

static inline void grow(struct bounds *restrict a,
                        const struct bounds *restrict b)
{
    for (int i = 0; i < 8; i++)
        a->side[i] = lesser(b->side[i], a->side[i]);
}

static inline float half_area(const struct bounds *b)
{
    float x = -b->side[4] - b->side[0];
    float y = -b->side[5] - b->side[1];
    float z = -b->side[6] - b->side[2];
    return x * y + y * z + z * x;
}

aabb bounds_box(const struct bounds *b)
{
    aabb box = {vec3_make(b->side[0], b->side[1], b->side[2]),
                vec3_make(-b->side[4], -b->side[5], -b->side[6])};
    return box;
}

/* Twice the centroid, as a box: lower + upper, and the same negated. */
static inline struct bounds twice_centroid(const struct reference *r)
{
    struct bounds c;
    for (int k = 0; k < 4; k++)
        c.side[k] = r->bounds.side[k] - r->bounds.side[k + 4];
    for (int k = 0; k < 4; k++)
        c.side[k + 4] = -c.side[k];
    return c;
}

/* Keeps sums and differences of sides finite. */
static float within_range(float x)
{
    return greater(-largest_side, lesser(x, largest_side));
}

struct reference reference_make(const aabb *box, uint32_t primitive, bool alone)
{
    struct reference r = {
        {{within_range(box->lower.x), within_range(box->lower.y),
          within_range(box->lower.z), 0.0f, -within_range(box->upper.x),
          -within_range(box->upper.y), -within_range(box->upper.z),
          alone ? -1.0f : 0.0f}}};
    memcpy(&r.bounds.side[3], &primitive, sizeof primitive);
    return r;
}

uint32_t reference_primitive(const struct reference *r)
{
    uint32_t primitive;
    memcpy(&primitive, &r->bounds.side[3], sizeof primitive);
    return primitive;
}

bool range_is_leaf(const struct range *range)
{
    bool one_alone = range->boxes.side[7] < 0.0f;
    return range->count <= (one_alone ? 1u : RANGE_LEAF);
}

struct range range_of_all(const struct reference references[], uint32_t count)
{
    struct range range = {0, count, nowhere, nowhere};
    float *box = range.boxes.side, *centroid = range.centroids.side;
#pragma omp parallel for reduction(min : box[:8], centroid[:8])
    for (uint32_t i = 0; i < count; i++) {
        struct bounds c = twice_centroid(&references[i]);
        for (int k = 0; k < 8; k++) {
            box[k] = lesser(references[i].bounds.side[k], box[k]);
            centroid[k] = lesser(c.side[k], centroid[k]);
        }
    }
    return range;
}
//< ranges.bounds

//> ranges.bins: Sort centroids into bins along all axes
struct bins {
    struct bounds boxes[3][BINS];
    uint32_t count[3][BINS];
};

/* From twice a centroid to its bin. scale is 0 along an axis on which the
 * centroids are all but one point. */
struct binning {
    float lower[3], scale[3];
};

static struct binning make_binning(const struct bounds *centroids)
{
    struct binning b;
    for (int k = 0; k < 3; k++) {
        float extent = -centroids->side[4 + k] - centroids->side[k];
        float scale = (float)BINS * (1.0f - 0x1p-20f) / extent;
        b.lower[k] = centroids->side[k];
        b.scale[k] = isfinite(scale) ? scale : 0.0f;
    }
    return b;
}

static inline uint32_t bin_of(const struct binning *b,
                              const struct reference *r, int axis)
{
    float c = r->bounds.side[axis] - r->bounds.side[axis + 4];
    return (uint32_t)(int32_t)((c - b->lower[axis]) * b->scale[axis]);
}

static void fill_bins(const struct reference *references,
                      const struct range *range, const struct binning *b,
                      struct bins *bins)
{
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < BINS; i++) {
            bins->boxes[axis][i] = nowhere;
            bins->count[axis][i] = 0;
        }
    for (uint32_t i = range->first; i < range->first + range->count; i++)
        for (int axis = 0; axis < 3; axis++) {
            uint32_t bin = bin_of(b, &references[i], axis);
            grow(&bins->boxes[axis][bin], &references[i].bounds);
            bins->count[axis][bin]++;
        }
}
//< ranges.bins

//> ranges.choose: Find the border that costs least
struct choice {
    int axis;
    uint32_t border; /* the first bin on the right; 0: no split */
    float cost;
};

/* A leaf costs as much with one primitive as with RANGE_LEAF. */
static inline float cost_of(const struct bounds *b, uint32_t count)
{
    uint32_t leaves = (count + RANGE_LEAF - 1) / RANGE_LEAF;
    return half_area(b) * (float)leaves;
}

static void sweep(const struct bins *bins, int axis, struct choice *best)
{
    float right_cost[BINS];
    struct bounds side = nowhere;
    uint32_t count = 0, total = 0;
    for (uint32_t i = BINS - 1; i > 0; i--) {
        grow(&side, &bins->boxes[axis][i]);
        total += bins->count[axis][i];
        right_cost[i] = total > 0 ? cost_of(&side, total) : 0.0f;
    }
    total += bins->count[axis][0];
    side = nowhere;
    for (uint32_t i = 1; i < BINS; i++) {
        grow(&side, &bins->boxes[axis][i - 1]);
        count += bins->count[axis][i - 1];
        if (count == 0 || count == total)
            continue;
        float cost = cost_of(&side, count) + right_cost[i];
        if (cost < best->cost)
            *best = (struct choice){axis, i, cost};
    }
}

static struct choice choose(const struct bins *bins, const struct binning *b)
{
    struct choice best = {0, 0, INFINITY};
    for (int axis = 0; axis < 3; axis++)
        if (b->scale[axis] > 0.0f)
            sweep(bins, axis, &best);
    return best;
}
//< ranges.choose

//> ranges.split: Move the left to the front
static void swap(struct reference *a, struct reference *b)
{
    struct reference keep = *a;
    *a = *b;
    *b = keep;
}

/* Moves what is left of the border to the front. */
static void partition(struct reference *references, const struct range *range,
                      const struct binning *b, const struct choice *choice,
                      struct range *left, struct range *right)
{
    uint32_t i = range->first, end = range->first + range->count;
    while (i < end) {
        struct bounds c = twice_centroid(&references[i]);
        if (bin_of(b, &references[i], choice->axis) < choice->border) {
            grow(&left->centroids, &c);
            i++;
        } else {
            grow(&right->centroids, &c);
            swap(&references[i], &references[--end]);
        }
    }
    left->count = i - range->first;
}

static void join_bins(const struct bins *bins, const struct choice *choice,
                      struct range *left, struct range *right)
{
    for (uint32_t i = 0; i < BINS; i++)
        grow(i < choice->border ? &left->boxes : &right->boxes,
             &bins->boxes[choice->axis][i]);
}

static void include(struct range *range, const struct reference *r)
{
    struct bounds c = twice_centroid(r);
    grow(&range->boxes, &r->bounds);
    grow(&range->centroids, &c);
}

/* As the references stand: the way out where centroids coincide, and where
 * the levels that are left would otherwise not do. */
static void halve(const struct reference *references, const struct range *range,
                  struct range *left, struct range *right)
{
    left->count = range->count / 2;
    for (uint32_t i = 0; i < range->count; i++)
        include(i < left->count ? left : right, &references[range->first + i]);
}

/* The number of levels that halving needs down to leaves, all of one. */
static int levels_needed(uint32_t count)
{
    int levels = 1;
    for (; count > 1; count -= count / 2)
        levels++;
    return levels;
}

void range_split(struct reference references[], const struct range *range,
                 int levels, struct range *left, struct range *right)
{
    struct choice choice = {0, 0, INFINITY};
    struct binning binning = make_binning(&range->centroids);
    struct bins bins;
    left->first = range->first;
    left->boxes = left->centroids = right->boxes = right->centroids = nowhere;
    if (levels_needed(range->count) < levels) {
        fill_bins(references, range, &binning, &bins);
        choice = choose(&bins, &binning);
    }
    if (choice.border > 0) {
        join_bins(&bins, &choice, left, right);
        partition(references, range, &binning, &choice, left, right);
    } else {
        halve(references, range, left, right);
    }
    right->first = left->first + left->count;
    right->count = range->count - left->count;
}
//< ranges.split
