#pragma once
#include "core/guide/lobes.h"
#include "core/trace/scene_view.h"

/// Weighs light that a path finds by BSDF sampling, after near-specular events, against guided light.
namespace tyndall {

/// What a path remembers in scenes with a guide.
template <class F>
struct GuideTrail {
  Vec3<F> start;      ///< where the path last scattered at a diffuse surface
  Vec3<F> direction;  ///< in which it left
  /// Pdf of that direction, per steradian, times the probability that glass has sent the path the way it went since.
  F pdf;
  OrderedEvents<F> events;  ///< since then
};

/// The trail's events and one more, at `element`.
template <class F>
TYNDALL_INLINE OrderedEvents<F> events_with(const SceneView& s, const GuideTrail<F>& trail, IntOf<F> element,
                                            MaskOf<F> reflected) {
  return append_event(trail.events, lookup<F>(s.guide.thing_of, s.elements.count(), element), reflected);
}

/// Weight, by the power heuristic, of light that a path found by BSDF sampling after `events`: r^2 / (1 + r^2), where r
/// is the pdf of the path's direction times the probability of its events over the pdf of guided queries. 1 where
/// guided queries cannot find it.
template <class F>
[[gnu::noinline]] static F mis_weight_beside_guide(const SceneView& s, GuideTrail<F> trail, OrderedEvents<F> events,
                                                   MaskOf<F> lanes) {
  lanes = mask_and(lanes, events.has_events());
  if (!any(lanes)) return F(1.0f);
  const GuidedSequence<F> sequence = find_sequence(s.guide, trail.start, events, lanes);
  const auto known = mask_and(lanes, less_equal(IntOf<F>(0), sequence.index));
  if (!any(known)) return F(1.0f);
  const F pdf = guided_pdf(guided_directions(s.guide, sequence, trail.start), trail.direction);
  const F inverse = pdf / max(trail.pdf, F(1e-37f));
  return select(known, F(1.0f) / mul_add(inverse, inverse, F(1.0f)), F(1.0f));
}

}  // namespace tyndall
