// The dense arithmetic of a factorisation, on columns of a panel. Sums run in one order at every width of lanes.
#pragma once
#include <cstddef>
#include <cstdint>

namespace cullet {

/// Column j of it starts at values[j * tall].
struct DenseColumns {
    double* values;
    size_t tall;
};

/// c -= a b, where b has `depth` rows of `columns` numbers, row after row. Rows: a multiple of kPanelStep. If
/// `from_zero`, what c held before is forgotten.
void subtract_product(uint32_t rows, uint32_t columns, uint32_t depth, const DenseColumns& a, const double* b,
                      const DenseColumns& c, bool from_zero);

/// L D L^T of the columns' first rows, D on the diagonal, and what is below times its inverse. False: a pivot is not
/// above `least`; it counts as 1e300, so that its unknown stays at zero.
bool eliminate_columns(uint32_t rows, uint32_t columns, const DenseColumns& c, double least);

/// y += x a.
void add_column(uint32_t rows, double x, const double* a, double* y);
/// Eight sums over every eighth number, then these: the order is part of the result.
double dot_column(uint32_t rows, const double* a, const double* b);

}  // namespace cullet
