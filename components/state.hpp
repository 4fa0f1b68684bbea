// Everything that a world remembers, listed once.
#pragma once
#include <string>
#include <tuple>

#include "components/ages.hpp"
#include "components/blows.hpp"
#include "components/bodies.hpp"
#include "components/materials.hpp"
#include "components/quick.hpp"
#include "components/regions.hpp"
#include "components/shells.hpp"
#include "components/soft.hpp"
#include "components/springs.hpp"
#include "components/tasks.hpp"
#include "components/vertex_blocks.hpp"
#include "engine/range_pool.hpp"
#include "engine/scratch.hpp"
#include "engine/system.hpp"

namespace cullet {

/// How many rows a world has room for. A full table refuses the later rows and names the limit; nothing is lost.
struct Limits {
    uint32_t bodies = 4096;
    uint32_t shells = 4096;
    uint32_t vertices = 1u << 20;
    uint32_t elements = 1u << 21;
    uint32_t tasks = 64;
    uint32_t models = 256;
    uint32_t view_vertices = 1u << 23;
    uint32_t debris = 8192;
    uint32_t queued_hits = 256;
};

/// Rows that a shell needs. Packs are one for 8 vertices; blocks and links zero until the stiffness is assembled.
struct ShellRoom {
    uint32_t vertices = 0, elements = 0, hinges = 0, blocks = 0, links = 0, cells = 0, points = 0;
    bool with_springs = false;  // copy_shell: the source's edge springs, too
};

struct State {
    explicit State(const Limits& limits = {});

    Materials materials;
    MaterialTraits material_traits;
    Models models;
    Bodies bodies;
    Debris debris;
    Shells shells;
    Vertices vertices;
    Elements elements;
    TriangleSprings triangle_springs;
    Hinges hinges;
    StiffnessPacks stiffness_packs;
    StiffnessBlocks stiffness_blocks;
    StiffnessLinks stiffness_links;
    Cells cells;
    HullPoints hull_points;
    Tasks tasks;
    TaskContacts task_contacts;
    PatchVertices patch_vertices;
    QueuedHits queued_hits;
    Fragments fragments;
    ViewVertices view_vertices;
    ViewIndices view_indices;
    Blows blows;
    ShellSprings shell_springs;
    Springs springs;
    LayerSprings layer_springs;
    ElementSprings element_springs;
    SpringPacks spring_packs;
    SpringSlots spring_slots;
    LayerSlots layer_slots;
    Twins twins;
    SoftBodies soft_bodies;
    SoftStrikers soft_strikers;
    SoftContacts soft_contacts;

    /// Which rows of the tables above are taken; one pool a table whose rows come in ranges.
    struct Pools {
        explicit Pools(const State& state);
        RangePool bodies, shells, vertices, elements, hinges, packs, blocks, links, cells, points, view_vertices,
            view_indices;
        // Of springs; without a row taken they do not enter the hash.
        RangePool shell_springs, springs, layer_springs, element_springs, spring_packs, spring_slots, layer_slots,
            twins;
        std::array<const RangePool*, 20> all() const { return list<const RangePool*>(*this); }
        std::array<RangePool*, 20> all() { return list<RangePool*>(*this); }
        static constexpr size_t kFirstOptional = 12;  // of all()

     private:
        template <class Pool, class Self>
        static std::array<Pool, 20> list(Self& s) {
            return {&s.bodies,          &s.shells,       &s.vertices,      &s.elements,    &s.hinges,
                    &s.packs,           &s.blocks,       &s.links,         &s.cells,       &s.points,
                    &s.view_vertices,   &s.view_indices, &s.shell_springs, &s.springs,     &s.layer_springs,
                    &s.element_springs, &s.spring_packs, &s.spring_slots,  &s.layer_slots, &s.twins};
        }
    } pools;

    static constexpr auto tables() {
        return std::tuple{&State::materials,
                          &State::models,
                          &State::bodies,
                          &State::debris,
                          &State::shells,
                          &State::vertices,
                          &State::elements,
                          &State::triangle_springs,
                          &State::hinges,
                          &State::stiffness_packs,
                          &State::stiffness_blocks,
                          &State::stiffness_links,
                          &State::cells,
                          &State::hull_points,
                          &State::tasks,
                          &State::task_contacts,
                          &State::patch_vertices,
                          &State::queued_hits,
                          &State::fragments,
                          &State::view_vertices,
                          &State::view_indices,
                          &State::material_traits,
                          &State::blows,
                          &State::shell_springs,
                          &State::springs,
                          &State::layer_springs,
                          &State::element_springs,
                          &State::spring_packs,
                          &State::spring_slots,
                          &State::layer_slots,
                          &State::twins,
                          &State::quick_bodies,
                          &State::quick_runs,
                          &State::awake_packs,
                          &State::region_rests,
                          &State::soft_bodies,
                          &State::soft_strikers,
                          &State::soft_contacts,
                          &State::fragment_ages,
                          &State::debris_ages,
                          &State::pin_boxes};
    }
    const Limits& limits() const { return limits_; }
    /// The table of type T.
    template <class T>
    T& table() {
        constexpr T State::*member = std::get<T State::*>(tables());
        return this->*member;
    }

    /// Pages behind the rows in use: room for hits on shells of these rows and for the pieces, of at most `bytes`.
    /// Touches no value.
    void commit_ahead(const ShellRoom& shell, uint64_t bytes = ~uint64_t{0});

    uint64_t hash() const;
    std::string validate() const;
    std::string first_difference(const State& other) const;

    /// 32 bits of each State column's hash, in the order of tables() and their columns; and then of the pools.
    void digest_columns(std::vector<uint32_t>& out) const;
    /// "vertices.velocity" of the place in that list.
    std::string digested_column(size_t place) const;

