// A system is a free function; its parameters say what it may touch, and are all that it sees.
//
//     In<&T::column>     reads any row; the old side of a two-sided column
//     Out<&T::column>    writes the rows it was given; the new side of a two-sided column
//     InOut<&T::column>  reads and writes the rows it was given
//     Table&, const Table&, Resource&, const Resource&   the whole of it: writes, or reads
//     Set&, const Set&   all tables of a set and of those that it stands on: RunRows : ShellRows : ...
//     Tables<T, const U>, a group (tables.hpp, table_group.hpp)   by value: several of these
//     InChunks<...>      a set or list for a parallel system, which writes the rows of its own chunk alone
//     Step and other plain values                        by value
//
// and exactly one of these says how often it is called, on what:
//
//     Rows<T>            once a chunk of rows of T, in parallel
//     Of<T>              in an inner loop: once for the row of T that it runs for; owns every row that belongs to it.
//                        Beside Rows<U> it says whose rows these are
//     Each<E>            once an event of the queue Events<E>, in parallel; owns every row of the event's body
//     EachOwn<E>         the same for events of the system's owner alone: E::owner names it. In a frame plan
//                        systems have the owner that the plan was told before them
//     Serial             once, on one thread. Own<E> gives it the events of its owner, Owner tells who that is
#pragma once
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "engine/arena.hpp"
#include "engine/events.hpp"
#include "engine/table.hpp"
#include "engine/table_group.hpp"
#include "engine/table_set.hpp"

namespace cullet {

template <class Member>
struct MemberOf;
template <class C, class T>
struct MemberOf<C T::*> {
    using Column = C;
    using Table = T;
};
template <auto Member>
using ColumnOf = typename MemberOf<decltype(Member)>::Column;
template <auto Member>
using TableOf = typename MemberOf<decltype(Member)>::Table;

template <auto Member>
class In {
 public:
    static constexpr auto kMember = Member;
    explicit In(const ColumnOf<Member>& column, int side = 0) : column_(&column), side_(side) {}
    decltype(auto) operator[](uint32_t row) const { return column_->get(row, side_); }
    const auto* lane(int k) const { return column_->lane(k, side_); }
    const auto* data() const { return column_->data(side_); }

 private:
    const ColumnOf<Member>* column_;
    int side_;
};

template <auto Member>
class InOut {
 public:
    static constexpr auto kMember = Member;
    explicit InOut(ColumnOf<Member>& column, int side = 0) : column_(&column), side_(side) {}
    decltype(auto) operator[](uint32_t row) const { return column_->get(row, side_); }
    void set(uint32_t row, const typename ColumnOf<Member>::Value& value) const { column_->set(row, value, side_); }
    auto* lane(int k) const { return column_->lane(k, side_); }
    auto* data() const { return column_->data(side_); }

 private:
    ColumnOf<Member>* column_;
    int side_;
};

template <auto Member>
class Out {
 public:
    static constexpr auto kMember = Member;
    explicit Out(ColumnOf<Member>& column, int side = 0) : column_(&column), side_(side) {}
    void set(uint32_t row, const typename ColumnOf<Member>::Value& value) const { column_->set(row, value, side_); }
    auto* lane(int k) const { return column_->lane(k, side_); }
    auto* data() const { return column_->data(side_); }

