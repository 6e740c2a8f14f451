#pragma once
// The camera of editions 1 to 3, whose rays go through parts of the picture's sides.
struct camera {
  point3 origin, lower_left_corner;
  vec3 horizontal, vertical, u, v;
  double lens_radius, time0, time1;
  camera(point3 from, point3 at, vec3 vup, double vfov, double aspect, double aperture, double focus, double t0 = 0,
         double t1 = 0)
      : origin(from), lens_radius(aperture / 2), time0(t0), time1(t1) {
    const vec3 w = unit(from - at);
    u = unit(cross(vup, w));
    v = cross(w, u);
    vertical = 2 * std::tan(vfov * std::acos(-1.0) / 360) * focus * v;
    horizontal = aspect * vertical.length() * u;
    lower_left_corner = origin - 0.5 * horizontal - 0.5 * vertical - focus * w;
  }
  ray get_ray(double s, double t) const {
    const vec3 q = in_ball(), p = std::sqrt(random_double()) * unit(vec3(q[0], q[1], 0));
    const vec3 eye = origin + lens_radius * p[0] * u + lens_radius * p[1] * v;
    return ray(eye, lower_left_corner + s * horizontal + t * vertical - eye, random_double(time0, time1));
  }
};
