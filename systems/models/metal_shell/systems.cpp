#include "systems/models/metal_shell/systems.hpp"

#include <algorithm>
#include <cmath>

#include "systems/bodies/blows.hpp"
#include "systems/models/metal_shell/dent/along_dent.hpp"
#include "systems/models/metal_shell/dent/dent.hpp"
#include "systems/models/metal_shell/dent/feel.hpp"
#include "systems/models/metal_shell/published/penalty.hpp"
#include "systems/models/metal_shell/strike/lay_front.hpp"
#include "systems/models/metal_shell/tear/part_torn.hpp"
#include "systems/models/metal_shell/tear/tear.hpp"
#include "systems/structures/shell/explosion.hpp"
#include "systems/structures/shell/group_fragments.hpp"

namespace cullet::metal_shell {
namespace {

constexpr double kLeastSpeed = 0.5;        // m/s
constexpr double kLeastFromOneSide = 0.3;  // of an explosion's impulses, that their sum is
constexpr float kLeastFront = 0.1f;        // radius of its front, of its reach
constexpr double kLeastOverlap = 1e-3;     // m, that published springs are pressed by

double closing_speed(Read<MetalRows> rows, Row<Tasks> task, uint32_t c) {
    const Vec3d point(rows.task_contacts.point[c]), normal(rows.task_contacts.normal[c]);
    const Vec3d arm = point - rows.bodies.centre[rows.tasks.body[task]];
    const Vec3d moving = Vec3d(rows.tasks.start_velocity[task]) + cross(Vec3d(rows.tasks.start_spin[task]), arm);
    return double{rows.task_contacts.start_speed[c]} - dot(moving, normal);
}

// N s. As published it is that of springs which push harder on the way in: the same but for what their steps lose.
float impulse_of(Read<MetalRows> rows, Row<MetalShells> metal, Row<Tasks> task, double speed, double mass) {
    const Row<Materials> material = rows.structures.material[rows.tasks.working[task]];
    const double e = double{rows.shell_rows.materials.restitution[material]};
    if (!(rows.metal_shells.published[metal] & kPublishedContact)) return static_cast<float>((1 + e) * mass * speed);
    const Row<Shells> shell = rows.shell_rows.shell_of(rows.tasks.working[task]);
    PenaltyContact contact;
    contact.mass = mass, contact.speed = speed, contact.recede = e * e;
    contact.depth = std::max(0.5 * double{rows.shell_rows.shells.thickness[shell]}, kLeastOverlap);
    return static_cast<float>(press(contact).impulse);
}

/// Of a contact, how fast it closes and what it brings.
struct Contact {
    uint32_t row = kNone;
    double speed = 0, inverse_mass = 0, energy = 0;  // m/s, 1/kg of both, J
};

double own_inverse_mass(Read<MetalRows> rows, Row<Tasks> task, Vec3d point, Vec3d push) {
    return inverse_mass_at(rows.bodies, rows.tasks.body[task], point, push);
}

// The one that brings most says who strikes.
Contact strongest_contact(Read<MetalRows> rows, Row<Tasks> task) {
    const TaskContacts& contacts = rows.task_contacts;
    const uint32_t first = rows.tasks.first_contact[task], end = first + rows.tasks.contact_count[task];
    Contact strongest;
    for (uint32_t c = first; c < end; ++c) {
        const double speed = closing_speed(rows, task, c);
        const double inverse_mass = own_inverse_mass(rows, task, Vec3d(contacts.point[c]), Vec3d(contacts.normal[c])) +
                                    double{contacts.striker_inverse_mass[c]};
        if (!(speed > kLeastSpeed) || !(inverse_mass > 0)) continue;  // both stand fast: the game moves one of them
        const double energy = 0.5 * speed * speed / inverse_mass;
        if (energy > strongest.energy) strongest = {c, speed, inverse_mass, energy};
    }
    return strongest;
}

// Of two that are both of metal each takes what its softness is of both: the force is the same.
double share_of(Read<MetalRows> rows, Row<Tasks> task, Row<Bodies> striker) {
    if (!striker.exists() || !rows.bodies.is_breakable[striker]) return 1;
    const Row<Structures> other = rows.bodies.structure[striker];
    if (!other.exists() || !metal_of(rows, other).exists()) return 1;
    const double own = double{rows.metal_shells.crush_pressure[metal_of(rows, rows.tasks.source[task])]},
                 his = double{rows.metal_shells.crush_pressure[metal_of(rows, other)]};
    return own > 0 && his > 0 ? his / (own + his) : 0.5;
}

/// What fronts of strikers are laid by.
struct Strikers {
    Step step;
    const QueryIndex& index;
    const Events<ForeseenHit>& foreseen;

