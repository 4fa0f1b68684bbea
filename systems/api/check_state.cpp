// What a snapshot's rows must be before a system may follow them. First every finite number, then ranges and users,
// then each table by the rules below, then the structures by the rules of cooked ones.
#include <algorithm>
#include <deque>

#include "systems/api/snapshot.hpp"
#include "systems/cook/materials.hpp"
#include "systems/models.hpp"
#include "systems/tasks/step_limits.hpp"

namespace cullet {
namespace {

constexpr uint64_t kMostUnits = 1'000'000'000'000'000;  // as Settings::units_a_frame
constexpr const char* kAdvice = "The snapshot is damaged or of another build; take it again.";

struct Checker {
    const State& state;
    const DamageModels& models;
    const std::string& name;
    std::string trouble;

    bool is_sound() const { return trouble.empty(); }
    bool expect(bool fits, const std::string& what) {
        if (!fits && is_sound()) trouble = name + ": " + what + ". " + kAdvice;
        return is_sound();
    }
    // There are millions of these two in a large world: the sentence is made only where it is needed.
    /// `table.column[row] is value`, which must be below `limit`, or none where it may be.
    void expect_row(const AnyTable& table, const char* column, uint32_t row, uint32_t value, uint32_t limit,
                    bool may_be_none) {
        if (value < limit || (may_be_none && value == kNone)) return;
        expect(false, place(table, column, row) + " is " + std::to_string(value) + ", of " + std::to_string(limit));
    }
    void expect_flag(const AnyTable& table, const Column<uint8_t>& column, const char* column_name, uint32_t row) {
        if (column[row] <= 1) return;
        expect(false, place(table, column_name, row) + " is " + std::to_string(column[row]) + ", not 0 or 1");
    }
    static std::string place(const AnyTable& table, const char* column, uint32_t row) {
        return std::string(table.name()) + "." + column + "[" + std::to_string(row) + "]";
    }
};

bool is_body(const State& s, uint32_t b) {
    return b < s.bodies.size() && static_cast<BodyKind>(s.bodies.kind[b]) != BodyKind::Free;
}
// Of a merged fragment, which is its drawn mesh alone.
bool is_of_scenery(const State& s, uint32_t structure) {
    for (uint32_t b = 0; b < s.bodies.size(); ++b)
        if (s.bodies.kind[b] == static_cast<uint8_t>(BodyKind::Scenery) && s.bodies.structure[b].index == structure)
            return true;
    return false;
}
bool is_structure(const State& s, uint32_t structure) {
    return structure < s.structures.size() && s.structures.users[structure] > 0;
}
bool is_task(const State& s, uint32_t t) {
    return t < s.tasks.size() && static_cast<TaskState>(s.tasks.state[t]) != TaskState::Free;
}

/// Each has as many users as it is named by, and a body that shows one shows all of it.
void check_model_meshes(Checker& check) {
    const State& s = check.state;
    const ModelMeshes& meshes = s.model_meshes;
    std::vector<uint32_t> users(meshes.size());
    const auto name = [&](const AnyTable& table, const char* column, uint32_t row, Row<ModelMeshes> mesh) {
        if (!mesh.exists()) return false;
        check.expect(mesh.index < meshes.size() && meshes.users[mesh] > 0,
                     Checker::place(table, column, row) + " is " + std::to_string(mesh.index) + ", no mesh of a model");
        if (check.is_sound()) ++users[mesh];
        return check.is_sound();
    };
    for (uint32_t m = 0; m < s.models.size(); ++m)
        if (s.models.is_used[m]) name(s.models, "mesh", m, s.models.mesh[m]);
    const auto is_same = [](const Range& shown, const Range& all) {
        return shown.first == all.first && shown.count == all.count && shown.capacity == 0;
    };
    for (uint32_t b = 0; b < s.bodies.size() && check.is_sound(); ++b) {
        const Row<ModelMeshes> mesh = s.bodies.model_mesh[b];
        if (!is_body(s, b) || !name(s.bodies, "model_mesh", b, mesh)) continue;
        check.expect(is_same(s.bodies.view_vertices[b], meshes.vertices[mesh]) &&
                         is_same(s.bodies.view_indices[b], meshes.indices[mesh]),
                     Checker::place(s.bodies, "view_vertices", b) + " are not those of its model's mesh");
    }
    for (uint32_t m = 0; m < meshes.size() && check.is_sound(); ++m)
        check.expect(meshes.users[m] == users[m] && meshes.pool.is_taken(m, 1) == (users[m] > 0),
                     Checker::place(meshes, "users", m) + " is " + std::to_string(meshes.users[m]) + "; it has " +
                         std::to_string(users[m]));
}

/// Ranges of one table: each inside of it, taken from its pool, and no two on the same rows.
class RangeCheck {
 public:
    RangeCheck(Checker& check, const AnyTable& table, const RangePool& pool)
        : check_(check), table_(table), pool_(pool) {}
    void add(const char* owner, uint32_t row, const Range& r) {
        check_.expect(r.count <= r.capacity &&
                          (r.capacity == 0 || (r.first <= table_.size() && r.capacity <= table_.size() - r.first)) &&
                          pool_.is_taken(r.first, r.capacity) &&
                          (r.capacity == 0 || pool_.rounded(r.first) == r.first),  // packs are read as a whole
                      std::string("the range of ") + table_.name() + " of " + owner + " " + std::to_string(row) +
                          " is " + std::to_string(r.first) + " + " + std::to_string(r.count) + " of " +
                          std::to_string(r.capacity) + "; the table has " + std::to_string(table_.size()) + " rows");
        if (r.capacity > 0) taken_.push_back({r.first, r.first + pool_.rounded(r.capacity)});
    }
    void finish() {
        std::sort(taken_.begin(), taken_.end());
        for (size_t k = 1; k < taken_.size(); ++k)
            check_.expect(taken_[k - 1].second <= taken_[k].first,
                          std::string(table_.name()) + ": two ranges have row " + std::to_string(taken_[k].first));
    }

