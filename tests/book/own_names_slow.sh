#!/usr/bin/env bash
# What a program's own headers have beyond the books' names, where ours take their place.
. "$(dirname "$0")/_program.sh"

# Constants, helper functions, namespaces, macros, prototypes whose functions stand in a source file, and classes that
# only put shapes together.
mkdir -p own/src
cat >own/src/vec3.h <<'END'
#define BIG 7
using namespace std;
class vec3 { public: double x, y, z; };
vec3 halfway(const vec3& a, const vec3& b);
const vec3 origin_of_all(0, 0, -4);
namespace tools { inline double width() { return 2 * BIG; } }
END
echo 'vec3 halfway(const vec3& a, const vec3& b) { return 0.5 * (a + b); }' >own/src/vec3.cpp
echo 'class twins : public hittable_list { public: twins(double r) { add(make_shared<sphere>(vec3(r, 0, 0), r, make_shared<metal>(vec3(1, 1, 1), 0.0))); } };' >own/src/sphere.h
program own/src/main <<'END'
#include "vec3.h"
int main() { hittable_list w; w.add(make_shared<twins>(0.25)); vec3 p = halfway(origin_of_all, vec3(2, 0, 0)); p.y += 0.5;
  w.add(make_shared<SPHERE>(p, p.y(), make_shared<metal>(vec3(1, 1, 1), 0.0))); camera c; c.image_width = tools::width() + string("").size(); c.parallel_render(w); }
END
expect 0 "$tyndall" convert own/src/main.cc -o own.json
same 'size' "$(json own.json image)" '{"width": 14, "height": 14}'
same 'centres' "$(python3 -c 'import json; print([o["center"] for o in json.load(open("own.json"))["objects"]])')" '[[0.25, 0, 0], [1, 0.5, -2]]'

# A shape or a material of its own does no harm unless the scene has one, whether its header can be compiled or not.
echo 'class frosted : public material { };' >own/src/material.h
echo 'class torus : public hittable { my_box box; bool hit(no_such_type) const; };' >own/src/torus.h
program own/src/spare <<<"#include \"torus.h\"
$ball void other() { hittable_list w; w.add(make_shared<torus>(1, make_shared<frosted>(0.5))); } int main() { camera c; c.render(ball()); }"
expect 0 "$tyndall" convert own/src/spare.cc -o spare.json
sed 's/int main() {/& hittable_list w; w.add(make_shared<torus>(1, nullptr)); camera().render(w);/' own/src/spare.cc >own/src/used.cc
expect 2 "$tyndall" convert own/src/used.cc -o used.json
complains 'own/src/used.cc: torus: Tyndall has no such shape'

# Headers are found in other folders of the project, and whatever their capitals.
mkdir -p own/lib/Parts
echo 'inline double radius_of_ball() { return 0.75; }' >own/lib/Parts/Sizes.h
program own/src/far <<<'#include "parts/sizes.h"
int main() { hittable_list w; w.add(make_shared<sphere>(vec3(0, 0, -1), radius_of_ball(), make_shared<metal>(vec3(1, 1, 1), 0.0))); camera c; c.render(w); }'
expect 0 "$tyndall" convert own/src/far.cc -o far.json
grep -qF '"radius": 0.75' far.json || fail "$(cat far.json)"

# Functions of vectors and lists, a shape derived from one of the books' that ours cannot be mixed with, announced
# classes, the source file beside a header, headers in angles.
mkdir -p mine/src mine/include
cat >mine/include/vec3.h <<'END'
class vec3 { public: vec3() : e{0, 0, 0} {} vec3(double all);
  double norm1() const { return fabs(e[0]) + fabs(e[1]) + fabs(e[2]); } double e[3]; };
END
echo 'class hittable_list { public: int count() const { return (int)objects.size(); } std::vector<shared_ptr<hittable>> objects; };' >mine/include/hittable_list.h
echo 'class tile : public quad { public: tile(double a) : quad(a, a, a, nullptr) { missing(); } };' >mine/include/quad.h
echo '#include "vec3.h"
class Ray; double third(); double third_of(const vec3& v);' >mine/include/thirds.h
echo '#include "thirds.h"
#include "vec3.h"
double third_of(const vec3& v) { return v.norm1() / 3; }' >mine/src/thirds.cc
program mine/src/main <<'END'
#include "thirds.h"
#include <vec3.h>
#include <hittable_list.h>
#include <quad.h>
void tiles() { hittable_list w; w.add(make_shared<tile>(1)); }
int main() { hittable_list w; w.add(make_shared<sphere>(vec3(0, 0, -1), third_of(vec3(1, -2, 3)), make_shared<metal>(color(.25), 0)));
  camera c; c.image_width = 7 + w.count(); c.render(w); }