 private:
    ColumnOf<Member>* column_;
    int side_;
};

/// Rows [first, first + count) of T. for (auto v : rows).
template <class T>
struct Rows {
    uint32_t first = 0, count = 0;
    struct Iterator {
        uint32_t row;
        Row<T> operator*() const { return Row<T>(row); }
        Iterator& operator++() {
            ++row;
            return *this;
        }
        bool operator!=(Iterator other) const { return row != other.row; }
    };
    Iterator begin() const { return {first}; }
    Iterator end() const { return {first + count}; }
};

/// The row of T that an inner loop runs for: a task, a soft body, the springs of a shell. The loop's world knows it.
template <class T>
struct Of {
    Row<T> row;
};
/// The event this call is for.
template <class E>
struct Each {
    const E* event;
    const E* operator->() const { return event; }
    const E& operator*() const { return *event; }
};
template <class E>
struct EachOwn : Each<E> {};
struct Serial {};

/// Who registered the system.
struct Owner {
    uint32_t number;
};

/// The events of one owner in a queue, in its order.
template <class E>
class Own {
 public:
    struct End {};
    class Iterator {
     public:
        Iterator(std::span<const E> left, uint32_t owner) : left_(left), owner_(owner) { skip(); }
        const E& operator*() const { return left_.front(); }
        Iterator& operator++() {
            left_ = left_.subspan(1);
            skip();
            return *this;
        }
        bool operator!=(End) const { return !left_.empty(); }

     private:
        void skip() {
            while (!left_.empty() && left_.front().owner != owner_) left_ = left_.subspan(1);
        }
        std::span<const E> left_;
        uint32_t owner_;
    };
    Own(const Events<E>& events, uint32_t owner) : all_(events.all()), owner_(owner) {}
    Iterator begin() const { return {all_, owner_}; }
    End end() const { return {}; }

