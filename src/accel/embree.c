/* embree.c - see embree.h. */
#include "accel/embree.h"

#include <embree3/rtcore.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"

/* Embree computes the t of a plane as plane * (1 / d) - origin * (1 / d): each
 * term has 2 or 3 roundings of 2^-24 of its own size, which is that of the
 * coordinates and not of t. 2^-19 is ten times as much, and leaves room for
 * rays that start a few times as far away as the scene is large. */
static const float embree_slack = 0x1p-19f;

struct embree {
    RTCDevice device;
    RTCScene scene;
};

/* Building ---------------------------------------------------------------- */

/* What the bounds callback reads. */
struct source {
    const aabb *boxes;
    float pad;
};

static void give_bounds(const struct RTCBoundsFunctionArguments *args)
{
    const struct source *s = args->geometryUserPtr;
    const aabb *box = &s->boxes[args->primID];
    args->bounds_o->lower_x = box->lower.x - s->pad;
    args->bounds_o->lower_y = box->lower.y - s->pad;
    args->bounds_o->lower_z = box->lower.z - s->pad;
    args->bounds_o->upper_x = box->upper.x + s->pad;
    args->bounds_o->upper_y = box->upper.y + s->pad;
    args->bounds_o->upper_z = box->upper.z + s->pad;
}

static float largest_coordinate(const aabb boxes[], uint32_t count)
{
    vec3 size = vec3_make(0.0f, 0.0f, 0.0f);
    for (uint32_t i = 0; i < count; i++) {
        size = vec3_max(size, vec3_abs(boxes[i].lower));
        size = vec3_max(size, vec3_abs(boxes[i].upper));
    }
    return fmaxf(size.x, fmaxf(size.y, size.z));
}

/* Embree tells of its faults here; only lack of memory is to be expected. */
static void stop(void *user, enum RTCError code, const char *message)
{
    (void)user;
    fprintf(stderr, "raybook: %s: Embree: %s\n",
            code == RTC_ERROR_OUT_OF_MEMORY ? "out of memory" : "stopped",
            message);
    exit(EXIT_FAILURE);
}

static void test_nearest(const struct RTCIntersectFunctionNArguments *args);
static void test_any(const struct RTCOccludedFunctionNArguments *args);

static RTCGeometry make_geometry(RTCDevice device, struct source *s,
                                 uint32_t count)
{
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(g, count);
    rtcSetGeometryUserData(g, s);
    rtcSetGeometryBoundsFunction(g, give_bounds, NULL);
    rtcSetGeometryIntersectFunction(g, test_nearest);
    rtcSetGeometryOccludedFunction(g, test_any);
    rtcCommitGeometry(g);
    return g;
}

struct embree *embree_build(const aabb boxes[], uint32_t count)
{
    struct embree *e = mem_alloc(1, sizeof *e);
    struct source s = {boxes, embree_slack * largest_coordinate(boxes, count)};
    e->device = rtcNewDevice("threads=1,set_affinity=0");
    if (e->device == NULL)
        stop(NULL, rtcGetDeviceError(NULL), "no device");
    rtcSetDeviceErrorFunction(e->device, stop, NULL);
    e->scene = rtcNewScene(e->device);
    rtcSetSceneFlags(e->scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry g = make_geometry(e->device, &s, count);
    rtcAttachGeometry(e->scene, g);
    rtcCommitScene(e->scene);
    rtcSetGeometryUserData(g, NULL);
    rtcReleaseGeometry(g);
    return e;
}

void embree_free(struct embree *e)
{
    if (e == NULL)
        return;
    rtcReleaseScene(e->scene);
    rtcReleaseDevice(e->device);
    mem_free(e);
}

/* Asking ------------------------------------------------------------------ */

/* One question on its way through Embree: its context comes first, so that a
 * callback finds ours around the one that it is given. */
struct query {
    struct RTCIntersectContext embree;
    leaf_test_fn *test;
    const void *context;
    ray *r;
    void *hit;
    bool found;
};

static struct query query_make(ray *r, leaf_test_fn *test, const void *context,
                               void *hit)
{
    struct query q = {.test = test, .context = context, .r = r, .hit = hit};
    rtcInitIntersectContext(&q.embree);
    return q;
}

static bool test_one(struct RTCIntersectContext *embree, uint32_t primitive)
{
    struct query *q = (struct query *)embree;
    bool found = q->test(q->context, primitive, 1, q->r, q->hit);
    q->found = q->found || found;
    return found;
}

static void test_nearest(const struct RTCIntersectFunctionNArguments *args)
{
    if (args->valid[0] && test_one(args->context, args->primID))
        ((struct RTCRayHit *)args->rayhit)->ray.tfar =
            ((struct query *)args->context)->r->t_max;
}

static void test_any(const struct RTCOccludedFunctionNArguments *args)
{
    if (args->valid[0] && test_one(args->context, args->primID))
        ((struct RTCRay *)args->ray)->tfar = -INFINITY;
}

static struct RTCRay ray_for_embree(const ray *r)
{
    struct RTCRay out = {.org_x = r->origin.x,
                         .org_y = r->origin.y,
                         .org_z = r->origin.z,
                         .tnear = r->t_min,
                         .dir_x = r->direction.x,
                         .dir_y = r->direction.y,
                         .dir_z = r->direction.z,
                         .tfar = r->t_max,
                         .mask = UINT32_MAX};
    return out;
}

bool embree_nearest(const struct embree *e, ray *r, leaf_test_fn *test,
                    const void *context, void *hit)
{
    struct query q = query_make(r, test, context, hit);
    struct RTCRayHit question = {.ray = ray_for_embree(r)};
    question.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(e->scene, &q.embree, &question);
    return q.found;
}

bool embree_any(const struct embree *e, ray *r, leaf_test_fn *test,
                const void *context, void *hit)
{
    struct query q = query_make(r, test, context, hit);
    struct RTCRay question = ray_for_embree(r);
    rtcOccluded1(e->scene, &q.embree, &question);
    return q.found;
}