 private:
    Checker& check_;
    const AnyTable& table_;
    const RangePool& pool_;
    std::vector<std::pair<uint32_t, uint32_t>> taken_;
};

/// A solid has a row of its own, which names a cooked one.
void check_solid(Checker& check, uint32_t row, std::vector<uint8_t>& is_named) {
    const State& s = check.state;
    const uint32_t solid = s.structures.rows[row];
    check.expect(solid < s.solids.size() && s.solids.pool.is_taken(solid, 1) && !is_named[solid]++,
                 Checker::place(s.structures, "rows", row) + " is " + std::to_string(solid) +
                     ", no solid, or that of another structure");
    if (!check.is_sound()) return;
    const Row<CookedSolids> cooked = s.solids.cooked[solid];
    check.expect(
        cooked < s.cooked_solids.size() && s.cooked_solids.pool.is_taken(cooked, 1),
        Checker::place(s.solids, "cooked", solid) + " is " + std::to_string(cooked.index) + ", which is not cooked");
}

/// Each has a row of its own in the table of its kind, and a shell that has springs is the one that they name.
void check_structures(Checker& check) {
    const State& s = check.state;
    const Structures& structures = s.structures;
    std::vector<uint8_t> is_named(s.shells.size(), 0), is_solid_named(s.solids.size(), 0);
    for (uint32_t row = 0; row < structures.size() && check.is_sound(); ++row) {
        if (!is_structure(s, row)) continue;
        check.expect(structures.pool.is_taken(row, 1),
                     Checker::place(structures, "users", row) + " names users of a free row");
        check.expect(structures.kind[row] <= static_cast<uint8_t>(StructureKind::Tetrahedra),
                     Checker::place(structures, "kind", row) + " is " + std::to_string(structures.kind[row]));
        if (!check.is_sound()) return;
        if (!is_shell(structures, Row<Structures>(row))) {
            check_solid(check, row, is_solid_named);
            continue;
        }
        const uint32_t shell = structures.rows[row];
        check.expect(shell < s.shells.size() && s.shells.pool.is_taken(shell, 1) && !is_named[shell]++,
                     Checker::place(structures, "rows", row) + " is " + std::to_string(shell) +
                         ", no shell, or that of another structure");
        if (!check.is_sound()) return;
        const Row<ShellSprings> springs = s.shells.springs[shell];
        const bool fits = !springs.exists() || (springs < s.shell_springs.size() && s.shell_springs.is_used[springs] &&
                                                s.shell_springs.structure[springs] == row);
        check.expect(fits, Checker::place(s.shells, "springs", shell) + " is " + std::to_string(springs.index) +
                               ", not the springs of structure " + std::to_string(row));
    }
    const ShellSprings& springs = s.shell_springs;
    for (uint32_t row = 0; row < springs.size() && check.is_sound(); ++row)
        check.expect(!springs.is_used[row] ||
                         (is_structure(s, springs.structure[row]) && is_shell(s.structures, springs.structure[row]) &&
                          s.shells.springs[s.shell_of(springs.structure[row])] == row),
                     Checker::place(springs, "structure", row) + " is " + std::to_string(springs.structure[row].index) +
                         ", which does not have these springs");
}

/// Those of what was cooked, and of what has it: some tables have ranges of both.
void check_solid_ranges(Checker& check) {
    const State& s = check.state;
    std::deque<std::pair<const AnyTable*, RangeCheck>> all;
    const auto add = [&](const char* owner, uint32_t row) {
        return [&, owner, row](const Range& range, const auto& table, uint32_t, const char*) {
            auto at = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == &table; });
            RangeCheck& of =
                at != all.end() ? at->second : all.emplace_back(&table, RangeCheck(check, table, table.pool)).second;
            of.add(owner, row, range);
        };
    };
    for (uint32_t row = 0; row < s.cooked_solids.size(); ++row)
        if (s.cooked_solids.pool.is_taken(row, 1))
            for_each_cooked_range(s, Row<CookedSolids>(row), {}, add("cooked solid", row));
    for (uint32_t row = 0; row < s.structures.size(); ++row)
        if (is_structure(s, row) && !is_shell(s.structures, Row<Structures>(row)))
            for_each_solid_range(s, Row<Structures>(row), {},
                                 [&](const Range& range, const auto& table, uint32_t wanted, const char* limit) {
                                     // Those of cells and hulls have been looked at with all structures'.
                                     const AnyTable* const any = &table;
                                     if (any != &s.cells && any != &s.hull_points)
                                         add("solid", row)(range, table, wanted, limit);
                                 });
    for (auto& [table, ranges] : all) ranges.finish();
}

