"""The planted bugs, by rooms of core. Each is a mistake that somebody could make in one place.

(room, what it is, file, text, what becomes of it, tests that must catch it[, sources of the library]). The text stands once in
the file. The tests are compiled with the bug, the file itself where it is a .cpp, and the sources that are named; what the
tests have of a header by including it is often enough.
"""

BUGS = [
    # base
    ("base", "the second Sobol' dimension without its first step", "core/base/random.h",
     "  x = x ^ shift_left<16>(x);\n  x = x ^ shift_left<8>(x & U(0x00ff00ffu));", "  x = x ^ shift_left<8>(x & U(0x00ff00ffu));", "base/sobol"),
    ("base", "random numbers up to 2", "core/base/random.h", "* F(0x1p-24f)", "* F(0x1p-23f)", "base/random"),
    ("base", "a hemisphere in place of a sphere", "core/base/sampling.h", "mul_add(F(-2.0f), u.x, F(1.0f))", "mul_add(F(-1.0f), u.x, F(1.0f))", "base/sampling"),
    ("base", "points of a disc crowd in its middle", "core/base/sampling.h", "const F r = sqrt(u.x);", "const F r = u.x;", "base/sampling"),
    ("base", "one digit of a sine's coefficient", "core/base/math.h", "F(81.605225f)", "F(81.505225f)", "base/math"),
    ("base", "one digit of a logarithm's coefficient", "core/base/math.h", "F(0.33333313f)", "F(0.33323313f)", "base/math"),
    # The pause makes what two processors do by chance happen on one, too.
    ("base", "an unlocked counter", "core/base/thread_pool.cpp", "(i = next_.fetch_add(1, std::memory_order_relaxed)) < count",
     "(i = next_.load(), std::this_thread::yield(), next_.store(i + 1), i) < count", "base/thread_pool"),
    ("base", "what a job throws is lost", "core/base/thread_pool.cpp", "if (failure && !failure_) failure_ = failure;", "", "base/thread_pool"),
    # shapes
    ("shapes", "a sphere's far side is its near one", "core/shapes/sphere.h", "return {middle - half, middle + half, less", "return {middle - half, middle - half, less", "shapes/sphere"),
    ("shapes", "a ray that grazes a sphere from inside loses digits", "core/shapes/sphere.h", "equal(from & IntOf<F>(3), IntOf<F>(1))", "equal(from & IntOf<F>(3), IntOf<F>(0))", "shapes/sphere"),
    ("shapes", "a quad without its second edge", "core/shapes/quad.h", "abs(affine_point(quad, 1, p))", "abs(affine_point(quad, 0, p))", "shapes/quad"),
    ("shapes", "swapped faces of a box", "core/shapes/box.h", "select(is_y, I(2), I(4))", "select(is_y, I(4), I(2))", "shapes/box"),
    ("shapes", "a box that is endless along z", "core/shapes/box.h", "max(near.x, max(near.y, near.z)), t1", "max(near.x, near.y), t1", "shapes/box"),
    # materials
    ("materials", "a lost cosine", "core/materials/bsdf.h", "return max(dot(direction, in.facing), F(0.0f)) * F(static_cast<float>(1 / pi));",
     "return F(static_cast<float>(1 / pi));", "materials/lambertian materials/pdf"),
    ("materials", "fuzz that crowds in the middle", "core/materials/metal.h", "cube_root(in.sampler.next_1d(dimension::radius))", "in.sampler.next_1d(dimension::radius)", "materials/metal materials/pdf"),
    ("materials", "a wrong factor in the density of fuzz", "core/materials/metal.h", "mul_add(F(3.0f) * middle, middle, h * h)", "mul_add(F(2.0f) * middle, middle, h * h)", "materials/pdf"),
    ("materials", "fuzz below the surface shines", "core/materials/metal.h", "less_equal(dot(out, in.facing), F(0.0f))", "less(F(1.0f), F(0.0f))", "materials/metal"),
    ("materials", "a square lost in Fresnel's equations", "core/materials/dielectric.h", "const F e2 = eta * eta;", "const F e2 = eta;", "materials/fresnel"),
    ("materials", "inside and outside of glass swapped", "core/materials/dielectric.h", "select(in.exiting, F(1.0f) / glass.refractive_index, glass.refractive_index)",
     "select(in.exiting, glass.refractive_index, F(1.0f) / glass.refractive_index)", "materials/dielectric"),
    # media
    ("media", "flights grow with the density", "core/media/medium.h", "return -log(u) / density;", "return -log(u) * density;", "media/medium"),
    ("media", "a wrong power in the phase function", "core/media/medium.h", "(d * sqrt(d))", "(d * d)", "media/medium"),
    ("media", "a wrong number in the cosine of fog that is nearly even", "core/media/medium.h", "F(3.0f) + s2)", "F(2.0f) + s2)", "media/medium"),
    # textures
    ("textures", "a checker that is flat along z", "core/textures/checker.h", "floor(cell.x) + floor(cell.y) + floor(cell.z)", "floor(cell.x) + floor(cell.y)", "textures/checker"),
    ("textures", "pictures upside down", "core/textures/image.h", "mul_add(one - uv.v, last_row + one", "mul_add(uv.v, last_row + one", "textures/image"),
    ("textures", "pictures go round on quads", "core/textures/image.h", "select(uv.wraps, across, min(max(across, zero), last_column))", "across", "textures/image"),
    ("textures", "a wrong weight of octaves", "core/textures/noise.h", "weight *= 0.5f, frequency", "weight *= 0.6f, frequency", "textures/noise"),
    # film
    ("film", "a wrong limb: the low one is not added", "core/film/exact_sum.h", "    low += other.low;\n", "", "film/film", "core/film/film.cpp core/film/merge.cpp"),
    ("film", "a half written twice", "core/film/film.cpp", "to.sum[half][channel].add(from.sum[half][channel]);\n    to.rejected", "to.sum[half][channel].add(from.sum[0][channel]);\n    to.rejected", "film/film film/merge", "core/film/film.cpp core/film/merge.cpp"),
    ("film", "cut paths are not added up", "core/film/film.cpp", "  to.truncated += from.truncated;\n", "", "film/film film/merge", "core/film/film.cpp core/film/merge.cpp"),
    ("film", "odd counts lose a sample", "core/film/film.h", "(starts_here ? pixel.taken % 2 : 0)", "0", "film/film", "core/film/film.cpp core/film/merge.cpp"),
    ("film", "overlapping parts are merged", "core/film/merge.cpp", "if (taken > 0 && part.film.first_sample != end)", "if (taken > 0 && part.film.first_sample > end)", "film/merge", "core/film/film.cpp core/film/merge.cpp"),
    ("film", "the checksum leaves out what lamps sent", "core/film/film.cpp", "  sum.add(film.emission.data(), film.emission.size() * sizeof(EmissionSums));\n", "", "film/checksum"),
    ("film", "-0 changes the hash of a picture", "core/film/film.cpp", "value == 0 ? 0u : std::bit_cast<std::uint32_t>(value)", "std::bit_cast<std::uint32_t>(value)", "film/film", "core/film/film.cpp core/film/merge.cpp"),
    # image
    ("image", "a wrong end of the dark part of sRGB", "core/image/tonemap.cpp", "if (linear <= 0.0031308f)", "if (linear <= 0.031308f)", "image/tonemap"),
    ("image", "another order of luminance and chroma", "core/image/image_io_exr_layers.cpp", "{has(\"Y\"), has(\"RY\"), has(\"BY\")}", "{has(\"Y\"), has(\"BY\"), has(\"RY\")}", "image/image_io_exr_header"),
    ("image", "the white of an EXR is not adapted", "core/image/image_io_exr_read.cpp", "matrix = matrix * adaptation(neutral, rec709.white);", "matrix = matrix;", "image/image_io_exr_header"),
    ("image", "PFM with the top row first", "core/image/image_io_pnm.cpp", "subspan(left - row, row)", "subspan(image.rgb.size() - left, row)", "image/image_io_pfm"),
    ("image", "PFM files of the other byte order are read as they are", "core/image/image_io_pnm.cpp", "header.scale > 0));", "false));", "image/image_io_pfm image/image_io_hostile"),
    # accuracy
    ("accuracy", "black pixels dominate", "core/accuracy/error.cpp", "(square(ref) + floor_of_square)", "(square(ref) + 1e-6)", "accuracy/error"),
    ("accuracy", "the noise of halves counted twice", "core/accuracy/error.cpp", "(grey(half_mean(film, pixel, 0)) - grey(half_mean(film, pixel, 1))) / 2", "(grey(half_mean(film, pixel, 0)) - grey(half_mean(film, pixel, 1)))", "accuracy/bias"),
    ("accuracy", "a wrong power in FLIP", "core/accuracy/flip.cpp", ", 0.7);", ", 0.75);", "accuracy/flip_values"),
    ("accuracy", "the estimate takes half of the noise", "core/accuracy/estimate.cpp", "(a - b) * (a - b) / 4", "(a - b) * (a - b) / 8", "accuracy/estimate"),
    # clean
    ("clean", "pixels choose by their own noise", "core/clean/choice.h", "inline constexpr int hole_reach = 1;", "inline constexpr int hole_reach = -1;", "clean/clean clean/choice", "core/clean/scalar.cpp core/clean/clean.cpp"),
    ("clean", "all channels are judged by the level of their sum", "core/clean/choice.h", "const F own = per_sum * max(pa + pb, F(0.0f));", "const F own = level;", "clean/choice clean/clean", "core/clean/scalar.cpp core/clean/clean.cpp"),
    ("clean", "a swapped sign in a block's slope", "core/clean/regression.h", "if (i == 1) return own + cells.across(channel_sum(output, 0));", "if (i == 1) return own - cells.across(channel_sum(output, 0));", "clean/clean clean/choice", "core/clean/scalar.cpp core/clean/clean.cpp"),
    # scene
    ("scene", "keys with a slash are not escaped", "core/scene/place.cpp", "out += \"~1\";", "out += \"~0\";", "scene/place scene/override"),
    ("scene", "the third component is not checked", "core/scene/check.cpp", "for (std::size_t i = 0; i < 3; ++i) check_value({at, i}, meaning, components[i]);", "for (std::size_t i = 0; i < 2; ++i) check_value({at, i}, meaning, components[i]);", "scene/check"),
    # compile
    ("compile", "faces of a closed pane are open", "core/compile/flat_objects.cpp", "slab.closed |= 1 << i;", "slab.closed |= 0;", "render/specular_slabs"),
    ("compile", "a flat lamp is as long one way as the other", "core/compile/lights.cpp", "const double a = length(u), b = length(v);", "const double a = length(u), b = length(u);", "trace/light_pdf trace/lights"),
    ("compile", "a spherical lamp of twice its radius", "core/compile/lights.cpp", "out.length_u.push_back(static_cast<float>(r));", "out.length_u.push_back(static_cast<float>(2 * r));", "trace/light_pdf trace/lights"),
    # kernel
    ("kernel", "the inside of a closed pane is open", "core/specular/specular_slab.h", "return equal(met & slab.closed, I(0));", "return equal(slab.closed & I(0), I(0));", "specular/slab_faces"),
    ("kernel", "a pane's faces in a wrong order", "core/specular/specular_slab.h", "select(less(F(0.0f), s.near.height), I(2), I(1))", "select(less(F(0.0f), s.near.height), I(1), I(2))", "specular/slab_faces"),
    ("kernel", "the lens is a line", "core/trace/camera.h", "point_at(lens.x * splat<F>(c.lens_u), lens.y, splat<F>(c.lens_v))", "point_at(lens.x * splat<F>(c.lens_u), lens.x, splat<F>(c.lens_v))", "trace/camera"),
    ("kernel", "survivors of the roulette carry too little", "core/transport/scatter.h", "select(at_risk, scale * p.throughput, p.throughput)", "p.throughput", "render/depth", "core/targets/scalar.cpp"),
    ("kernel", "lamps that are found by chance count in full", "core/transport/direct_light.h", "select(could, F(1.0f) - others / mul_add(ratio, ratio, others), F(1.0f))", "F(1.0f)", "render/light_sampling", "core/targets/scalar.cpp"),
    # render
    ("render", "a lost column at a tile's edge", "core/render/pass.cpp", "std::min(x + tile_, region_.x1)", "std::min(x + tile_, region_.x1 - 1)", "render/same_picture"),
    ("render", "cells have a say in their own samples", "core/render/plan.cpp", "if (u == column && v == row) continue;", "", "render/plan"),
    ("render", "rejected samples of one half are not counted", "core/render/pass.cpp", "rejected += from.rejected[0] + from.rejected[1];", "rejected += from.rejected[0];", "render/losses"),
    ("render", "rounds spend more than they may", "core/render/plan.cpp", "const double mean = 2.0 * round_mean(film, &PlannedSamples::from);", "const double mean = 2.5 * round_mean(film, &PlannedSamples::from);", "render/plan"),
]
