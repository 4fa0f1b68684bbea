// SoA tables. One line declares a column:
//
//     struct Springs : Table<Springs> {
//         using Table::Table;
//         CULLET_TABLE(springs);
//         Column<Row<Vertices>> a{*this, "a"};
//         Column<float> rest_length{*this, "rest_length", "m"};
//     };
//
// Storage, append, copy, hash, validate, first difference and printing follow from these lines. A column registers its
// offset once a type, not its address, so that tables can be staged, swapped and tested freely. A column reserves
// address space for the table's limit: rows never move when a table grows.
#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/assert.hpp"
#include "engine/hash.hpp"
#include "engine/math.hpp"
#include "engine/memory.hpp"
#include "engine/tables.hpp"

namespace cullet {

/// A table's name, in files and as a member of what has it (tables.hpp).
#define CULLET_TABLE(table_name)                      \
    static constexpr const char* kName = #table_name; \
    CULLET_NAMED(table_name)

inline constexpr uint32_t kNone = 0xffffffffu;

/// State is saved, hashed and compared between runs. Scratch is rebuilt before it is read.
enum class Keep : uint8_t { State, Scratch };

/// Two: a parallel system may read the old side of any row (In) while it writes the new side of its own (Out).
enum class Buffers : uint8_t { One, Two };

/// A row number in table T, good until T is compacted.
template <class T>
struct Row {
    uint32_t index = kNone;
    Row() = default;
    explicit constexpr Row(uint32_t i) : index(i) {}
    constexpr operator uint32_t() const { return index; }
    bool exists() const { return index != kNone; }
};

enum class Scalar : uint8_t { Bytes, U8, U16, U32, U64, F32, F64, Row };

struct ColumnInfo {
    const char* name;
    const char* unit;
    uint32_t offset;     // of the column inside the table object
    uint32_t row_bytes;  // of one lane
    uint8_t lanes;       // arrays: 3 for Vec3
    uint8_t sides;       // 1, or 2 for Buffers::Two
    Scalar scalar;
    uint8_t components;  // scalars in one row of one lane
    Keep keep;
    bool is_state() const { return keep != Keep::Scratch; }
};

/// How a value type lies in a column: `Lanes` arrays of `LaneType`, each row of an array `Components` scalars of one
/// kind.
template <class LaneType, Scalar Kind, uint8_t Components = 1, uint8_t Lanes = 1>
struct ColumnLayout {
    static constexpr uint8_t kLanes = Lanes;
    using Lane = LaneType;
    static constexpr Scalar kScalar = Kind;
    static constexpr uint8_t kComponents = Components;
};

// clang-format off
template <class T> struct ColumnType : ColumnLayout<T, Scalar::Bytes> {};
template <> struct ColumnType<uint8_t> : ColumnLayout<uint8_t, Scalar::U8> {};
template <> struct ColumnType<uint16_t> : ColumnLayout<uint16_t, Scalar::U16> {};
template <> struct ColumnType<uint32_t> : ColumnLayout<uint32_t, Scalar::U32> {};
template <> struct ColumnType<uint64_t> : ColumnLayout<uint64_t, Scalar::U64> {};
template <> struct ColumnType<float> : ColumnLayout<float, Scalar::F32> {};
template <> struct ColumnType<double> : ColumnLayout<double, Scalar::F64> {};
template <> struct ColumnType<Vec3> : ColumnLayout<float, Scalar::F32, 1, 3> {};
template <> struct ColumnType<Vec3d> : ColumnLayout<double, Scalar::F64, 1, 3> {};
template <> struct ColumnType<Quat> : ColumnLayout<Quat, Scalar::F32, 4> {};
template <> struct ColumnType<Sym3d> : ColumnLayout<Sym3d, Scalar::F64, 6> {};
template <class T> struct ColumnType<Row<T>> : ColumnLayout<Row<T>, Scalar::Row> {};
template <class T, size_t N>
struct ColumnType<std::array<T, N>> : ColumnLayout<std::array<T, N>, ColumnType<T>::kScalar, N> {};
// clang-format on

/// What is common to all tables: rows, limit, and everything that works from the list of columns.
class AnyTable {
 public:
    static constexpr uint32_t kDefaultLimit = 1u << 16;