void check_ranges(Checker& check) {
    const State& s = check.state;
    const auto of_structures = [&](const AnyTable& table, const RangePool& pool, auto&& range_of) {
        RangeCheck ranges(check, table, pool);
        for (uint32_t row = 0; row < s.structures.size(); ++row)
            if (is_structure(s, row)) ranges.add("structure", row, range_of(Row<Structures>(row)));
        ranges.finish();
    };
    const auto of_shells = [&](const AnyTable& table, const RangePool& pool, const auto& column) {
        of_structures(table, pool, [&](Row<Structures> row) {
            return is_shell(s.structures, row) ? column[s.shell_of(row)] : Range{};
        });
    };
    of_shells(s.vertices, s.vertices.pool, s.shells.vertices);
    of_shells(s.elements, s.elements.pool, s.shells.elements);
    of_shells(s.hinges, s.hinges.pool, s.shells.hinges);
    of_shells(s.stiffness_packs, s.stiffness_packs.pool, s.shells.packs);
    of_shells(s.stiffness_blocks, s.stiffness_blocks.pool, s.shells.blocks);
    of_shells(s.stiffness_links, s.stiffness_links.pool, s.shells.links);
    of_structures(s.cells, s.cells.pool, [&](Row<Structures> row) { return s.structures.cells[row]; });
    of_structures(s.hull_points, s.hull_points.pool, [&](Row<Structures> row) { return s.structures.points[row]; });
    const ShellSprings& springs = s.shell_springs;
    const auto of_springs = [&](const AnyTable& table, const RangePool& pool, const Column<Range>& column) {
        RangeCheck ranges(check, table, pool);
        for (uint32_t row = 0; row < springs.size(); ++row)
            if (springs.is_used[row]) ranges.add("springs", row, column[row]);
        ranges.finish();
    };
    of_springs(s.springs, s.springs.pool, springs.springs);
    of_springs(s.layer_springs, s.layer_springs.pool, springs.layers);
    of_springs(s.element_springs, s.element_springs.pool, springs.edges);
    of_springs(s.spring_packs, s.spring_packs.pool, springs.packs);
    of_springs(s.spring_slots, s.spring_slots.pool, springs.slots);
    of_springs(s.layer_slots, s.layer_slots.pool, springs.layer_slots);
    of_springs(s.twins, s.twins.pool, springs.twins);
    const auto of_metal = [&](const AnyTable& table, const RangePool& pool, const Column<Range>& column) {
        RangeCheck ranges(check, table, pool);
        for (uint32_t row = 0; row < s.metal_shells.size(); ++row)
            if (s.metal_shells.pool.is_taken(row, 1)) ranges.add("metal shell", row, column[row]);
        ranges.finish();
    };
    of_metal(s.metal_vertices, s.metal_vertices.pool, s.metal_shells.vertices);
    of_metal(s.metal_elements, s.metal_elements.pool, s.metal_shells.elements);
    of_metal(s.metal_springs, s.metal_springs.pool, s.metal_shells.springs);
    of_metal(s.sub_shells, s.sub_shells.pool, s.metal_shells.cells);
    of_metal(s.sub_shell_borders, s.sub_shell_borders.pool, s.metal_shells.borders);
    check_solid_ranges(check);
    const auto of_drawn = [&](const AnyTable& table, const RangePool& pool, const Column<Range>& of_bodies,
                              const Column<Range>& of_meshes) {
        RangeCheck ranges(check, table, pool);
        for (uint32_t b = 0; b < s.bodies.size(); ++b)
            if (is_body(s, b) && !s.bodies.model_mesh[b].exists()) ranges.add("body", b, of_bodies[b]);
        for (uint32_t m = 0; m < s.model_meshes.size(); ++m)
            if (s.model_meshes.users[m] > 0) ranges.add("model mesh", m, of_meshes[m]);
        ranges.finish();
    };
    of_drawn(s.view_vertices, s.view_vertices.pool, s.bodies.view_vertices, s.model_meshes.vertices);
    of_drawn(s.view_indices, s.view_indices.pool, s.bodies.view_indices, s.model_meshes.indices);
    check_model_meshes(check);
    check.expect(s.triangle_springs.size() == s.elements.size(), "triangle_springs and elements differ in rows");
    for (uint32_t b = 0; b < s.bodies.size(); ++b)
        check.expect(!is_body(s, b) || s.bodies.pool.is_taken(b, 1),
                     Checker::place(s.bodies, "kind", b) + " names a body in a free row");
}

