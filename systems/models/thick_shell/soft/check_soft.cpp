#include "systems/models/thick_shell/soft/check_soft.hpp"

#include "systems/models/thick_shell/soft/soft_body.hpp"

namespace cullet {
namespace {

std::string place(const SoftBodies& soft, const char* column, uint32_t row) {
    return std::string(soft.name()) + "." + column + "[" + std::to_string(row) + "]";
}

std::string trouble_of_flags(const SoftBodies& soft, uint32_t row) {
    for (const auto* flag :
         {&soft.is_used, &soft.is_awake, &soft.is_called, &soft.is_elastic, &soft.is_torn, &soft.is_moved})
        if ((*flag)[row] > 1)
            return place(soft, "is_used, is_awake, is_called, is_elastic, is_torn or is_moved", row) + " is " +
                   std::to_string((*flag)[row]) + ", not 0 or 1";
    if (!soft.is_used[row] && (soft.is_awake[row] || soft.is_torn[row]))
        return place(soft, "is_awake", row) + " or is_torn is set in a free row";
    return {};
}

/// Alive, and with springs of its own and this row.
bool is_soft_body(const SoftRows& s, uint32_t row) {
    const uint32_t body = s.soft_bodies.body[row];
    if (body >= s.bodies.size() || static_cast<BodyKind>(s.bodies.kind[body]) == BodyKind::Free) return false;
    const Row<Structures> shell = s.bodies.structure[body];
    return shell.exists() && springs_of(s, shell).exists() && s.bodies.soft[body] == row;
}

std::string trouble_of_body(const SoftRows& s, uint32_t body) {
    const SoftBodies& soft = s.soft_bodies;
    const Row<SoftBodies> row = s.bodies.soft[body];
    if (static_cast<BodyKind>(s.bodies.kind[body]) == BodyKind::Free || !row.exists()) return {};
    if (row < soft.size() && soft.is_used[row] && soft.body[row] == body) return {};
    return "bodies.soft[" + std::to_string(body) + "] is " + std::to_string(row.index) + ", which is not of this body";
}

std::string trouble_of_numbers(const SoftRows& s, uint32_t row) {
    const SoftBodies& soft = s.soft_bodies;
    const Range vertices = s.shells.vertices[s.shell_of(s.bodies.structure[soft.body[row]])];
    if (first_contact_row(vertices.first + vertices.capacity) > s.soft_contacts.size())
        return place(soft, "body", row) + " has no rows for contacts";
    if (soft.substeps[row] < 1 || soft.substeps[row] > kMostSubsteps)
        return place(soft, "substeps", row) + " is " + std::to_string(soft.substeps[row]);
    if (!(soft.drag_time[row] > 0 && soft.break_strain[row] > 0 && soft.yield_strain[row] >= 0))
        return place(soft, "drag_time", row) + ", break_strain or yield_strain is out of range";
    if (soft.partner_count[row] > kMostPartners)
        return place(soft, "partner_count", row) + " is " + std::to_string(soft.partner_count[row]);
    return {};
}

}  // namespace

Result<void> check_soft(const SoftRows& s, const std::string& name, const std::string& advice) {
    const SoftBodies& soft = s.soft_bodies;
    std::string trouble;
    if (s.soft_strikers.size() != kMostStrikers * soft.size())
        trouble = "soft_strikers and soft_bodies do not fit each other in rows";
    for (uint32_t b = 0; b < s.bodies.size() && trouble.empty(); ++b) trouble = trouble_of_body(s, b);
    for (uint32_t row = 0; row < soft.size() && trouble.empty(); ++row) {
        trouble = trouble_of_flags(soft, row);
        if (!soft.is_used[row] || !trouble.empty()) continue;
        trouble = is_soft_body(s, row) ? trouble_of_numbers(s, row)
                                       : place(soft, "body", row) + " is " + std::to_string(soft.body[row].index) +
                                             ", no body with springs of its own";
    }
    if (!trouble.empty()) return Error{name + ": " + trouble + ". " + advice};
    return {};
}

}  // namespace cullet
