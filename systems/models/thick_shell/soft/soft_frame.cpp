// What an awake soft body needs before and after its substeps of a frame.
#include "systems/models/thick_shell/soft/find_strikers.hpp"
#include "systems/models/thick_shell/soft/soft_shape.hpp"
#include "systems/models/thick_shell/soft/systems.hpp"

namespace cullet {
namespace {

bool is_awake(const SoftBodies& soft, uint32_t s) {
    return soft.is_used[s] && soft.is_awake[s];
}

}  // namespace

void find_soft_strikers(Rows<SoftBodies> soft, Step step, InChunks<SoftRows> rows, const RigidWorld& rigid) {
    for (const Row<SoftBodies> s : soft)
        if (is_awake(rows->soft_bodies, s)) find_strikers(rows.set, rigid, s, step);
}

void share_soft_strikers(Serial, Tables<const Bodies, const SoftBodies, SoftStrikers> rows) {
    share_strikers(rows);
}

void shape_soft(Rows<SoftBodies> soft, Step step, InChunks<SoftRows> rows) {
    for (const Row<SoftBodies> s : soft)
        if (is_awake(rows->soft_bodies, s)) end_soft_frame(rows.set, s, step);
}

}  // namespace cullet
