#include "systems/models/lattice/break_rooms.hpp"

#include <algorithm>

#include "systems/bodies/pin_boxes.hpp"
#include "systems/models/lattice/crack/part_body.hpp"
#include "systems/models/lattice/gather_blow.hpp"
#include "systems/models/lattice/loop.hpp"
#include "systems/models/lattice/shared/brittle.hpp"
#include "systems/structures/tetrahedra/solid_rows.hpp"

namespace cullet::lattice {
namespace {

constexpr uint64_t kWorkAStep = 1 << 18;      // multiplications: a tenth of a millisecond
constexpr uint64_t kUnitsFaces = 400;         // of a cell: 0.8 us
constexpr uint64_t kUnitsHullTriangle = 300;  // of a part that is halved: 0.6 us
constexpr double kNsAUnit = 2;
constexpr uint32_t kHullDepth = 4;
constexpr double kHullExcess = 1.3;  // of a piece's hulls: closer ones take as long again
constexpr size_t kFewestCorners = 4;
// What presses on pieces goes on for as long as any is too large, and to part one takes as long whatever comes of it.
constexpr uint32_t kPartsOfPiece = 8;
// Lists of a cut: three times what a brick, a bowl and a statue of 6,000 triangles took.
constexpr uint64_t kListBytes = 16 << 20, kListBytesARow = 2048;

const KnownSolid& known_of(Read<LatticeRows> rows, Row<Structures> structure) {
    const KnownSolid* const known = known_solid(rows, structure);
    CULLET_ASSERT(known, "nobody made ready for a break of structure %u", structure.index);
    return *known;
}
const Breakable& breakable_of(const KnownSolid& known) {
    return *static_cast<const Breakable*>(known.of_model.get());
}
BreakingRoom& breaking(Read<LatticeRows> rows, Row<Tasks> task) {
    BreakingRoom* const room = room_of_task(rows, task);
    CULLET_ASSERT(room, "task %u has no room for its run", task.index);
    return *room;
}
RoomOfRun& room_of(const BreakingRoom& room) {
    return *static_cast<RoomOfRun*>(room.of_model.get());
}

uint64_t units_of(double nanoseconds) {
    return static_cast<uint64_t>(nanoseconds / kNsAUnit);
}

/// Of the rooms of a run.
struct RoomBytes {
    uint64_t run, lists;
};
RoomBytes bytes_for(const KnownSolid& known) {
    const BreakableSolid& body = breakable_of(known).body;
    const size_t rows = body.solid.lattice.fine.size() + known.cooked.mesh.triangles.size();
    return {break_bytes(body) + faces_bytes(body), kListBytes + kListBytesARow * rows};
}
bool is_enough(const RoomOfRun& room, const RoomBytes& bytes) {
    return room.run_bytes >= bytes.run && room.list_bytes >= bytes.lists;
}

const KnownSolid& know(Read<SolidRows> rows, SolidRooms& all, Row<CookedSolids> row) {
    const uint64_t content = rows.cooked_solids.content[row];
    if (const KnownSolid* const found = all.find(content)) return *found;
    auto made = std::make_unique<KnownSolid>();
    made->content = content;
    made->cooked = read_solid(rows, row);
    auto breakable = std::make_shared<Breakable>();
    breakable->body = make_breakable(made->cooked.solid);
    if (rows.cooked_solids.strength_modulus[row] > 0)
        scatter_strength(breakable->body, double{rows.cooked_solids.strength_modulus[row]},
                         rows.cooked_solids.strength_seed[row]);
    give_normals(breakable->body, made->cooked.mesh);
    breakable->points = find_lattice_points(made->cooked.solid.lattice);
    made->of_model = std::move(breakable);
    all.known.push_back(std::move(made));
    return *all.known.back();
}

/// Cells of the body before this break; none listed: it has all.
void list_own(Read<SolidRows> rows, Row<Structures> structure, std::vector<uint8_t>& own) {
    const Row<Solids> solid = solid_of(rows.structures, structure);
    own.clear();
    if (rows.solids.is_whole[solid]) return;
    own.assign(rows.cooked_solids.cells[rows.solids.cooked[solid]].count, 0);
    const Range members = rows.solids.members[solid];
    for (uint32_t r = members.first; r < members.first + members.count; ++r) own[rows.solid_members.cell[r]] = 1;
}

/// Patches that the body's pins hold; none listed: it has none.
void list_held(Read<LatticeRows> rows, Row<Bodies> body, const KnownSolid& known, std::vector<uint8_t>& held) {
    held.clear();
    if (!rows.bodies.has_pins[body]) return;
    for (const SurfacePatch& patch : known.cooked.solid.patches)
        held.push_back(is_held(rows.pin_boxes, rows.bodies.pins[body], patch.centroid.to_float()));
}

/// What pins hold of the pieces, and what an explosion gives them: all of what it gives the body.
void tell_pieces(Read<LatticeRows> rows, Row<Tasks> task, const KnownSolid& known, const RoomOfRun& room,
                 BrokenSolid& broken) {
    const auto& patches = known.cooked.solid.patches;
    const auto& normals = breakable_of(known).body.patch_normals;
    const SolidBlow blow = blow_of(rows.lattice_runs, task);
    Vec3d missing = rows.lattice_runs.blast_impulse[task];
    double volume = 0;
    for (uint32_t i = 0; i < patches.size(); ++i) {
        const uint32_t number = broken.piece_of[patches[i].cell];
        if (number == kNone) continue;
        BrokenPiece& piece = broken.pieces[number];
        piece.has_pins = piece.has_pins || (!room.held.empty() && room.held[i]);
        if (!(blow.blast.radius > 0)) continue;
        const Vec3d impulse = blow.blast.impulse(patches[i].centroid, normals[i], patches[i].area);
        piece.impulse += impulse;
        piece.turning += cross(patches[i].centroid - piece.centre, impulse);
        missing = missing - impulse;
    }
    if (!(blow.blast.radius > 0)) return;
    // Faces of earlier breaks have no patches.
    for (const BrokenPiece& piece : broken.pieces) volume += piece.volume;
    for (BrokenPiece& piece : broken.pieces) piece.impulse += (piece.volume / volume) * missing;
}

/// Pieces that cracks made: teeth go, islands go, faces become smooth. Points that earlier breaks moved stay there.
void shape_faces(Read<LatticeRows> rows, Row<Tasks> task, const KnownSolid& known, BreakingRoom& breaking) {
    const Breakable& breakable = breakable_of(known);
    RoomOfRun& room = room_of(breaking);
    const uint32_t foreign = room.own.empty() ? kNone : breakable.body.part_count;
    if (!is_load_that_parts(rows.lattice_runs, task)) {  // which has no teeth, and may leave a cell alone
        filter_by_majority(breakable.body, {}, room.run.piece, room.run.volume, foreign);
        join_islands(breakable.body, room.run.piece, room.run.volume, room.faces, foreign);
    }
    const Row<Solids> solid = solid_of(rows.structures, rows.tasks.source[task]);
    const Range moved = rows.solids.moved[solid];
    for (uint32_t r = moved.first; r < moved.first + moved.count; ++r)
        room.faces.places[rows.moved_nodes.node[r]] = rows.moved_nodes.place[r];
    fit_planes(breakable.body, breakable.points, {}, room.run.piece, room.faces, foreign);
    for (uint32_t i = 0; i < room.faces.moved_count; ++i) {
        breaking.broken.moved.push_back(room.faces.moved[i]);
        breaking.broken.moved_to.push_back(room.faces.places[room.faces.moved[i]]);
    }
}

/// Numbers in the order of first cells; what others have gets none.
uint32_t number_pieces(const Breakable& breakable, RoomOfRun& room) {
    const uint32_t foreign = room.own.empty() ? kNone : breakable.body.part_count;
    std::vector<uint32_t>& labels = room.labels;
    labels.assign(room.run.piece.size(), kNone);
    uint32_t count = 0;
    std::fill(room.run.part_piece.begin(), room.run.part_piece.end(), kNone);
    for (uint32_t c = 0; c < labels.size(); ++c) {
        const uint32_t piece = room.run.piece[c];
        if (piece == foreign) continue;
        uint32_t& number = room.run.part_piece[piece];
        if (number == kNone) number = count++;
        labels[c] = number;
    }
    return count;
}

RunStage begin_cut(const KnownSolid& known, RoomOfRun& room) {
    room.piece_count = number_pieces(breakable_of(known), room);
    room.piece = 0;
    if (room.piece_count < 2) return RunStage::Done;
    const RoomScope scope(room.lists);
    room.cut.emplace(known.cooked, room.faces.places, room.labels, room.piece_count);
    return RunStage::Cut;
}

RunStage cut_some(RoomOfRun& room, uint64_t& units) {
    const RoomScope scope(room.lists, RoomScope::GoesOn());
    const bool is_done = room.cut->advance();
    units = units_of(room.cut->nanoseconds());
    if (!is_done) return RunStage::Cut;
    if (room.cut->error().empty()) return RunStage::Skins;
    room.cut.reset();
    return RunStage::Done;  // it stays whole: a point lay in a plane forty times over
}

RunStage lay_skin(Read<LatticeRows> rows, Row<Tasks> task, const KnownSolid& known, RoomOfRun& room,
                  BrokenSolid& broken, uint64_t& units) {
    const RoomScope scope(room.lists, RoomScope::GoesOn());
    const uint32_t label = room.piece++;
    const Row<CookedSolids> row = rows.solids.cooked[solid_of(rows.structures, rows.tasks.source[task])];
    lay_piece(rows, row, known.cooked, room.cut->skin_of(label), room.labels, label, broken);
    units = 2 * units_of(room.cut->nanoseconds());
    if (room.piece < room.piece_count) return RunStage::Skins;
    room.cut.reset();
    lay_touches(known.cooked.solid, broken);
    tell_pieces(rows, task, known, room, broken);
    room.piece = 0;
    return broken.pieces.size() > 1 ? RunStage::Hulls : RunStage::Done;
}

SolidHull box_of(std::span<const Vec3d> points) {
    Vec3d low = points[0], high = points[0];
    for (const Vec3d& p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    SolidHull box;
    for (int k = 0; k < 8; ++k)
        box.points.push_back(Vec3d(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z).to_float());
    return box;
}

void begin_halving(RoomOfRun& room, const BrokenSolid& broken) {
    const RoomScope scope(room.lists);
    const BrokenPiece& piece = broken.pieces[room.piece];
    List<Triangle> triangles;
    triangles.reserve(piece.triangles.count);
    for (const BrokenTriangle& t : piece.triangles.of(broken.triangles))
        triangles.push_back({t.corners[0], t.corners[1], t.corners[2]});
    HalvingSettings settings;
    settings.most_excess = kHullExcess, settings.depth = kHullDepth;
    room.halving.emplace(piece.points.of(broken.points), triangles, settings);
}

RunStage choose_hulls(Read<LatticeRows> rows, RoomOfRun& room, BrokenSolid& broken, uint64_t& units) {
    if (!room.halving) begin_halving(room, broken);
    const RoomScope scope(room.lists, RoomScope::GoesOn());
    units = kUnitsHullTriangle * room.halving->next_rows();
    if (!room.halving->advance(rows.scratch)) return RunStage::Hulls;
    {
        List<SolidHull> hulls = room.halving->take();
        std::erase_if(hulls, [](const SolidHull& hull) { return hull.points.size() < kFewestCorners; });
        if (hulls.empty()) hulls.push_back(box_of(broken.pieces[room.piece].points.of(broken.points)));
        lay_hulls(hulls, room.piece, broken);
    }
    room.halving.reset();
    return ++room.piece < broken.pieces.size() ? RunStage::Hulls : RunStage::Done;
}

/// Some of the stage at work. Returns what it cost.
uint64_t work_stage(Read<LatticeRows> rows, Row<Tasks> task, const KnownSolid& known, BreakingRoom& breaking) {
    RoomOfRun& room = room_of(breaking);
    uint64_t units = 0;
    switch (room.stage) {
        case RunStage::Solve:
            units = kUnitsAStep;
            if (!advance_break(breakable_of(known).body, room.run, kWorkAStep)) break;
            room.stage = room.run.crack_count > 0 ? RunStage::Faces : RunStage::Done;
            break;
        case RunStage::Faces:
            shape_faces(rows, task, known, breaking);
            units = kUnitsFaces * known.cooked.solid.cells.size();
            room.stage = begin_cut(known, room);
            break;
        case RunStage::Cut:
            room.stage = cut_some(room, units);
            break;
        case RunStage::Skins:
            room.stage = lay_skin(rows, task, known, room, breaking.broken, units);
            break;
        case RunStage::Hulls:
            room.stage = choose_hulls(rows, room, breaking.broken, units);
            break;
        case RunStage::Done:
            break;
    }
    return units;
}

}  // namespace

void prepare_rooms(Read<LatticeRows> rows, Row<Structures> structure) {
    if (!rows.solid_work.rooms) rows.solid_work.rooms = std::make_shared<SolidRooms>();
    SolidRooms& all = *rows.solid_work.rooms;
    const KnownSolid& known = know(rows, all, rows.solids.cooked[solid_of(rows.structures, structure)]);
    const RoomBytes bytes = bytes_for(known);
    all.rooms.resize(kSolidRooms);
    for (BreakingRoom& room : all.rooms) {
        const size_t cells = known.cooked.solid.cells.size();
        if (!room.of_model || !is_enough(room_of(room), bytes)) {
            // A run at work goes on in the room that it has: it is large enough for it.
            if (room.of_model && room_of_task(rows, room.task) == &room) continue;
            room.of_model = std::make_shared<RoomOfRun>(bytes.run, bytes.lists);
        }
        room.broken.reserve(known.cooked);
        room_of(room).own.reserve(cells), room_of(room).labels.reserve(cells);
        room_of(room).held.reserve(known.cooked.solid.patches.size());
    }
}

bool is_pinned_anywhere(Read<LatticeRows> rows, Row<Bodies> body) {
    const KnownSolid& known = known_of(rows, rows.bodies.structure[body]);
    return std::any_of(
        known.cooked.solid.patches.begin(), known.cooked.solid.patches.end(),
        [&](const SurfacePatch& p) { return is_held(rows.pin_boxes, rows.bodies.pins[body], p.centroid.to_float()); });
}

void begin_run(Read<LatticeRows> rows, Row<Tasks> task) {
    const Row<Structures> source = rows.tasks.source[task];
    BreakingRoom& own = breaking(rows, task);
    const KnownSolid& known = known_of(rows, source);
    const Breakable& breakable = breakable_of(known);
    const RoomBytes bytes = bytes_for(known);
    if (!is_enough(room_of(own), bytes)) own.of_model = std::make_shared<RoomOfRun>(bytes.run, bytes.lists);
    RoomOfRun& room = room_of(own);
    room.forget_lists();
    room.arena.reset();
    room.run = take_break(room.arena, breakable.body);
    room.faces = take_faces(room.arena, breakable.body);
    room.piece = 0;
    room.stage = RunStage::Done;
    const bool is_parted = is_load_that_parts(rows.lattice_runs, task);
    if (!(rows.lattice_runs.speed[task] > 0) && !is_parted) return;
    list_own(rows, source, room.own);
    list_held(rows, rows.tasks.body[task], known, room.held);
    if (is_parted) {
        const bool is_piece = rows.structures.generation[source] > 0;
        part_body(breakable.body,
                  {rows.lattice_runs.point[task], rows.lattice_runs.push[task], is_piece ? kPartsOfPiece : 2}, room.own,
                  room.run);
        if (room.run.crack_count > 0) room.stage = RunStage::Faces;
        return;
    }
    BrittleSolid brittle = brittle_of(rows.materials, rows.structures.material[source]);
    brittle.tensile_strength *= double{rows.tasks.strength_scale[task]};
    CrackRules rules;
    rules.must_break = rows.tasks.load[task] > 0;
    begin_break(breakable.body, brittle, blow_of(rows.lattice_runs, task), rules, room.held, room.run, room.own);
    room.stage = RunStage::Solve;
}

bool advance_run(Read<LatticeRows> rows, Row<Tasks> task, uint64_t& units) {
    BreakingRoom& room = breaking(rows, task);
    const KnownSolid& known = known_of(rows, rows.tasks.source[task]);
    uint64_t sum = 0;
    while (room_of(room).stage != RunStage::Done && sum < kUnitsAStep) sum += work_stage(rows, task, known, room);
    units = sum > kUnitsAStep ? sum - kUnitsAStep : 0;
    return room_of(room).stage == RunStage::Done;
}

const RoomOfRun& run_of(Read<LatticeRows> rows, Row<Tasks> task) {
    return room_of(breaking(rows, task));
}

}  // namespace cullet::lattice
