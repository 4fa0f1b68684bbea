#include "engine/math.hpp"

#include <bit>

namespace cullet {
namespace {
constexpr double kPi = 3.14159265358979323846;
constexpr double kLn2 = 0.69314718055994530942;
// pi/2 and ln 2 in two parts (Cody and Waite): the first has 33 and 32 bits, so that its product with an integer of up
// to 20 bits is exact.
constexpr double kHalfPiHigh = 0x1.921fb544p+0, kHalfPiLow = 0x1.0b4611a626331p-34;
constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;
}  // namespace

void sine_cosine(double x, double& sine, double& cosine) {
    const double quarter = std::floor(x / (kPi / 2) + 0.5);
    const double r = (x - quarter * kHalfPiHigh) - quarter * kHalfPiLow, r2 = r * r;
    double s = 0, c = 0;
    for (int n = 9; n >= 1; --n) {
        s = (1.0 + s) * -r2 / ((2.0 * n) * (2.0 * n + 1.0));
        c = (1.0 + c) * -r2 / ((2.0 * n - 1.0) * (2.0 * n));
    }
    s = r * (1.0 + s);
    c = 1.0 + c;
    switch (static_cast<int64_t>(quarter) & 3) {
        case 0:
            sine = s, cosine = c;
            break;
        case 1:
            sine = c, cosine = -s;
            break;
        case 2:
            sine = -s, cosine = -c;
            break;
        default:
            sine = -c, cosine = s;
            break;
    }
}

double arc_cosine(double x) {
    x = x < -1 ? -1 : x > 1 ? 1 : x;
    // Newton on cos(a) = x loses digits where the sine is small; the half angle does not.
    // acos(x) = 2 atan(sqrt((1 - x) / (1 + x))), atan by two argument halvings and its series.
    if (x == -1) return kPi;
    double t = std::sqrt((1 - x) / (1 + x));
    const bool is_large = t > 1;
    if (is_large) t = 1 / t;
    t = t / (1 + std::sqrt(1 + t * t));
    t = t / (1 + std::sqrt(1 + t * t));
    const double t2 = t * t;
    double sum = 0;
    for (int n = 14; n >= 0; --n) sum = 1.0 / (2 * n + 1) - t2 * sum;
    const double a = 4 * t * sum;
    return 2 * (is_large ? kPi / 2 - a : a);
}

double logarithm(double x) {
    const uint64_t bits = std::bit_cast<uint64_t>(x);
    int exponent = static_cast<int>((bits >> 52) & 2047) - 1023;
    double m = std::bit_cast<double>((bits & 0x000fffffffffffffull) | 0x3ff0000000000000ull);
    if (m > 1.4142135623730951) {
        m /= 2;
        ++exponent;
    }
    const double t = (m - 1) / (m + 1), t2 = t * t;
    double sum = 0;
    for (int n = 12; n >= 0; --n) sum = 1.0 / (2 * n + 1) + t2 * sum;
    return exponent * kLn2 + 2 * t * sum;
}

double exponential(double x) {
    const double k = std::floor(x / kLn2 + 0.5);
    const double r = (x - k * kLn2High) - k * kLn2Low;
    double sum = 1;
    for (int n = 16; n >= 1; --n) sum = 1 + r / n * sum;
    return sum * std::bit_cast<double>(static_cast<uint64_t>(static_cast<int64_t>(k) + 1023) << 52);
}

}  // namespace cullet