 private:
    std::span<const E> all_;
    uint32_t owner_;
};

/// The fixed step.
struct Step {
    float dt = 1.0f / 60.0f;     // s
    Vec3 gravity{0, -9.81f, 0};  // m/s2
    uint64_t frame = 0;
};

// ---------------------------------------------------------------------------------------------------------------------
// From a parameter list to accesses and calls.

enum class CallKind : uint8_t { Rows, Bodies, Serial };

/// What a system touches: "vertices.velocity", "springs" (a whole table), "RigidWorld" (a resource).
struct Access {
    std::string name;
    bool reads = false, writes = false, is_two_sided = false;
    enum class Kind : uint8_t { Resource, Table, EveryTable } kind = Kind::Resource;
    /// Equal names overlap, a table and any of its columns, and what holds every table with all of them.
    bool overlaps(const Access& other) const;
};

/// One call of a system.
template <class World>
struct Call {
    World& world;
    uint32_t first = 0, count = 0;  // rows
    uint32_t body = 0;
    int side = 0;        // the old side of two-sided columns
    uint32_t owner = 0;  // of the system
};

std::string type_name_of(std::string_view pretty);
template <class T>
std::string type_name() {
    return type_name_of(__PRETTY_FUNCTION__);
}

/// "springs.strain" for &Springs::strain.
template <auto Member>
std::string column_name() {
    using T = TableOf<Member>;
    T prototype(1u);
    const auto offset =
        reinterpret_cast<const std::byte*>(&(prototype.*Member)) - reinterpret_cast<const std::byte*>(&prototype);
    for (const ColumnInfo& column : prototype.columns())
        if (column.offset == static_cast<uint32_t>(offset)) return std::string(T::kName) + "." + column.name;
    return {};
}

template <class P>
struct Parameter;  // the primary template is for resources and values, below

template <auto M>
struct Parameter<In<M>> {
    static void describe(std::vector<Access>& list) {
        list.push_back({column_name<M>(), true, false, ColumnOf<M>::kBuffers == Buffers::Two, Access::Kind::Table});
    }
    template <class W>
    static In<M> bind(Call<W>& call) {
        return In<M>(call.world.template table<TableOf<M>>().*M, ColumnOf<M>::kBuffers == Buffers::Two ? call.side : 0);
    }
};
template <auto M>
struct Parameter<InOut<M>> {
    static void describe(std::vector<Access>& list) {
        list.push_back({column_name<M>(), true, true, false, Access::Kind::Table});
    }
    template <class W>
    static InOut<M> bind(Call<W>& call) {
        return InOut<M>(call.world.template table<TableOf<M>>().*M,
                        ColumnOf<M>::kBuffers == Buffers::Two ? call.side : 0);
    }
};
template <auto M>
struct Parameter<Out<M>> {
    static void describe(std::vector<Access>& list) {
        list.push_back({column_name<M>(), false, true, ColumnOf<M>::kBuffers == Buffers::Two, Access::Kind::Table});
    }
    template <class W>
    static Out<M> bind(Call<W>& call) {
        return Out<M>(call.world.template table<TableOf<M>>().*M,
                      ColumnOf<M>::kBuffers == Buffers::Two ? 1 - call.side : 0);
    }
};
template <class T>
struct Parameter<Rows<T>> {
    static void describe(std::vector<Access>&) {}
    template <class W>
    static Rows<T> bind(Call<W>& call) {
        return {call.first, call.count};
    }
};
template <class T>
struct Parameter<Of<T>> {
    static void describe(std::vector<Access>&) {}
    template <class W>
    static Of<T> bind(Call<W>& call) {
        return {call.world.template row_of<T>(call.body)};
    }
};
template <class E>
struct Parameter<Each<E>> {
    static void describe(std::vector<Access>& list) { list.push_back({type_name<Events<E>>(), true, false, false}); }
    template <class W>
    static Each<E> bind(Call<W>& call) {
        return {call.world.template resource<Events<E>>().all().data() + call.body};
    }
};
template <class E>
struct Parameter<EachOwn<E>> : Parameter<Each<E>> {
    template <class W>
    static EachOwn<E> bind(Call<W>& call) {
        return {Parameter<Each<E>>::bind(call)};
    }
};
template <>
struct Parameter<Owner> {
    static void describe(std::vector<Access>&) {}
    template <class W>
    static Owner bind(Call<W>& call) {
        return {call.owner};
    }
};
template <class E>
struct Parameter<Own<E>> {
    static void describe(std::vector<Access>& list) { list.push_back({type_name<Events<E>>(), true, false, false}); }
    template <class W>
    static Own<E> bind(Call<W>& call) {
        return {call.world.template resource<Events<E>>(), call.owner};
    }
};
template <>
struct Parameter<Serial> {
    static void describe(std::vector<Access>&) {}
    template <class W>
    static Serial bind(Call<W>&) {
        return {};
    }
};
template <class P>
requires std::is_lvalue_reference_v<P>
struct Parameter<P> {
    using Plain = std::remove_cvref_t<P>;
    static constexpr bool kWrites = !std::is_const_v<std::remove_reference_t<P>>;
    static void describe(std::vector<Access>& list) {
        if constexpr (IsWorkingMemory<P>)
            return;
        else if constexpr (IsTableSet<P>)
            describe_set(list);
        else if constexpr (IsTable<P>)
            list.push_back({Plain::kName, true, kWrites, false, Access::Kind::Table});
        else
            list.push_back({type_name<Plain>(), true, kWrites, false,
                            HoldsEveryTable<P> ? Access::Kind::EveryTable : Access::Kind::Resource});
    }
    template <class W>
    static P bind(Call<W>& call) {
        if constexpr (IsTableSet<P>)
            return call.world.template set<Plain>();
        else if constexpr (IsTable<P> || IsWorkingMemory<P>)
            return call.world.template table<Plain>();
        else
            return call.world.template resource<Plain>();
    }