END
expect 0 "$tyndall" convert mine/src/main.cc -o mine.json
same 'width, radius, colour' "$(json mine.json image) $(grep -c '"radius": 2' mine.json) $(grep -c '0.25, 0.25, 0.25' mine.json)" '{"width": 8, "height": 8} 1 1'
sed 's/int main() {/& tiles();/; s/void tiles() { hittable_list w;/hittable_list w; void tiles() {/; s/c.render(w)/c.render(::w)/' mine/src/main.cc >mine/src/tiled.cc
expect 2 "$tyndall" convert mine/src/tiled.cc -o tiled.json
complains 'mine/src/tiled.cc: tile: Tyndall has no such shape'

# A camera's own values, names and members without effect.
mkdir camera
cat >camera/camera.h <<'END'
class camera { public: double aspect_ratio = 2.0; int image_width = 30; int sample_per_pix = 4; double vfov{40}; bool use_threads = true; int zoom; };
END
program camera/main <<<"$ball int main() { camera c; c.sample_per_pix = 9; c.use_threads = false; c.render(ball()); }"
expect 0 "$tyndall" convert camera/main.cc -o camera.json
same 'size and angle' "$(json camera.json image) $(json camera.json camera)" '{"width": 30, "height": 15} {"vfov": 40, "focus_distance": 10, "shutter": [0, 1]}'
complains "the camera's sample_per_pix is taken for samples_per_pixel"
refused camera/zoomed "has no member named 'zoom'" <<<"$ball int main() { camera c; c.zoom = 2; c.render(ball()); }"

# A camera whose constructor takes what the fourth edition's members hold.
mkdir made
cat >made/camera.h <<'END'
class Camera { public: Camera(double aspectRatio, int imageWidth, int samplesPerPixel = 10, vec3 lookfrom = {0, 0, 0}, const Vec3& up = vec3(0, 1, 0))
  : aspect_ratio(aspectRatio), image_width{imageWidth}, m_lookfrom(lookfrom) { this->samples_per_pixel = samplesPerPixel; vup = up; } };
END
program made/main <<<"$ball int main() { Camera c{2, 30, 7, {0, 1, 5}, {1, 0, 0}}; c.render(ball()); }"
expect 0 "$tyndall" convert made/main.cc -o made.json
same 'size and camera' "$(json made.json image) $(json made.json camera)" '{"width": 30, "height": 15} {"look_from": [0, 1, 5], "vup": [1, 0, 0], "focus_distance": 10, "shutter": [0, 1]}'
# One that makes something else of what it is given is not guessed at.
cp made/camera.h made/whole
sed -i 's/vup = up/vup = unit_vector(up + vec3(0, 0, 1))/' made/camera.h
expect 2 "$tyndall" convert made/main.cc -o made.json
cp made/whole made/camera.h
sed -i 's/, const Vec3& up/, int antialiasing/' made/camera.h
expect 2 "$tyndall" convert made/main.cc -o made.json
complains "made/main.cc:8:" "no matching" "; Tyndall's headers stand in the place of yours"

# What is missing in ours and cannot be taken over.
refused own/src/member "has no member named 'w'; Tyndall's headers stand in the place of yours" <<<'int main() { return vec3(1, 2, 3).w; }'

# Namespaces that the books' names are in, a camera that is prepared before it renders, lists with other words for add(),
# pointers of one owner, functions with a capital letter, and OpenMP.
mkdir -p spaces
cat >spaces/camera.h <<'END'
#pragma once
#include <memory>
namespace studio { namespace parts {
class vec3 { };
using Colour = vec3;
inline double dot(const vec3&, const vec3&);
class Metal { };
class Sphere { };
class HittableList { public: void Append(std::unique_ptr<Sphere> one); };
class Camera;
class Camera {
 public:
  int image_width = 14;
  vec3 v_up = vec3(0, 1, 0);
  double fieldOfView = 30;
  void Initialize();
  void Render(const HittableList& list);
};
} }
END
program spaces/main <<'END'
#include "camera.h"
#include <omp.h>
using namespace studio::parts;
int main() {
  studio::parts::HittableList w;
  w.Append(std::make_unique<studio::parts::Sphere>(studio::parts::vec3(0, 0, -1), 0.5 * omp_get_max_threads(), new Metal(studio::parts::Colour(1, 1, 1), 0.0)));
  hit_record record; ray out; color part; if (false) w.Hit(out, 0.0, 1.0, record) && record.mat->Scatter(out, record, part, out);
  Camera c; c.v_up = vec3(1, 0, 0); c.Initialize(); c.Render(w);
}
END
expect 0 "$tyndall" convert spaces/main.cc -o spaces.json
same 'camera in a namespace' "$(json spaces.json image) $(json spaces.json camera)" '{"width": 14, "height": 14} {"vup": [1, 0, 0], "vfov": 30, "focus_distance": 10, "shutter": [0, 1]}'
[ "$(grep -c "the camera's v_up is taken for vup" err)" = 1 ] || fail "told not once: $(cat err)"

finish
