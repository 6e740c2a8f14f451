#include "core/specular/specular_trail.h"

#include <doctest/doctest.h>

#include <cmath>

/// Paths through panes by their event sequences: which faces they meet, and that a closed one of these closes the way.
namespace tyndall::test::slab_faces_test {

namespace {

constexpr int lower(int edge) { return 1 << 2 * edge; }
constexpr int upper(int edge) { return 2 << 2 * edge; }

/// The faces without which a way is open: those whose closing closes it. The near point is above the pane if `above`.
int faces_met(bool above, int across, double crossings, double first, double second) {
  SpecularFlat<double> slab{};
  SlabFrame<double> frame{};
  frame.near.height = above ? 3 : -3;
  const SlabSequence<double> sequence{across, crossings, {first, second}};
  int met = 0;
  for (int face = 0; face < 6; ++face) {
    slab.closed = 1 << face;
    if (!is_open(slab, frame, sequence)) met |= 1 << face;
  }
  slab.closed = 0;
  CHECK(is_open(slab, frame, sequence));
  slab.closed = met;
  CHECK(is_open(slab, frame, sequence) == (met == 0));
  slab.closed = 63 & ~met;
  CHECK(is_open(slab, frame, sequence));
  return met;
}

}  // namespace

TEST_CASE("specular paths: one off the outside of a slab meets the face on the point's side alone") {
  for (int edge = 0; edge < 3; ++edge) {
    CAPTURE(edge);
    CHECK(faces_met(true, edge, 0, 0, 0) == upper(edge));
    CHECK(faces_met(false, edge, 0, 0, 0) == lower(edge));
  }
}

TEST_CASE(
    "specular paths: one through a slab meets the two faces that it crosses, and the side faces that reflect it") {
  for (const bool above : {true, false})
    for (int edge = 0; edge < 3; ++edge) {
      CAPTURE(above);
      CAPTURE(edge);
      const int one = (edge + 1) % 3, two = (edge + 2) % 3, through = lower(edge) | upper(edge);
      CHECK(faces_met(above, edge, 1, 0, 0) == through);
      CHECK(faces_met(above, edge, 2, 0, 0) == through);
      CHECK(faces_met(above, edge, 1, 1, 0) == (through | upper(one)));
      CHECK(faces_met(above, edge, 1, -1, 0) == (through | lower(one)));
      CHECK(faces_met(above, edge, 1, 0, 1) == (through | upper(two)));
      CHECK(faces_met(above, edge, 3, -2, -1) == (through | lower(one) | upper(one) | lower(two)));
      CHECK(faces_met(above, edge, 1, 2, 2) == 63);
    }
}

}  // namespace tyndall::test::slab_faces_test