/// Each shell is of a model that the world has. Whoever asks models believes it.
void check_damage_models(Checker& check) {
    const State& s = check.state;
    for (uint32_t row = 0; row < s.structures.size() && check.is_sound(); ++row) {
        if (!is_structure(s, row)) continue;
        check.expect_row(s.structures, "damage_model", row, s.structures.damage_model[row], check.models.size(), false);
        if (!check.is_sound()) return;
        // Who breaks shells looks at shells from files.
        const bool breaks_shells = check.models[s.structures.damage_model[row]].calls().check_shell != nullptr;
        check.expect(breaks_shells == is_shell(s.structures, Row<Structures>(row)),
                     Checker::place(s.structures, "kind", row) + " is not what its damage model breaks");
    }
}

/// Indices of a body's drawn mesh name vertices of it, and come from parts that its structure has.
void check_drawn(Checker& check, Row<Bodies> b) {
    const State& s = check.state;
    const Row<Structures> structure = s.bodies.structure[b];
    const bool is_scenery = s.bodies.kind[b] == static_cast<uint8_t>(BodyKind::Scenery);
    const uint32_t parts = structure.exists() ? calls_of(s.structures, structure).drawn_parts(s, structure) : 0;
    const Range vertices = s.bodies.view_vertices[b], indices = s.bodies.view_indices[b];
    for (uint32_t i = indices.first; i < indices.first + indices.count && check.is_sound(); ++i) {
        check.expect_row(s.view_indices, "index", i, s.view_indices.index[i], vertices.count, false);
        if (!is_scenery)
            check.expect_row(s.view_indices, "source", i, s.view_indices.source[i] / kMostDrawnTriangles, parts, false);
    }
}

/// A model's mesh that a thousand bodies show is looked at once, with the structure that they share.
class CheckedMeshes {
 public:
    explicit CheckedMeshes(size_t meshes) : structure_(meshes, kNone) {}
    /// False: this mesh was asked about with this structure just before. What is no model's mesh is always true.
    bool once(Row<ModelMeshes> mesh, Row<Structures> structure) {
        if (!mesh.exists()) return true;
        if (structure.exists() && structure_[mesh] == structure.index) return false;
        structure_[mesh] = structure.index;
        return true;
    }