    StrikerShape lay(MetalRows rows, Row<Tasks> task, Row<Bodies> striker, Vec3d point, Vec3d push) const {
        const TouchPoses poses = poses_at_touch(rows.tasks, rows.bodies, foreseen, step.frame, task, striker);
        return lay_front(rows, index, task, striker, poses, point, push);
    }
};

// What the rigid world finds touching comes along the surface's normal; a push of the game's comes as the game likes,
// and a sheet that were shifted along itself would tear up. A flat one that crushes a body keeps its way.
Vec3d way_of_push(MetalRows rows, Row<Tasks> task, Vec3d point, Vec3d normal, bool is_round) {
    const MetalView metal(rows, rows.tasks.working[task]);
    return is_round || !(metal.shells().crush_pressure[metal.row] > 0) ? into_sheet(metal, point, normal) : normal;
}

void gather_contacts(MetalRows rows, Row<Tasks> task, const Contact& strongest, const Strikers& strikers) {
    MetalRuns& runs = rows.metal_runs;
    const TaskContacts& contacts = rows.task_contacts;
    const uint32_t first = rows.tasks.first_contact[task], end = first + rows.tasks.contact_count[task];
    const Row<Bodies> striker = contacts.striker[strongest.row];
    const Vec3d normal(contacts.normal[strongest.row]);
    const bool is_round = contacts.striker_radius[strongest.row] > 0;
    Vec3d middle;
    uint32_t count = 0;
    for (uint32_t c = first; c < end && !is_round; ++c) {
        if (contacts.striker[c] != striker || !(dot(Vec3d(contacts.normal[c]), normal) > 0.7)) continue;
        middle += Vec3d(contacts.point[c]), ++count;
    }
    middle = is_round ? Vec3d(contacts.point[strongest.row]) : (1.0 / count) * middle;
    const Vec3d push = striker.exists() ? normal : way_of_push(rows, task, middle, normal, is_round);
    const double speed = striker.exists() ? strongest.speed : strongest.speed * dot(normal, push);
    const double inverse_mass =
        own_inverse_mass(rows, task, middle, push) + double{contacts.striker_inverse_mass[strongest.row]};
    const StrikerShape shape = is_round ? StrikerShape::Sphere : strikers.lay(rows, task, striker, middle, push);
    runs.shape[task] = static_cast<uint8_t>(shape);
    runs.point.set(task, middle.to_float());
    runs.push.set(task, push.to_float());
    runs.radius[task] = contacts.striker_radius[strongest.row];
    runs.striker[task] = striker;
    runs.speed[task] = static_cast<float>(speed);
    runs.energy[task] = share_of(rows, task, striker) * 0.5 * speed * speed / inverse_mass;
    const Row<MetalShells> metal = metal_of(rows, rows.tasks.working[task]);
    runs.impulse[task] = impulse_of(rows, metal, task, speed, 1 / inverse_mass);
}

// The front of the wave is a ball round the centre when it meets the body. What the wall's pieces would have of it by
// themselves, less what the body has as a whole, is what bends it.
void gather_explosion(MetalRows rows, Row<Tasks> task, const Blows& blows, uint32_t blow) {
    const Row<Bodies> body = rows.tasks.body[task];
    const ShellView shell(rows, rows.tasks.working[task]);
    const Explosion explosion = explosion_of(blows, blow);
    const Vec3d centre = rows.bodies.centre[body], from(explosion.centre);
    const ExplosionSums sums = measure_explosion(shell, explosion, centre);
    const double size = length(sums.impulse);
    if (!(size > kLeastFromOneSide * sums.size)) return;  // from within it pushes all ways
    const bool is_free = static_cast<BodyKind>(rows.bodies.kind[body]) == BodyKind::Dynamic;
    const double whole = is_free ? 0.5 * size * size / rows.bodies.mass[body] +
                                       0.5 * dot(sums.turning, inverse(rows.bodies.inertia[body]) * sums.turning)
                                 : 0;
    double least = 1e30;
    Vec3d nearest;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const Vec3d place(rows.shell_rows.vertices.rest[shell.vertex(v)]);
        if (const double away = length(place - from); away < least) least = away, nearest = place;
    }
    MetalRuns& runs = rows.metal_runs;
    runs.shape[task] = static_cast<uint8_t>(StrikerShape::Sphere);
    runs.point.set(task, nearest.to_float());
    runs.push.set(task, ((1 / size) * sums.impulse).to_float());
    runs.radius[task] = std::max(static_cast<float>(least), kLeastFront * explosion.radius);
    runs.striker[task] = {};
    runs.speed[task] = sums.speed;
    runs.energy[task] = std::max(0.0, sums.energy - whole);
}

// What comes again at the same place belongs to what came before: the dent hangs on the sum.
void join_earlier(MetalRows rows, Row<Tasks> task, const Strikers& strikers) {
    MetalRuns& runs = rows.metal_runs;
    const Row<Bodies> body = rows.tasks.body[task];
    Knock knock;
    knock.body = body, knock.striker = runs.striker[task];
    knock.point = Vec3d(runs.point[task]), knock.push = Vec3d(runs.push[task]);
    knock.radius = double{runs.radius[task]};
    knock.frame = rows.tasks.opened_frame[task], knock.step_seconds = strikers.step.dt;
    const Earlier earlier = earlier_of(rows.metal_impacts, knock);
    if (!earlier.goes_on) return;
    const MetalImpacts& impacts = rows.metal_impacts;
    runs.impulse[task] *= static_cast<float>(std::sqrt(1 + earlier.energy / runs.energy[task]));
    runs.energy[task] += earlier.energy;
    if (!earlier.has_shape) return;
    runs.goes_on[task] = 1;
    // It has gone on since; its front is as far as it is now, and counts from where it touched first.
    const Vec3d first(impacts.point[body]), push(impacts.push[body]);
    const Vec3d now = first + dot(knock.point - first, push) * push;
    const StrikerShape shape = impacts.radius[body] > 0 ? static_cast<StrikerShape>(impacts.shape[body])
                                                        : strikers.lay(rows, task, runs.striker[task], now, push);
    runs.shape[task] = static_cast<uint8_t>(shape);
    runs.point.set(task, impacts.point[body]), runs.push.set(task, impacts.push[body]);
    runs.radius[task] = impacts.radius[body];
}

// By a load that stands in the queue, and not by a blow.
bool is_press(Read<MetalRows> rows, Row<Tasks> task) {
    const Row<Bodies> body = rows.tasks.body[task];
    return rows.tasks.load[task] > 0 && rows.tasks.contact_count[task] == 1 && body < rows.metal_presses.size() &&
           rows.metal_presses.is_on[body];
}

// The dent begins where the sheet would be without who presses: that far behind his front.
void gather_press(MetalRows rows, Row<Tasks> task, const Strikers& strikers) {
    MetalRuns& runs = rows.metal_runs;
    const TaskContacts& contacts = rows.task_contacts;
    const uint32_t c = rows.tasks.first_contact[task];
    const Row<Bodies> striker = contacts.striker[c];
    const Vec3d push(contacts.normal[c]);
    const double depth = double{rows.metal_presses.depth[rows.tasks.body[task]]};
    const Vec3d front = Vec3d(contacts.point[c]) + 0.5 * depth * push;
    const bool is_round = contacts.striker_radius[c] > 0;
    const StrikerShape shape = is_round ? StrikerShape::Sphere : strikers.lay(rows, task, striker, front, push);
    runs.shape[task] = static_cast<uint8_t>(shape);
    runs.point.set(task, (front - depth * push).to_float());
    runs.push.set(task, push.to_float());
    runs.radius[task] = contacts.striker_radius[c];
    runs.striker[task] = striker;
}

void gather(MetalRows rows, Row<Tasks> task, const Blows& blows, const Strikers& strikers) {
    if (is_press(rows, task)) return gather_press(rows, task, strikers);
    MetalRuns& runs = rows.metal_runs;
    if (const Contact strongest = strongest_contact(rows, task); strongest.row != kNone)
        gather_contacts(rows, task, strongest, strikers);
    for (uint32_t b = 0; b < blows.size() && !(runs.energy[task] > 0); ++b)
        if (blows.task[b] == task.index && is_kind(blows, b, BlowKind::Explosion))
            gather_explosion(rows, task, blows, b);
    if (runs.energy[task] > 0) join_earlier(rows, task, strikers);
}

}  // namespace

