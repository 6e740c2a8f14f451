#include "tests/bench/embree.h"

#if defined(TYNDALL_EMBREE)
#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <span>
#include <stdexcept>

namespace tyndall::bench {

struct Embree::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  ~State() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

constexpr std::size_t lanes = 16;

void trace_one(RTCScene scene, const TraceRay& from, TraceHit& hit) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit r{};
  r.ray.org_x = from.origin.x, r.ray.org_y = from.origin.y, r.ray.org_z = from.origin.z;
  r.ray.dir_x = from.direction.x, r.ray.dir_y = from.direction.y, r.ray.dir_z = from.direction.z;
  r.ray.tfar = std::numeric_limits<float>::infinity();
  r.ray.mask = ~0u;
  r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &r);
  const bool met = r.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  hit = {r.ray.tfar, met ? static_cast<std::int32_t>(r.hit.primID) : -1};
}

/// At most 16 rays.
void trace_sixteen(RTCScene scene, RTCIntersectContext& context, std::span<const TraceRay> from, TraceHit* hits) {
  alignas(64) int valid[lanes] = {};
  alignas(64) RTCRayHit16 r;
  for (std::size_t k = 0; k < from.size(); ++k) {
    valid[k] = -1;
    r.ray.org_x[k] = from[k].origin.x, r.ray.org_y[k] = from[k].origin.y, r.ray.org_z[k] = from[k].origin.z;
    r.ray.dir_x[k] = from[k].direction.x, r.ray.dir_y[k] = from[k].direction.y, r.ray.dir_z[k] = from[k].direction.z;
    r.ray.tnear[k] = 0;
    r.ray.tfar[k] = std::numeric_limits<float>::infinity();
    r.ray.time[k] = 0;
    r.ray.mask[k] = ~0u;
    r.ray.flags[k] = 0;
    r.hit.geomID[k] = r.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersect16(valid, scene, &context, &r);
  for (std::size_t k = 0; k < from.size(); ++k) {
    const bool met = r.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
    hits[k] = {r.ray.tfar[k], met ? static_cast<std::int32_t>(r.hit.primID[k]) : -1};
  }
}

}  // namespace

const char* embree_version() { return RTC_VERSION_STRING; }

Embree::Embree(const Spheres& spheres) : state_(std::make_unique<State>()) {
  // One thread; vectors as wide as the processor has them.
  state_->device = rtcNewDevice("threads=1,frequency_level=simd512");
  if (!state_->device) throw std::runtime_error("Embree gives no device");
  state_->scene = rtcNewScene(state_->device);
  RTCGeometry geometry = rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  const std::size_t count = spheres.center.size();
  auto* vertex = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), count));
  if (!vertex) throw std::runtime_error("Embree gives no memory");
  for (std::size_t i = 0; i < count; ++i, vertex += 4)
    vertex[0] = spheres.center.x[i], vertex[1] = spheres.center.y[i], vertex[2] = spheres.center.z[i],
    vertex[3] = spheres.radius[i];
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(state_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneBuildQuality(state_->scene, RTC_BUILD_QUALITY_HIGH);
  rtcCommitScene(state_->scene);
}

void Embree::trace(Width width, const std::vector<TraceRay>& rays, std::vector<TraceHit>& hits) const {
  hits.resize(rays.size());
  if (width == Width::one) {
    for (std::size_t i = 0; i < rays.size(); ++i) trace_one(state_->scene, rays[i], hits[i]);
    return;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (width == Width::sixteen_coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (std::size_t i = 0; i < rays.size(); i += lanes) {
    const std::size_t count = std::min(lanes, rays.size() - i);
    trace_sixteen(state_->scene, context, std::span(&rays[i], count), &hits[i]);
  }
}

#else

namespace tyndall::bench {

struct Embree::State {};
const char* embree_version() { return ""; }
Embree::Embree(const Spheres&) {}
void Embree::trace(Width, const std::vector<TraceRay>& rays, std::vector<TraceHit>& hits) const {
  hits.assign(rays.size(), {});
}

#endif

Embree::~Embree() = default;

}  // namespace tyndall::bench