 private:
    std::vector<uint32_t> structure_;
};

void check_bodies(Checker& check) {
    const State& s = check.state;
    const Bodies& bodies = s.bodies;
    CheckedMeshes to_check(s.model_meshes.size());
    for (uint32_t b = 0; b < bodies.size() && check.is_sound(); ++b) {
        check.expect(bodies.kind[b] <= static_cast<uint8_t>(BodyKind::Scenery),
                     Checker::place(bodies, "kind", b) + " is " + std::to_string(bodies.kind[b]));
        if (!is_body(s, b)) continue;
        check.expect_row(bodies, "model", b, bodies.model[b], s.models.size(), true);
        check.expect_row(bodies, "parent", b, bodies.parent[b], bodies.size(), true);
        check.expect(!bodies.structure[b].exists() || is_structure(s, bodies.structure[b]),
                     Checker::place(bodies, "structure", b) + " is " + std::to_string(bodies.structure[b].index) +
                         ", which is no structure");
        if (!check.is_sound()) return;  // rows that are not there are not looked into
        const bool is_scenery = bodies.kind[b] == static_cast<uint8_t>(BodyKind::Scenery);
        check.expect(
            !bodies.structure[b].exists() || is_scenery || s.structures.points[bodies.structure[b]].capacity > 0,
            Checker::place(bodies, "structure", b) + " has no hulls");
        const uint32_t task = bodies.task[b];
        check.expect(task == kNone || (is_task(s, task) && s.tasks.body[task] == b),
                     Checker::place(bodies, "task", b) + " is " + std::to_string(task) + ", not an open task of it");
        check.expect_flag(bodies, bodies.is_sphere, "is_sphere", b);
        check.expect_flag(bodies, bodies.is_breakable, "is_breakable", b);
        check.expect_flag(bodies, bodies.is_asleep, "is_asleep", b);
        check.expect_flag(bodies, bodies.has_pins, "has_pins", b);
        const Range pins = bodies.pins[b];
        check.expect(pins.first <= s.pin_boxes.size() && pins.count <= s.pin_boxes.size() - pins.first,
                     Checker::place(bodies, "pins", b) + " are rows " + std::to_string(pins.first) + " + " +
                         std::to_string(pins.count) + " of " + std::to_string(s.pin_boxes.size()));
        const uint8_t owed = bodies.is_owed_births[b];
        check.expect(owed <= kOwedShape && (owed == 0 || bodies.structure[b].exists()),
                     Checker::place(bodies, "is_owed_births", b) + " is " + std::to_string(owed) + ", not 0 to " +
                         std::to_string(kOwedShape) + ", and 0 of what has no structure");
        const Range indices = bodies.view_indices[b];
        uint64_t runs = 0;
        for (const uint32_t count : bodies.run_indices[b]) runs += count;
        check.expect(runs == indices.count, Checker::place(bodies, "run_indices", b) + " add up to " +
                                                std::to_string(runs) + "; the body has " +
                                                std::to_string(indices.count) + " indices");
        if (to_check.once(bodies.model_mesh[b], bodies.structure[b])) check_drawn(check, Row<Bodies>(b));
    }
}

void check_squeezes(Checker& check) {
    const Bodies& bodies = check.state.bodies;
    const Squeezes& squeezes = check.state.squeezes;
    for (uint32_t row = 0; row < squeezes.size() && check.is_sound(); ++row) {
        check.expect_row(squeezes, "body", row, squeezes.body[row], bodies.size(), false);
        check.expect_row(squeezes, "by", row, squeezes.by[row], bodies.size(), false);
        check.expect_row(squeezes, "against", row, squeezes.against[row], bodies.size(), false);
        if (!check.is_sound()) return;
        const bool is_its = bodies.generation[squeezes.body[row]] == squeezes.generation[row];
        check.expect(!is_its || bodies.hold_count[squeezes.body[row]] > 0,
                     Checker::place(squeezes, "body", row) + " is " + std::to_string(squeezes.body[row].index) +
                         ", which nothing holds");
        check.expect(
            std::abs(length(squeezes.push[row]) - 1) < 1e-3f && squeezes.share[row] >= 0 && squeezes.share[row] <= 1,
            Checker::place(squeezes, "push", row) + " or the share beside it is out of range");
    }
}