namespace {

// What it took is not in the striker's motion any more; it goes on through the hole, and what was punched out with it.
// Else the touch is solved as any other, between the bodies as they are now.
void let_through(MetalRows rows, Row<Tasks> task, const Contact& strongest, const Dent& dent, double work) {
    const MetalRuns& runs = rows.metal_runs;
    const double own_share = share_of(rows, task, runs.striker[task]);
    const double now = own_share * strongest.energy, left = std::min(now, std::max(0.0, dent.tearing - work));
    const double slower = strongest.speed * (1 - std::sqrt(left / now));
    TaskContacts& contacts = rows.task_contacts;
    contacts.impulse[strongest.row] = slower / strongest.inverse_mass;
    contacts.striker_speed[strongest.row] =
        double{contacts.start_speed[strongest.row]} -
        contacts.impulse[strongest.row] * double{contacts.striker_inverse_mass[strongest.row]};
    Punch punch;
    punch.point = Vec3d(contacts.point[strongest.row]), punch.push = Vec3d(contacts.normal[strongest.row]);
    punch.impulse = contacts.impulse[strongest.row], punch.striker_speed = contacts.striker_speed[strongest.row];
    move_torn(rows, task, dent.vertex, punch);
    rows.tasks.state[task] = static_cast<uint8_t>(TaskState::Broke);
}

// The wave goes through; what it punched out has the speed that a bare wall would have of it.
void blow_through(MetalRows rows, Row<Tasks> task, const Blows& blows, uint32_t blow, uint32_t vertex) {
    const Vec3d impulse = blows.impulse[blow];
    Punch punch;
    punch.impulse = length(impulse);
    punch.point = Vec3d(rows.metal_runs.point[task]);
    punch.push = punch.impulse > 0 ? (1 / punch.impulse) * impulse : Vec3d(rows.metal_runs.push[task]);
    punch.striker_speed = double{rows.metal_runs.speed[task]};
    move_torn(rows, task, vertex, punch);
    rows.tasks.state[task] = static_cast<uint8_t>(TaskState::Broke);
}

/// What goes through a sheet that it tears: a contact's striker, or an explosion. A push of the game's is given whole,
/// by the rigid world, and leaves a dent with cracks.
struct Piercing {
    Contact contact;
    uint32_t blow = kNone;
    bool exists() const { return contact.row != kNone || blow != kNone; }
};
Piercing piercing_of(Read<MetalRows> rows, Row<Tasks> task, const Blows& blows) {
    Piercing piercing;
    piercing.contact = strongest_contact(rows, task);
    if (piercing.contact.row != kNone && !rows.task_contacts.striker[piercing.contact.row].exists())
        piercing.contact.row = kNone;
    for (uint32_t b = 0; b < blows.size() && rows.tasks.contact_count[task] == 0; ++b)
        if (piercing.blow == kNone && blows.task[b] == task.index && is_kind(blows, b, BlowKind::Explosion))
            piercing.blow = b;
    return piercing;
}

void tear(MetalRows rows, Row<Tasks> task, const Blows& blows, const Dent& dent) {
    const MetalView metal(rows, rows.tasks.working[task]);
    const Piercing piercing = piercing_of(rows, task, blows);
    number_parts(metal.shell, rows.shell_rows.shell_parts.of_task(task));
    const Tear torn = tear_sheet(metal, dent, rows.pin_boxes, piercing.exists());
    rows.tasks.crack_count[task] += torn.cut_edges;
    rows.tasks.lacks_room[task] = torn.is_full;
    if (torn.cut_edges > 0) rows.metal_runs.restitution[task] = 0;
    // A star beside an older hole may cut something off, too.
    const bool parts = torn.is_through || find_torn(metal.shell, rows.shell_rows.shell_parts.of_task(task)) > 1;
    if (!parts || !piercing.exists()) return;
    if (piercing.contact.row != kNone)
        let_through(rows, task, piercing.contact, dent, torn.work);
    else
        blow_through(rows, task, blows, piercing.blow, dent.vertex);
}

}  // namespace