 private:
    static void describe_set(std::vector<Access>& list) {
        using Below = typename Plain::Below;
        if constexpr (IsTableSet<Below>)
            Parameter<std::conditional_t<kWrites, Below&, const Below&>>::describe(list);
        else
            Parameter<Below>::describe(list);
        describe_own(list, TypeList<typename Plain::Own>{});
    }
    template <class Own>
    static void describe_own(std::vector<Access>& list, TypeList<Own>) {
        describe_tables(list, table_set::TypesOf<Own>{});
    }
    template <class... Own>
    static void describe_own(std::vector<Access>& list, TypeList<TypeList<Own...>>) {
        (describe_tables(list, table_set::TypesOf<Own>{}), ...);
    }
    template <class... T>
    static void describe_tables(std::vector<Access>& list, TypeList<T...>) {
        (describe_table<T>(list), ...);
    }
    template <class T>
    static void describe_table(std::vector<Access>& list) {
        if constexpr (IsTable<T>) list.push_back({T::kName, true, kWrites, false, Access::Kind::Table});
    }
};
template <class P>
requires(!std::is_lvalue_reference_v<P> && std::is_same_v<P, Step>) struct Parameter<P> {
    static void describe(std::vector<Access>&) {}
    template <class W>
    static P bind(Call<W>& call) {
        return call.world.template resource<P>();
    }
};

/// A set, or a list of tables, in a system that is called once a chunk of rows: it reads what it likes, and writes what
/// belongs to its rows.
template <class Set>
struct InChunks {
    using Held = std::conditional_t<kIsTables<Set>, Set, Set&>;
    explicit InChunks(Held s) : set(s) {}
    Set* operator->() { return &set; }
    Held set;
};
template <class Set>
struct Parameter<InChunks<Set>> {
    using Held = typename InChunks<Set>::Held;
    static void describe(std::vector<Access>& list) { Parameter<Held>::describe(list); }
    template <class W>
    static InChunks<Set> bind(Call<W>& call) {
        return InChunks<Set>(Parameter<Held>::bind(call));
    }
};

/// A group stands for the parameters that its members would be.
template <IsGroup G>
struct Parameter<G> {
    static void describe(std::vector<Access>& list) { describe_all(list, group::MembersOf<G>{}); }
    template <class W>
    static G bind(Call<W>& call) {
        return bind_all(call, group::MembersOf<G>{});
    }

 private:
    template <class... M>
    static void describe_all(std::vector<Access>& list, TypeList<M...>) {
        (Parameter<M>::describe(list), ...);
    }
    template <class W, class... M>
    static G bind_all(Call<W>& call, TypeList<M...>) {
        return G{Parameter<M>::bind(call)...};
    }
};

template <class P>
struct IsRows : std::false_type {};
template <class T>
struct IsRows<Rows<T>> : std::true_type {
    using Table = T;
};
template <class P>
struct IsEach : std::false_type {};
template <class E>
struct IsEach<Each<E>> : std::true_type {
    using Event = E;
};
template <class E>
struct IsEach<EachOwn<E>> : IsEach<Each<E>> {};
template <class P>
struct IsEachOwn : std::false_type {};
template <class E>
struct IsEachOwn<EachOwn<E>> : std::true_type {};
template <class P>
struct IsOf : std::false_type {};
template <class T>
struct IsOf<Of<T>> : std::true_type {};
template <class P>
struct IsTwoSided : std::false_type {};
template <auto M>
struct IsTwoSided<In<M>> : std::bool_constant<ColumnOf<M>::kBuffers == Buffers::Two> {};
template <auto M>
struct IsTwoSided<InOut<M>> : IsTwoSided<In<M>> {};
template <auto M>
struct IsTwoSided<Out<M>> : IsTwoSided<In<M>> {};

template <class A, class B>
inline constexpr bool kRaces = false;  // what is read of any row, and a write to it, in one parallel system
template <auto M>
inline constexpr bool kRaces<In<M>, Out<M>> = ColumnOf<M>::kBuffers == Buffers::One;
template <auto M>
inline constexpr bool kRaces<In<M>, InOut<M>> = true;
template <class T, auto M>
inline constexpr bool kRaces<const T&, Out<M>> = std::is_same_v<T, TableOf<M>>;
template <class T, auto M>
inline constexpr bool kRaces<const T&, InOut<M>> = std::is_same_v<T, TableOf<M>>;

template <class Function>
struct Signature;
template <class... P>
struct Signature<void (*)(P...)> {
    static constexpr bool kIsOfLoop = (... || IsOf<P>::value);
    static constexpr bool kIsOfOwner = (... || IsEachOwn<P>::value);
    static constexpr int kCallParameters =
        (0 + ... + int{IsRows<P>::value || IsEach<P>::value || std::is_same_v<P, Serial>});
    static_assert(kCallParameters == 1 || (kCallParameters == 0 && kIsOfLoop),
                  "a system takes exactly one of Rows<T>, Each<E>, Serial; in an inner loop Of<T> alone will do");
    static constexpr CallKind kKind = (... || IsRows<P>::value)                  ? CallKind::Rows
                                      : (kIsOfLoop || (... || IsEach<P>::value)) ? CallKind::Bodies
                                                                                 : CallKind::Serial;
    template <class A>
    static constexpr bool races_with_any() {
        if constexpr (IsGroup<A>)
            return []<class... M>(TypeList<M...>) { return (... || races_with_any<M>()); }(group::MembersOf<A>{});
        else
            return (... || kRaces<A, P>);
    }
    static_assert(
        kKind == CallKind::Serial || !(... || races_with_any<P>()),
        "a parallel system reads any row of what it writes: declare the column Buffers::Two, and no whole table");
    template <class A>
    static constexpr bool kChanges =
        std::is_lvalue_reference_v<A> && !std::is_const_v<std::remove_reference_t<A>> && !IsWorkingMemory<A>;
    /// Of what a parameter brings: itself, or a group's members.
    template <class A>
    static constexpr bool changes_any() {
        if constexpr (IsGroup<A>)
            return []<class... M>(TypeList<M...>) { return (... || changes_any<M>()); }(group::MembersOf<A>{});
        else
            return kChanges<A>;
    }
    template <class A>
    static constexpr bool changes_a_resource() {
        if constexpr (IsGroup<A>)
            return []<class... M>(TypeList<M...>) { return (... || changes_a_resource<M>()); }(group::MembersOf<A>{});
        else
            return kChanges<A> && !IsTable<A> && !IsTableSet<A> && !HoldsEveryTable<A>;
    }
    static_assert(kKind == CallKind::Serial || kKind == CallKind::Bodies || !(... || changes_any<P>()),
                  "only Serial, Of and Each systems may change a whole table, only Serial ones a resource");
    static_assert(
        kKind != CallKind::Bodies || kIsOfLoop || !(... || changes_a_resource<P>()),
        "calls of an Each system run at once: only a Serial system may change a resource, the arena or a queue");