 private:
    uint64_t hash_pools(uint64_t seed) const;
    Limits limits_;

 public:
    QuickBodies quick_bodies;
    QuickRuns quick_runs;
    AwakePacks awake_packs;
    RegionRests region_rests;
    FragmentAges fragment_ages;
    DebrisAges debris_ages;
    PinBoxes pin_boxes;
    VertexBlocks vertex_blocks;     // none of the tables: neither saved nor hashed
    mutable ScratchMemory scratch;  // of functions that need more than a stack holds
};

/// What a shell uses now: room for a copy of it.
ShellRoom room_of(const State& state, Row<Shells> shell);

/// A shell with empty ranges of these capacities and one user, or kNone when some table is full (`full` then names its
/// limit). Vertex rows start all dead (element kNone, inverse mass 0).
Row<Shells> make_shell(State& state, const ShellRoom& room, const char** full = nullptr);
/// The same with rows that hold whatever they held; who fills them calls clear_pack_ends when the counts are set.
Row<Shells> make_shell_unclear(State& state, const ShellRoom& room, const char** full = nullptr);
/// Clears what kernels read behind the counts, because they take whole packs: all vertices to spare, which cracks take
/// one by one, and the last pack of elements. Other elements to spare are cleared with their pack when its first is
/// taken, hinges when they are.
void clear_pack_ends(State& state, Row<Shells> shell);
/// Gives the assembled stiffness back: the next task assembles it anew.
void drop_stiffness(State& state, Row<Shells> shell);
/// A range of HullPoints; false: no room.
bool take_points(State& state, uint32_t count, Range& range);
/// One user less; the rows go back when there are none.
void release_shell(State& state, Row<Shells> shell);
/// Rows that the springs of a shell need. No layers: one layer.
struct SpringRoom {
    uint32_t springs = 0, elements = 0, vertices = 0, slots = 0;
    bool has_layers = false;
    bool clears_lists = true;  // springs, slots and both of the layers; false: each row is written before it is read
};
/// A row with empty ranges of these capacities, all zero but for lists that are not to be cleared, for a shell that has
/// none; kNone when some table is full.
Row<ShellSprings> make_springs(State& state, Row<Shells> shell, const SpringRoom& room, const char** full = nullptr);
/// Of the shell; kNone when it has none.
Row<ShellSprings> find_springs(const State& state, Row<Shells> shell);
/// The shell's springs, if any, go back; release_shell does it, too.
void release_springs(State& state, Row<Shells> shell);
/// Springs of `copy` as `source` has them, in motion as they are; what there are too few rows for is refused. A shell
/// without springs gives none. `copy` has at least the vertices and elements of `source`.
bool copy_springs(State& state, Row<Shells> source, Row<Shells> copy, const char** full = nullptr);

/// A copy of `source` with `room` (at least what is in use), one user. Stiffness is copied when `room.blocks` > 0,
/// springs when `room.with_springs`.
Row<Shells> copy_shell(State& state, Row<Shells> source, const ShellRoom& room, const char** full = nullptr);

/// The second half of copy_shell, into a shell that make_shell made: serial systems reserve, parallel ones copy.
void copy_shell_rows(State& to, const State& from, Row<Shells> source, Row<Shells> copy, bool with_stiffness);

/// All tables that hold the rows of shells and of the runs of their springs, as one parameter of a system that edits
/// whole shells.
struct ShellTables {
    State& state;
};

/// The tables of one shell, with its ranges looked up: what the functions that edit a shell pass around. Indices are
/// relative to the shell, as in the columns.
struct ShellView {
    State& state;
    Row<Shells> row;

    ShellView(State& s, Row<Shells> r) : state(s), row(r) {}
    Shells& shells() const { return state.shells; }
    Range& vertices() const { return state.shells.vertices[row]; }
    Range& elements() const { return state.shells.elements[row]; }
    Range& hinges() const { return state.shells.hinges[row]; }
    /// Table rows of relative indices.
    uint32_t vertex(uint32_t v) const { return vertices().first + v; }
    uint32_t element(uint32_t e) const { return elements().first + e; }
    uint32_t hinge(uint32_t h) const { return hinges().first + h; }
    uint32_t vertex_count() const { return vertices().count; }
    uint32_t element_count() const { return elements().count; }
    uint32_t hinge_count() const { return hinges().count; }
};

template <>
struct Parameter<ShellTables> {
    static void describe(std::vector<Access>& list) {
        for (const char* table :
             {Shells::kName,       Vertices::kName,       Elements::kName,        TriangleSprings::kName,
              Hinges::kName,       StiffnessPacks::kName, StiffnessBlocks::kName, StiffnessLinks::kName,
              Cells::kName,        HullPoints::kName,     ShellSprings::kName,    Springs::kName,
              LayerSprings::kName, ElementSprings::kName, SpringPacks::kName,     SpringSlots::kName,
              LayerSlots::kName,   Twins::kName,          QuickBodies::kName,     QuickRuns::kName,
              AwakePacks::kName,   RegionRests::kName,    SoftBodies::kName,      SoftStrikers::kName,
              SoftContacts::kName})
            list.push_back({table, true, true, false, Access::Kind::Table});
        for (const char* table : {Materials::kName, MaterialTraits::kName})
            list.push_back({table, true, false, false, Access::Kind::Table});
    }
    template <class W>
    static ShellTables bind(Call<W>& call) {
        return {call.world.state};
    }
};

template <>
inline constexpr uint32_t kRowsPerChunk<StiffnessPacks> = 32;  // 256 vertices

}  // namespace cullet