void gather_impulses(EachOwn<TaskOpened> opened, Step step, const Blows& blows, const Events<ForeseenHit>& foreseen,
                     MetalRows rows, const QueryIndex& index) {
    const Row<Tasks> task = opened->task;
    const Row<Structures> source = rows.tasks.source[task], working = rows.tasks.working[task];
    copy_shell_rows(rows, rows, source, working, false);
    clear_pack_ends(rows, working);
    copy_metal_rows(rows, rows, source, working);
    gather(rows, task, blows, {step, index, foreseen});
}

void work_impact(Of<Tasks> task, MetalRows rows, const Blows& blows) {
    const Row<Tasks> t = task.row;
    Tasks& tasks = rows.tasks;
    tasks.steps_granted[t] -= tasks.steps_granted[t] > 0;
    ++tasks.steps_done[t];
    tasks.state[t] = static_cast<uint8_t>(TaskState::Whole);
    MetalRuns& runs = rows.metal_runs;
    const MetalView metal(rows, tasks.working[t]);
    if (is_press(rows, t)) {
        const MetalPresses& presses = rows.metal_presses;
        const Row<Bodies> body = tasks.body[t];
        const double depth = double{presses.depth[body]} + double{presses.ahead[body]};
        const Dent dent = press_dent(metal, striker_of(rows, t), depth, double{presses.force[body]});
        runs.depth[t] = static_cast<float>(dent.depth);
        if (dent.kind != DentKind::None && bake_dent(metal)) tasks.state[t] = static_cast<uint8_t>(TaskState::Reshaped);
        return;
    }
    if (!(runs.energy[t] > 0)) return;
    const Dent dent = work_dent(metal, striker_of(rows, t), runs.energy[t], runs.goes_on[t]);
    runs.depth[t] = static_cast<float>(dent.depth);
    runs.contact[t] = static_cast<float>(dent.contact);
    runs.restitution[t] = static_cast<float>(dent.restitution);
    if (dent.kind == DentKind::None || !bake_dent(metal)) return;
    tasks.state[t] = static_cast<uint8_t>(TaskState::Reshaped);
    if (dent.tearing > 0) tear(rows, t, blows, dent);
}