void check_models(Checker& check) {
    const Models& models = check.state.models;
    for (uint32_t m = 0; m < models.size(); ++m) {
        check.expect_flag(models, models.is_used, "is_used", m);
        check.expect(!models.is_used[m] || is_structure(check.state, models.structure[m]),
                     Checker::place(models, "structure", m) + " is " + std::to_string(models.structure[m].index) +
                         ", which is no structure");
    }
}

/// The patches of a task are its own, and press its own vertices.
void check_contacts(Checker& check, uint32_t t) {
    const State& s = check.state;
    const uint32_t first = s.tasks.first_contact[t], count = s.tasks.contact_count[t];
    const Row<Structures> working = s.tasks.working[t];
    const uint32_t vertices = is_shell(s.structures, working) ? s.shells.vertices[s.shell_of(working)].count : 1;
    check.expect(first == t * kMostContacts && count <= kMostContacts, Checker::place(s.tasks, "first_contact", t) +
                                                                           " is " + std::to_string(first) + " for " +
                                                                           std::to_string(count) + " contacts");
    for (uint32_t c = first; c < first + count && check.is_sound(); ++c) {
        const TaskContacts& contacts = s.task_contacts;
        check.expect_row(contacts, "vertex", c, contacts.vertex[c], vertices, false);
        for (const auto* flag : {&contacts.is_answered, &contacts.is_heir_striker})
            check.expect_flag(contacts, *flag, "is_answered or is_heir_striker", c);
        check.expect(!contacts.striker[c].exists() || is_body(s, contacts.striker[c]),
                     Checker::place(contacts, "striker", c) + " is " + std::to_string(contacts.striker[c].index) +
                         ", which is no body");
        const uint32_t patch = contacts.first_patch[c], patch_count = contacts.patch_count[c];
        const uint32_t own = t * kMostPatchVertices;
        check.expect(patch_count == 0 || (patch >= own && patch - own <= kMostPatchVertices &&
                                          patch_count <= kMostPatchVertices - (patch - own)),
                     Checker::place(contacts, "first_patch", c) + " is " + std::to_string(patch) + " for " +
                         std::to_string(patch_count) + " vertices");
        for (uint32_t p = patch; p < patch + patch_count && check.is_sound(); ++p)
            check.expect_row(s.patch_vertices, "vertex", p, s.patch_vertices.vertex[p], vertices, false);
    }
}

/// Steps and units are counted in whole numbers, which these must not leave. A run that blew up has been begun again
/// with half its step, and once more.
void check_length(Checker& check, uint32_t t) {
    const Tasks& tasks = check.state.tasks;
    const HiddenRuns& runs = check.state.hidden_runs;
    const float step = runs.time_step[t], end = runs.end_time[t];
    check.expect(step >= kShortestStep / 4 && step <= 1,
                 Checker::place(runs, "time_step", t) + " is " + std::to_string(step) + " s, not from 2.5e-13 to 1");
    check.expect(end >= 0 && end <= 4 * kMostSteps * step, Checker::place(runs, "end_time", t) + " is " +
                                                               std::to_string(end) + " s; a step is " +
                                                               std::to_string(step) + " s");
    check.expect(tasks.units_owed[t] <= kMostUnits,
                 Checker::place(tasks, "units_owed", t) + " is " + std::to_string(tasks.units_owed[t]));
}