    template <class P1>
    static auto row_table_of() {
        if constexpr (IsRows<P1>::value)
            return std::tuple<typename IsRows<P1>::Table*>{};
        else
            return std::tuple<>{};
    }
    using RowTables = decltype(std::tuple_cat(row_table_of<P>()...));
    template <class P1>
    static auto each_of() {
        if constexpr (IsEach<P1>::value)
            return std::tuple<typename IsEach<P1>::Event*>{};
        else
            return std::tuple<>{};
    }
    using Eaches = decltype(std::tuple_cat(each_of<P>()...));
    static constexpr bool kHasTwoSided = (... || IsTwoSided<P>::value);

    static std::vector<Access> accesses() {
        std::vector<Access> list;
        (Parameter<P>::describe(list), ...);
        return list;
    }
    template <auto System, class World>
    static void invoke(Call<World>& call) {
        System(Parameter<P>::bind(call)...);
    }
};

/// "integrate_hidden" for the function of that name.
template <auto System>
std::string system_name() {
    return type_name_of(__PRETTY_FUNCTION__);
}

/// Rows in a job: a constant of the table, never of the number of threads.
template <class T>
inline constexpr uint32_t kRowsPerChunk = 512;

/// Runs one system over all rows, on the calling thread: what tests use.
template <auto System, class World>
void run(World& world) {
    using Sig = Signature<decltype(System)>;
    Call<World> call{world};
    if constexpr (Sig::kKind == CallKind::Rows) {
        using T = std::remove_pointer_t<std::tuple_element_t<0, typename Sig::RowTables>>;
        call.count = world.template table<T>().size();
    }
    Sig::template invoke<System>(call);
}

}  // namespace cullet
