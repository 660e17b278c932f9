/* bench_embree.c - the peer: Embree 3 as its manual uses it. See
 * bench_caster.h. */
#include "bench_caster.h"

#ifdef RAYBOOK_EMBREE
#include <embree3/rtcore.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "bench_clock.h"

struct embree_peer {
    RTCDevice device;
    RTCScene scene;
    double bytes; /* that Embree says it holds */
};

static bool count_bytes(void *peer, ssize_t bytes, bool post)
{
    (void)post;
    ((struct embree_peer *)peer)->bytes += (double)bytes;
    return true;
}

static void stop(void *user, enum RTCError code, const char *message)
{
    (void)user;
    fprintf(stderr, "bench: Embree: error %d: %s\n", (int)code, message);
    exit(EXIT_FAILURE);
}

static RTCDevice make_device(struct embree_peer *peer, int threads)
{
    char settings[64];
    snprintf(settings, sizeof settings, "threads=%d,set_affinity=0", threads);
    RTCDevice device = rtcNewDevice(settings);
    if (device == NULL)
        stop(NULL, rtcGetDeviceError(NULL), "no device");
    rtcSetDeviceErrorFunction(device, stop, NULL);
    rtcSetDeviceMemoryMonitorFunction(device, count_bytes, peer);
    return device;
}

/* The mesh's own arrays, shared. */
static void attach_mesh(struct embree_peer *peer, const struct mesh *m)
{
    RTCGeometry g = rtcNewGeometry(peer->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               m->positions, 0, sizeof *m->positions,
                               m->vertex_count);
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               m->indices, 0, 3 * sizeof *m->indices,
                               m->triangle_count);
    rtcCommitGeometry(g);
    rtcAttachGeometry(peer->scene, g);
    rtcReleaseGeometry(g);
}

static struct RTCRay ray_for_embree(const struct bench_ray *r)
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

static void embree_nearest(void *state, const struct bench_ray rays[],
                           size_t count, float t[])
{
    RTCScene scene = ((struct embree_peer *)state)->scene;
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t i = 0; i < count; i++) {
        struct RTCRayHit question = {.ray = ray_for_embree(&rays[i])};
        question.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        question.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context, &question);
        t[i] = question.hit.geomID != RTC_INVALID_GEOMETRY_ID
                   ? question.ray.tfar
                   : INFINITY;
    }
}

static void embree_any(void *state, const struct bench_ray rays[], size_t count,
                       float t[])
{
    RTCScene scene = ((struct embree_peer *)state)->scene;
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t i = 0; i < count; i++) {
        struct RTCRay question = ray_for_embree(&rays[i]);
        rtcOccluded1(scene, &context, &question);
        t[i] = question.tfar < 0.0f ? 0.0f : INFINITY;
    }
}

static void embree_release(void *state)
{
    struct embree_peer *peer = state;
    rtcReleaseScene(peer->scene);
    rtcReleaseDevice(peer->device);
    mem_free(peer);
}

struct caster embree_caster_build(const struct mesh *m, int threads,
                                  bool robust)
{
    struct embree_peer *peer = mem_alloc(1, sizeof *peer);
    struct caster c = {
        peer, embree_nearest, embree_any, embree_release, 0.0, 0.0, 0.0};
    peer->device = make_device(peer, threads);
    peer->scene = rtcNewScene(peer->device);
    rtcSetSceneFlags(peer->scene,
                     robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(peer->scene, RTC_BUILD_QUALITY_MEDIUM);
    attach_mesh(peer, m);
    double bytes = peer->bytes, wall = clock_wall(), cpu = clock_process();
    rtcCommitScene(peer->scene);
    c.build_wall = clock_wall() - wall;
    c.build_cpu = clock_process() - cpu;
    c.bytes = peer->bytes - bytes;
    return c;
}
#else
/* ISO C wants a declaration in every file. */
typedef int no_embree_here;
#endif