void check_tasks(Checker& check) {
    const State& s = check.state;
    const Tasks& tasks = s.tasks;
    check.expect(tasks.size() == tasks.limit() && s.hidden_runs.size() == tasks.limit() &&
                     s.task_contacts.size() == s.task_contacts.limit() &&
                     s.patch_vertices.size() == s.patch_vertices.limit() &&
                     s.queued_hits.size() == s.queued_hits.limit() && s.shell_parts.size() == s.shell_parts.limit(),
                 "tables of hits do not have the rows of their limits");
    check.expect(s.fragments.size() == 0 && s.touches.size() == 0, "there are fragments between two steps");
    for (uint32_t t = 0; t < tasks.size() && check.is_sound(); ++t) {
        if (!is_task(s, t)) continue;
        const auto task_state = static_cast<TaskState>(tasks.state[t]);
        const bool waits = is_ahead(tasks, t) && (task_state == TaskState::Whole || task_state == TaskState::Dropped ||
                                                  task_state == TaskState::Reshaped);
        check.expect(task_state == TaskState::Running || waits,
                     Checker::place(tasks, "state", t) + " is " + std::to_string(tasks.state[t]) +
                         "; between steps a task is free or running, or waits for its touch");
        const Row<Bodies> body = tasks.body[t];
        check.expect(
            is_body(s, body) && s.bodies.task[body] == t,
            Checker::place(tasks, "body", t) + " is " + std::to_string(body.index) + ", which has no such task");
        check.expect(is_structure(s, tasks.working[t]) && is_structure(s, tasks.source[t]) &&
                         tasks.working[t] != tasks.source[t],
                     Checker::place(tasks, "working", t) + " is " + std::to_string(tasks.working[t].index) + " of " +
                         std::to_string(tasks.source[t].index) + ", which are not two structures");
        if (!check.is_sound()) return;
        check.expect(s.structures.users[tasks.working[t]] == 1, Checker::place(tasks, "working", t) + " is " +
                                                                    std::to_string(tasks.working[t].index) +
                                                                    ", which is not the hit's alone");
        check.expect(s.bodies.structure[body] == tasks.source[t],
                     Checker::place(tasks, "source", t) + " is " + std::to_string(tasks.source[t].index) +
                         ", not the structure of its body " + std::to_string(body.index));
        const std::string lacking = check.models.trouble_of_task(s, t);
        check.expect(lacking.empty(), Checker::place(tasks, "working", t) + " " + lacking);
        check.expect_flag(tasks, tasks.is_held, "is_held", t);
        check.expect_flag(tasks, tasks.is_late, "is_late", t);
        check.expect_flag(tasks, tasks.lacks_room, "lacks_room", t);
        check_length(check, t);
        check_contacts(check, t);
    }
    const QueuedHits& queued = s.queued_hits;
    for (uint32_t q = 0; q < queued.size() && check.is_sound(); ++q) {
        check.expect_flag(queued, queued.is_used, "is_used", q);
        if (!queued.is_used[q]) continue;
        check.expect(is_body(s, queued.body[q]) && s.bodies.structure[queued.body[q]].exists(),
                     Checker::place(queued, "body", q) + " is no body that has a structure");
        check.expect(!queued.striker[q].exists() || is_body(s, queued.striker[q]),
                     Checker::place(queued, "striker", q) + " is no body");
    }
    for (uint32_t d = 0; d < s.debris.size(); ++d) check.expect_flag(s.debris, s.debris.is_used, "is_used", d);
}

/// Kinds, bodies and tasks that are there; numbers that a call would have refused are not followed.
void check_blows(Checker& check) {
    const State& s = check.state;
    const Blows& blows = s.blows;
    for (uint32_t b = 0; b < blows.size() && check.is_sound(); ++b) {
        const auto kind = static_cast<BlowKind>(blows.kind[b]);
        check.expect(kind == BlowKind::Push || kind == BlowKind::Explosion || kind == BlowKind::Cut,
                     Checker::place(blows, "kind", b) + " is " + std::to_string(blows.kind[b]));
        for (const auto* flag : {&blows.is_taken, &blows.is_paid, &blows.goes_on})
            check.expect_flag(blows, *flag, "is_taken, is_paid or goes_on", b);
        const uint32_t body = blows.body[b];
        const bool is_for_all = body == kNone && kind != BlowKind::Push && !blows.is_taken[b];
        const bool has_structure = is_body(s, body) && s.bodies.structure[body].exists();
        const bool may_lack_structure = is_body(s, body) && kind == BlowKind::Push && !blows.is_taken[b];
        check.expect(is_for_all || has_structure || may_lack_structure,
                     Checker::place(blows, "body", b) + " is " + std::to_string(body) + ", which it cannot hit");
        const uint32_t task = blows.task[b];
        // A shell is cut within a step; a solid is parted over some.
        const bool may_last =
            kind != BlowKind::Cut || (has_structure && !is_shell(s.structures, s.bodies.structure[body]));
        check.expect(
            task == kNone || (is_task(s, task) && s.tasks.body[task] == body && blows.is_taken[b] && may_last),
            Checker::place(blows, "task", b) + " is " + std::to_string(task) + ", not an open task of its body");
        check.expect(blows.point_count[b] <= kMostCutPoints && blows.point_count[b] != 1,
                     Checker::place(blows, "point_count", b) + " is " + std::to_string(blows.point_count[b]));
        const float unit = length(blows.direction[b]);
        const bool is_unit = kind == BlowKind::Explosion || (unit > 0.99f && unit < 1.01f);
        check.expect(is_unit && blows.radius[b] >= 0 && blows.inverse_mass[b] >= 0 && blows.speed[b] >= 0,
                     Checker::place(blows, "direction", b) + " or a number beside it is out of range");
        check.expect(kind != BlowKind::Explosion || blows.radius[b] > 0,
                     Checker::place(blows, "radius", b) + " is " + std::to_string(blows.radius[b]));
    }
}