    uint32_t size() const { return size_; }
    uint32_t limit() const { return limit_; }
    const char* name() const { return name_; }
    const std::vector<ColumnInfo>& columns() const { return *columns_; }

    /// First of `count` new rows, all zero, or kNone when the limit does not allow them.
    uint32_t append(uint32_t count);
    /// As many rows at least, with their memory at once: ranges are written late, and what is resident would grow for
    /// as long as a game runs.
    void reach(uint32_t rows) {
        if (rows <= size_) return;
        commit_rows(rows);
        append(rows - size_);
    }
    /// Rows from `count` on are forgotten.
    void truncate(uint32_t count) { size_ = count < size_ ? count : size_; }
    /// Copies all columns of [from, from + count) to [to, to + count) of this table or another of the same type.
    void copy_rows(const AnyTable& source, uint32_t from, uint32_t to, uint32_t count);
    void clear_rows(uint32_t first, uint32_t count);
    /// Pages for rows [0, count), so that a frame that reaches them meets no page fault (1 ns a byte, more than what it
    /// does with the row). It takes some more at once, since each call to the system costs. Those that were asked for
    /// before cost nothing. The first of them alone where they are more than `most` bytes; what it asked for, in bytes.
    uint64_t commit_rows(uint32_t count, uint64_t most = ~uint64_t{0});

    uint64_t hash(uint64_t seed) const;
    /// Empty, or a sentence naming the first value that is not finite, of State or Scratch. Infinity is not finite: a
    /// column whose "never" is infinite has to be written as its largest float.
    std::string validate() const;
    /// Empty, or "vertices.velocity[812].y: 1.5 here, 1.25 there" for the first State value that differs.
    std::string first_difference(const AnyTable& other) const;
    std::string describe_row(uint32_t row) const;
    uint64_t bytes_a_row() const;

    AnyTable(const AnyTable&) = delete;
    AnyTable& operator=(const AnyTable&) = delete;

    // For what works from the list of columns: files, comparisons, checks.
    /// Row 0 of one of the column's lanes * sides arrays.
    std::byte* column_memory(const ColumnInfo& column, int array) const;
    /// Of plain bytes: 16 of them, from byte `from` on.
    std::string describe_value(const ColumnInfo& column, int array, uint32_t row, uint32_t from = 0) const;
    /// "vertices.velocity[812].y"
    std::string place_of(const ColumnInfo& column, int array, uint32_t row) const;

 protected:
    explicit AnyTable(uint32_t limit) : limit_(limit), used_(is_reserved_zero() ? 0 : limit) {}
    ~AnyTable() = default;

    uint32_t size_ = 0, limit_ = 0, committed_ = 0;
    uint32_t used_ = 0;  // rows from here on are zero as the system gave them
    const char* name_ = "";
    const std::vector<ColumnInfo>* columns_ = nullptr;
};

/// The arrays of one column. Lane l of side s is array s * lanes + l.
struct ColumnMemory {
    static constexpr int kMostArrays = 6;
    std::byte* array[kMostArrays] = {};
};

template <class Self>
class Table : public AnyTable {
 public:
    using SelfTable = Self;
    explicit Table(uint32_t limit = kDefaultLimit) : AnyTable(limit) {
        if (!registering()) register_columns();
        columns_ = &list();
        name_ = Self::kName;
    }
    void swap(Self& other) {
        std::swap(size_, other.size_);
        std::swap(limit_, other.limit_);
        std::swap(committed_, other.committed_);
        std::swap(used_, other.used_);
        for (const ColumnInfo& c : list()) {
            auto* mine =
                reinterpret_cast<ColumnMemory*>(reinterpret_cast<std::byte*>(static_cast<Self*>(this)) + c.offset);
            auto* theirs = reinterpret_cast<ColumnMemory*>(reinterpret_cast<std::byte*>(&other) + c.offset);
            std::swap(*mine, *theirs);
        }
    }
    /// Called by the columns' constructors while the first table of this type is made.
    static std::vector<ColumnInfo>*& registering() {
        static thread_local std::vector<ColumnInfo>* current = nullptr;
        return current;
    }

