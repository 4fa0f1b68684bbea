#include "engine/table_bytes.hpp"

#include <algorithm>

namespace cullet {

void put_table(ByteWriter& out, const AnyTable& table, uint32_t first, uint32_t rows) {
    const auto is_kept = [](const ColumnInfo& c) { return c.is_state(); };
    out.text(table.name());
    out.number(rows);
    out.number(static_cast<uint32_t>(std::count_if(table.columns().begin(), table.columns().end(), is_kept)));
    for (const ColumnInfo& c : table.columns()) {
        if (!is_kept(c)) continue;
        out.text(c.name);
        for (const uint8_t kind : {static_cast<uint8_t>(c.scalar), c.lanes, c.sides, c.components}) out.number(kind);
        out.number(c.row_bytes);
        for (int a = 0; a < c.lanes * c.sides; ++a)
            out.put(table.column_memory(c, a) + size_t{first} * c.row_bytes, size_t{rows} * c.row_bytes);
    }
}

void FoundTable::copy_to(AnyTable& table, uint32_t first) const {
    size_t next = 0;
    for (const ColumnInfo& c : table.columns()) {
        if (!c.is_state()) continue;
        for (int a = 0; a < c.lanes * c.sides; ++a, ++next)
            if (rows > 0)
                std::memcpy(table.column_memory(c, a) + size_t{first} * c.row_bytes, arrays[next].data(),
                            arrays[next].size());
    }
}

FoundTable find_table(ByteReader& in, const AnyTable& like) {
    FoundTable found;
    const std::string name = like.name();
    in.expect(in.text("a table's name") == name, "the table " + name + " is not");
    found.rows = in.number<uint32_t>("a number of rows");
    const auto columns = in.number<uint32_t>("a number of columns");
    uint32_t wanted = 0;
    for (const ColumnInfo& c : like.columns()) {
        if (!c.is_state()) continue;
        ++wanted;
        const std::string full = name + "." + c.name;
        in.expect(in.text("a column's name") == c.name, "the column " + full + " is not");
        for (const uint8_t kind : {static_cast<uint8_t>(c.scalar), c.lanes, c.sides, c.components})
            in.expect(in.number<uint8_t>("a column's type") == kind, "another type of " + full + " is");
        in.expect(in.number<uint32_t>("a column's row") == c.row_bytes, "another size of " + full + " is");
        for (int a = 0; a < c.lanes * c.sides; ++a)
            found.arrays.push_back(in.take(uint64_t{found.rows} * c.row_bytes, full.c_str()));
        if (!in.is_sound()) return found;
    }
    in.expect(columns == wanted,
              name + " states " + std::to_string(columns) + " columns, not " + std::to_string(wanted) + ",");
    return found;
}

}  // namespace cullet
