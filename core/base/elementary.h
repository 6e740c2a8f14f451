#pragma once

/// Elementary functions that pictures depend on, by IEEE 754 operations alone, so that a scene is compiled to the same
/// bits by every C library. Those of libraries differ in the last bit. Errors are below one unit in the last place
/// (tests/base/math_test.cpp).
namespace tyndall {

/// Of an angle in radians, up to 2^20 on either side of 0. Beyond, the error is larger.
double sine(double x);
double cosine(double x);
double tangent(double x);
/// Of a number in [-1, 1].
double arc_cosine(double x);
/// The angle of the point (x, y), in [-π, π], as atan2() of C.
double arc_tangent(double y, double x);
/// Of a positive normal number.
double binary_logarithm(double x);
/// base >= 0; the error is so small where what comes out is a normal number.
double to_the_power(double base, double exponent);

}  // namespace tyndall