 private:
    struct Registration {
        explicit Registration(std::vector<ColumnInfo>& found) { registering() = &found; }
        ~Registration() { registering() = nullptr; }
        Registration(const Registration&) = delete;
        Registration& operator=(const Registration&) = delete;
    };
    static std::vector<ColumnInfo>& list() {
        static std::vector<ColumnInfo> columns;
        return columns;
    }
    static void register_columns() {
        static const bool is_done = [] {
            std::vector<ColumnInfo> found;
            {
                const Registration listing(found);
                const Self prototype(1u);
            }
            list() = std::move(found);
            return true;
        }();
        (void)is_done;
    }
};

template <class T, Buffers B = Buffers::One>
class Column {
    static_assert(std::is_trivially_copyable_v<T>, "columns hold plain data");
    using Type = ColumnType<T>;
    using Lane = typename Type::Lane;
    static constexpr int kLanes = Type::kLanes;
    static constexpr int kSides = B == Buffers::Two ? 2 : 1;

 public:
    using Value = T;
    static constexpr Buffers kBuffers = B;

    template <class Owner>
    Column(Owner& table, const char* name, const char* unit = "1", Keep keep = Keep::State) : limit_(table.limit()) {
        if (auto* found = Owner::registering()) {
            const auto offset = reinterpret_cast<std::byte*>(this) - reinterpret_cast<std::byte*>(&table);
            found->push_back({name, unit, static_cast<uint32_t>(offset), sizeof(Lane), kLanes, kSides, Type::kScalar,
                              Type::kComponents, keep});
        }
        try {
            for (int a = 0; a < kLanes * kSides; ++a) memory_.array[a] = reserve_memory(size_t{limit_} * sizeof(Lane));
        } catch (...) {
            release();
            throw;
        }
    }
    ~Column() { release(); }
    Column(const Column&) = delete;
    Column& operator=(const Column&) = delete;

    /// One lane: a reference. Vec3, Vec3d: a value; write with set().
    decltype(auto) operator[](uint32_t row) { return at(row, 0); }
    decltype(auto) operator[](uint32_t row) const { return at(row, 0); }
    void set(uint32_t row, const T& value, int side = 0) {
        if constexpr (kLanes == 3) {
            lane(0, side)[row] = value.x, lane(1, side)[row] = value.y, lane(2, side)[row] = value.z;
        } else {
            lane(0, side)[row] = value;
        }
    }
    /// The value of a row on one side of a two-sided column.
    decltype(auto) get(uint32_t row, int side = 0) { return at(row, side); }
    decltype(auto) get(uint32_t row, int side = 0) const { return at(row, side); }
    Lane* lane(int k, int side = 0) { return reinterpret_cast<Lane*>(memory_.array[side * kLanes + k]); }
    const Lane* lane(int k, int side = 0) const {
        return reinterpret_cast<const Lane*>(memory_.array[side * kLanes + k]);
    }
    Lane* data(int side = 0) { return lane(0, side); }
    const Lane* data(int side = 0) const { return lane(0, side); }

 private:
    void release() {
        for (std::byte* array : memory_.array) release_memory(array, size_t{limit_} * sizeof(Lane));
    }
    decltype(auto) at(uint32_t row, int side) {
        if constexpr (kLanes == 3) {
            return T{lane(0, side)[row], lane(1, side)[row], lane(2, side)[row]};
        } else {
            return (lane(0, side)[row]);
        }
    }
    decltype(auto) at(uint32_t row, int side) const {
        if constexpr (kLanes == 3) {
            return T{lane(0, side)[row], lane(1, side)[row], lane(2, side)[row]};
        } else {
            return (lane(0, side)[row]);
        }
    }
    ColumnMemory memory_;  // first: swap() finds it at the registered offset
    uint32_t limit_;
};

/// A column of table Owner that takes no row of another table: what goes by several tables' rows cannot mix them up.
template <class Owner, class T>
class RowColumn : public Column<T> {
    using Base = Column<T>;
    template <class Other>
    static constexpr bool kIsForeign = !std::is_same_v<Other, Owner>;

 public:
    using Base::Base;
    using Base::set;
    decltype(auto) operator[](uint32_t row) { return Base::operator[](row); }
    decltype(auto) operator[](uint32_t row) const { return Base::operator[](row); }
    template <class Other>
    requires kIsForeign<Other>
    void operator[](Row<Other> row) const = delete;
    template <class Other>
    requires kIsForeign<Other>
    void set(Row<Other> row, const T& value, int side = 0) = delete;
};

}  // namespace cullet