/// Structures are given back when their last user goes: the count must be true.
void check_users(Checker& check) {
    const State& s = check.state;
    std::vector<uint32_t> users(s.structures.size(), 0);
    const auto use = [&](uint32_t structure) {
        if (structure < users.size()) ++users[structure];
    };
    for (uint32_t m = 0; m < s.models.size(); ++m)
        if (s.models.is_used[m]) use(s.models.structure[m]);
    for (uint32_t b = 0; b < s.bodies.size(); ++b)
        if (is_body(s, b)) use(s.bodies.structure[b]);
    for (uint32_t t = 0; t < s.tasks.size(); ++t)
        if (is_task(s, t)) use(s.tasks.working[t]), use(s.tasks.source[t]);
    for (uint32_t row = 0; row < users.size(); ++row)
        check.expect(s.structures.users[row] == users[row], Checker::place(s.structures, "users", row) + " is " +
                                                                std::to_string(s.structures.users[row]) + ", but " +
                                                                std::to_string(users[row]) + " name the structure");
}

/// Of a merged fragment, which is drawn and no more. No one else may name it.
bool has_no_rows(const State& s, Row<Structures> structure) {
    if (!is_shell(s.structures, structure)) return false;
    bool has_none = true;
    ShellRows::for_each_range(s, structure, [&](const Range& range, const auto&, auto, const char*) {
        has_none = has_none && range.count == 0 && range.capacity == 0;
    });
    return has_none && s.structures.users[structure] == 1 && s.structures.shape_points[structure] == 0 &&
           s.structures.live_elements[structure] == 0 && s.shells.dead_elements[s.shell_of(structure)] == 0;
}

bool is_part_of_body(const DamageModels& models, const State& s, uint32_t structure) {
    for (uint32_t t = 0; t < s.tasks.size(); ++t)
        if (is_task(s, t) && s.tasks.working[t] == structure && models.is_part(s, t)) return true;
    return false;
}

}  // namespace

Result<void> check_state(const DamageModels& models, const State& state, const std::string& name) {
    Checker check{state, models, name, {}};
    const std::string not_finite = state.validate();
    check.expect(not_finite.empty(), not_finite);
    for (auto* look : {check_structures, check_ranges, check_damage_models, check_models, check_tasks, check_bodies,
                       check_squeezes, check_blows, check_users})
        if (check.is_sound()) look(check);
    if (!check.is_sound()) return Error{check.trouble};
    if (const Result<void> valid = check_material_rows(state); !valid)
        return Error{name + ": " + valid.error() + " " + kAdvice};
    auto& rows = const_cast<State&>(state);  // views are of states that may change; nothing is changed
    for (uint32_t row = 0; row < state.structures.size(); ++row) {
        if (!is_structure(state, row)) continue;
        if (state.structures.material[row] >= state.materials.size())
            return Error{name + ": " + Checker::place(state.structures, "material", row) + " is " +
                         std::to_string(state.structures.material[row].index) + ", of " +
                         std::to_string(state.materials.size()) + ". " + kAdvice};
        if (has_no_rows(state, Row<Structures>(row)) && is_of_scenery(state, row)) continue;
        if (!is_shell(state.structures, Row<Structures>(row))) {
            const std::string trouble =
                calls_of(state.structures, Row<Structures>(row)).trouble(state, Row<Structures>(row));
            if (!trouble.empty())
                return Error{name + ": structure " + std::to_string(row) + " " + trouble + ". " + kAdvice};
            continue;
        }
        const Wear wear = is_part_of_body(models, state, row) ? Wear::CutOut : Wear::Worn;
        const Result<void> sound = models.check_shell(rows, Row<Structures>(row), wear, name, kAdvice);
        if (!sound) return sound;
    }
    return models.check_rows(state, name, kAdvice);
}

}  // namespace cullet
