#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "systems/models/lattice/solve/panel_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>

#include "systems/models/lattice/solve/panel_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace cullet {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::CappedTag<double, 8>;
using Lane = hn::Vec<Doubles>;

// kVectors vectors of rows by kColumns columns stay in registers over the whole depth.
template <int kVectors, int kColumns>
HWY_INLINE void subtract_block(uint32_t depth, const double* a, size_t a_tall, const double* b, size_t b_wide,
                               double* c, size_t c_tall, bool from_zero) {
    const Doubles d;
    const size_t lanes = hn::Lanes(d);
    Lane sum[kVectors][kColumns];
    for (int v = 0; v < kVectors; ++v)
        for (int k = 0; k < kColumns; ++k)
            sum[v][k] = from_zero ? hn::Zero(d)
                                  : hn::LoadU(d, c + static_cast<size_t>(k) * c_tall + static_cast<size_t>(v) * lanes);
    for (uint32_t i = 0; i < depth; ++i) {
        Lane left[kVectors];
        for (int v = 0; v < kVectors; ++v) left[v] = hn::LoadU(d, a + i * a_tall + static_cast<size_t>(v) * lanes);
        for (int k = 0; k < kColumns; ++k) {
            const Lane right = hn::Set(d, b[i * b_wide + static_cast<size_t>(k)]);
            for (int v = 0; v < kVectors; ++v) sum[v][k] = hn::Sub(sum[v][k], hn::Mul(left[v], right));
        }
    }
    for (int v = 0; v < kVectors; ++v)
        for (int k = 0; k < kColumns; ++k)
            hn::StoreU(sum[v][k], d, c + static_cast<size_t>(k) * c_tall + static_cast<size_t>(v) * lanes);
}

template <int kColumns>
HWY_INLINE void subtract_strip(uint32_t rows, uint32_t depth, const double* a, size_t a_tall, const double* b,
                               size_t b_wide, double* c, size_t c_tall, bool from_zero) {
    const size_t lanes = hn::Lanes(Doubles());
    size_t r = 0;
    for (; r + 2 * lanes <= rows; r += 2 * lanes)
        subtract_block<2, kColumns>(depth, a + r, a_tall, b, b_wide, c + r, c_tall, from_zero);
    for (; r < rows; r += lanes) subtract_block<1, kColumns>(depth, a + r, a_tall, b, b_wide, c + r, c_tall, from_zero);
}

void subtract_product_lanes(uint32_t rows, uint32_t columns, uint32_t depth, const double* a, size_t a_tall,
                            const double* b, double* c, size_t c_tall, bool from_zero) {
    uint32_t k = 0;
    for (; k + 4 <= columns; k += 4)
        subtract_strip<4>(rows, depth, a, a_tall, b + k, columns, c + k * c_tall, c_tall, from_zero);
    if (columns - k == 3) subtract_strip<3>(rows, depth, a, a_tall, b + k, columns, c + k * c_tall, c_tall, from_zero);
    if (columns - k == 2) subtract_strip<2>(rows, depth, a, a_tall, b + k, columns, c + k * c_tall, c_tall, from_zero);
    if (columns - k == 1) subtract_strip<1>(rows, depth, a, a_tall, b + k, columns, c + k * c_tall, c_tall, from_zero);
}

void add_column_lanes(uint32_t rows, double x, const double* a, double* y) {
    const Doubles d;
    const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(d));
    const Lane factor = hn::Set(d, x);
    uint32_t r = 0;
    for (; r + lanes <= rows; r += lanes)
        hn::StoreU(hn::Add(hn::LoadU(d, y + r), hn::Mul(factor, hn::LoadU(d, a + r))), d, y + r);
    for (; r < rows; ++r) y[r] = y[r] + x * a[r];
}

double dot_column_lanes(uint32_t rows, const double* a, const double* b) {
    const Doubles d;
    constexpr uint32_t kSums = 8;
    const uint32_t lanes = static_cast<uint32_t>(hn::Lanes(d));
    HWY_ALIGN double sums[kSums] = {};
    uint32_t r = 0;
    for (; r + kSums <= rows; r += kSums)
        for (uint32_t k = 0; k < kSums; k += lanes)
            hn::StoreU(hn::Add(hn::LoadU(d, sums + k), hn::Mul(hn::LoadU(d, a + r + k), hn::LoadU(d, b + r + k))), d,
                       sums + k);
    for (uint32_t k = 0; r < rows; ++r, ++k) sums[k] = sums[k] + a[r] * b[r];
    return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

}  // namespace HWY_NAMESPACE
}  // namespace cullet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cullet {
HWY_EXPORT(subtract_product_lanes);
HWY_EXPORT(add_column_lanes);
HWY_EXPORT(dot_column_lanes);

void subtract_product(uint32_t rows, uint32_t columns, uint32_t depth, const DenseColumns& a, const double* b,
                      const DenseColumns& c, bool from_zero) {
    HWY_DYNAMIC_DISPATCH(subtract_product_lanes)
    (rows, columns, depth, a.values, a.tall, b, c.values, c.tall, from_zero);
}

void add_column(uint32_t rows, double x, const double* a, double* y) {
    HWY_DYNAMIC_DISPATCH(add_column_lanes)(rows, x, a, y);
}

double dot_column(uint32_t rows, const double* a, const double* b) {
    return HWY_DYNAMIC_DISPATCH(dot_column_lanes)(rows, a, b);
}

bool eliminate_columns(uint32_t rows, uint32_t columns, const DenseColumns& c, double least) {
    constexpr double kHeld = 1e300;
    bool is_positive = true;
    for (uint32_t j = 0; j < columns; ++j) {
        double* column = c.values + j * c.tall;
        if (!(column[j] > least)) column[j] = kHeld, is_positive = false;
        const double pivot = column[j], inverse = 1 / pivot;
        for (uint32_t r = j + 1; r < rows; ++r) column[r] = column[r] * inverse;
        for (uint32_t k = j + 1; k < columns; ++k)
            add_column(rows - k, -(column[k] * pivot), column + k, c.values + k * c.tall + k);
    }
    return is_positive;
}

}  // namespace cullet
#endif