void end_impacts(Serial, Step step, const Events<TaskEnded>& ended, MetalRows rows, RigidWorld& rigid) {
    MetalImpacts& impacts = rows.metal_impacts;
    const MetalRuns& runs = rows.metal_runs;
    for (const TaskEnded& e : ended) {
        const Row<Tasks> task = e.task;
        if (is_press(rows, task)) {  // the shape that was before a blow is not to come back
            const Row<Bodies> body = rows.tasks.body[task];
            rows.metal_presses.clear_rows(body, 1);
            if (body < impacts.size()) impacts.clear_rows(body, 1);
            continue;
        }
        if (!metal_of(rows, rows.tasks.source[task]).exists() || !(runs.energy[task] > 0)) continue;
        const Row<Bodies> body = rows.tasks.body[task], striker = runs.striker[task];
        if (rows.tasks.crack_count[task] > 0) {  // no shape before it that more of it could go on from
            if (body < impacts.size()) impacts.clear_rows(body, 1);
            continue;
        }
        const bool is_dented = static_cast<TaskState>(rows.tasks.state[task]) == TaskState::Reshaped;
        impacts.reach(body + 1);
        impacts.frame[body] = step.frame;
        impacts.seconds[body] =
            std::max(kLeastSeconds, runs.speed[task] > 0 ? 2 * runs.depth[task] / runs.speed[task] : 0.0f);
        impacts.has_shape[body] = is_dented || runs.goes_on[task];
        impacts.striker[body] = striker;
        impacts.shape[body] = runs.shape[task];
        impacts.point.set(body, runs.point[task]);
        impacts.push.set(body, runs.push[task]);
        impacts.radius[body] = runs.radius[task];
        impacts.contact[body] =
            std::max(runs.contact[task], least_contact(rows, rows.tasks.source[task], runs.radius[task] > 0));
        impacts.energy[body] = runs.energy[task];
        if (striker.exists() && !rows.tasks.is_late[task] && runs.restitution[task] > 0)
            rigid.set_bounce(body, striker, runs.restitution[task]);
    }
}

void group_dented(EachOwn<TaskEnded> ended, MetalRows rows) {
    const Row<Tasks> task = ended->task;
    Tasks& tasks = rows.tasks;
    tasks.part_count[task] = 1;
    const auto state = static_cast<TaskState>(tasks.state[task]);
    if (state != TaskState::Reshaped && state != TaskState::Broke) return;
    const ShellView shell(rows, tasks.working[task]);
    const std::span<FragmentPart> parts = rows.shell_rows.shell_parts.of_task(task);
    if (state == TaskState::Reshaped) parts[0] = whole_part(shell);
    if (state == TaskState::Broke) tasks.part_count[task] = find_torn(shell, parts);
}

}  // namespace cullet::metal_shell
