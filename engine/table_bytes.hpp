// Tables as bytes: which columns stand there follows from the table's own list, and a reader whose list differs refuses
// them. A table is its name as a text, u32 rows, u32 columns; a column its name, u8 kind of scalar, u8 lanes, u8 sides,
// u8 components, u32 bytes a row, and lanes * sides arrays of rows. Only columns that are State.
#pragma once
#include <span>
#include <vector>

#include "engine/byte_stream.hpp"
#include "engine/table.hpp"

namespace cullet {

void put_table(ByteWriter& out, const AnyTable& table, uint32_t first, uint32_t rows);

/// Where the arrays of a table stand in the bytes, in the order of its State columns.
struct FoundTable {
    uint32_t rows = 0;
    std::vector<std::span<const uint8_t>> arrays;

    /// Into rows [first, first + rows), which the table has.
    void copy_to(AnyTable& table, uint32_t first) const;
};
/// Finds the table that has the columns of `like`; copies nothing. Trouble stays with the reader.
FoundTable find_table(ByteReader& in, const AnyTable& like);

}  // namespace cullet
