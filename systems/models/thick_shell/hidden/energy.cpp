#include "systems/models/thick_shell/hidden/energy.hpp"

#include <algorithm>

#include "systems/bodies/coupling.hpp"
#include "systems/models/thick_shell/hidden/contact.hpp"
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/stiffness/element_bending.hpp"
#include "systems/models/thick_shell/stiffness/element_stress.hpp"

namespace cullet {
namespace {

constexpr uint32_t kEnergyChunk = 1024;  // rows

template <class Part>
double sum_chunks(uint32_t count, Part part) {
    double sum = 0;
    for (uint32_t first = 0; first < count; first += kEnergyChunk)
        sum += part(first, std::min(kEnergyChunk, count - first));
    return sum;
}

void add_contacts(const RunRows& state, Row<Tasks> task, const ShellView& shell, TaskEnergy& energy) {
    const TaskContacts& contacts = state.task_contacts;
    const PatchVertices& patches = state.patch_vertices;
    const uint32_t first = state.tasks.first_contact[task];
    for (uint32_t c = first; c < first + state.tasks.contact_count[task]; ++c) {
        const double inverse_mass = contacts.striker_inverse_mass[c], speed = contacts.striker_speed[c];
        bool is_shared = false;
        for (uint32_t other = first; other < first + state.tasks.contact_count[task]; ++other)
            is_shared = is_shared || share_a_striker(contacts, c, other);
        const double start = contacts.start_speed[c];
        if (is_shared)  // what pushes did to it: each the impulse times the mean of the speeds at its contact
            energy.strikers += 0.5 * start * start / inverse_mass - 0.5 * contacts.impulse[c] * (start + speed);
        else if (inverse_mass > 0)
            energy.strikers += 0.5 * speed * speed / inverse_mass;
        else
            energy.work += contacts.impulse[c] * speed;
        const Vec3d n(contacts.normal[c]);
        const uint32_t begin = contacts.first_patch[c];
        for (uint32_t p = begin; p < begin + contacts.patch_count[c]; ++p) {
            if (!(patches.stiffness[p] > 0)) continue;
            const uint32_t row = shell.vertex(patches.vertex[p]);
            const Vec3d u(state.vertices.displacement[row]);
            const auto depth = static_cast<float>(contacts.striker_travel[c] - dot(n, u));
            energy.contact += patch_spring(patches, p).energy(depth, state.vertices.crush[row]);
        }
    }
}

double grained_bending_energy(const ShellView& shell, const PlaneStress& stress, uint32_t first, uint32_t count) {
    const Elements& elements = shell.state.elements;
    const float* slope = elements.slope[shell.element(0)].data();
    double sum = 0;
    for (uint32_t e = first; e < first + count; ++e) {
        const uint32_t row = shell.element(e);
        if (elements.flags[row] & kDead) continue;
        const BendingTerms terms(shell, stress, e);
        double angle[3];
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t own = 3 * e + k, other = elements.other_slope[row][k];
            angle[k] = other == own ? 0 : double{slope[own]} + slope[other];
        }
        for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l) sum += terms.h[k][l] * (angle[k] * angle[l]);
    }
    return 0.5 * sum;
}

}  // namespace

double kinetic_energy(ShellView shell, uint32_t side, uint32_t first, uint32_t count) {
    Vertices& vertices = shell.state.vertices;
    Float4* w = vertices.probe.data(static_cast<int>(side & 1));
    double sum = 0;
    for (uint32_t row = shell.vertex(first); row < shell.vertex(first) + count; ++row) {
        const Vec3 u = vertices.displacement[row];
        w[row] = {u.x, u.y, u.z, 0};
        const Vec3d v(vertices.velocity[row]);
        sum += vertices.mass[row] * dot(v, v);  // pinned ones have v = 0
    }
    return 0.5 * sum;
}

double bending_energy(ShellView shell, uint32_t first, uint32_t count) {
    const Hinges& hinges = shell.state.hinges;
    const Elements& elements = shell.state.elements;
    const float* slope = elements.slope[shell.element(0)].data();
    const PlaneStress stress = plane_stress(shell.state, shell.structure);
    if (stress.has_grain) return grained_bending_energy(shell, stress, first, count);
    // Half of each hinge from either side: asking which side is the lower one guesses wrong every other time.
    double sum[3] = {};
    for (uint32_t e = first; e < first + count; ++e) {
        const uint32_t row = shell.element(e);
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t own = 3 * e + k, other = elements.other_slope[row][k];
            if (other == own) continue;
            const uint32_t h = shell.hinge(elements.hinge[row][k]);
            const double angle = slope[own] + slope[other];
            sum[k] += double{hinges.stiffness[h]} * hinges.scale[h] * (angle * angle);
        }
    }
    return 0.25 * (sum[0] + sum[1] + sum[2]);
}

TaskEnergy task_energy(RunRows& state, Row<Tasks> task) {
    const ShellView shell(state, state.tasks.working[task]);
    const uint32_t scratch = ~state.tasks.steps_done[task] & 1;
    TaskEnergy energy;
    energy.kinetic = sum_chunks(shell.vertex_count(), [&](uint32_t first, uint32_t count) {
        return kinetic_energy(shell, scratch, first, count);
    });
    if (is_hidden_region(state, task)) energy.kinetic += rest_energy(state, task);
    energy.membrane = sum_chunks(shell.element_count(), [&](uint32_t first, uint32_t count) {
        return membrane_energy(shell, scratch, first, count);
    });
    energy.bending = sum_chunks(shell.element_count(),
                                [&](uint32_t first, uint32_t count) { return bending_energy(shell, first, count); });
    add_contacts(state, task, shell, energy);
    return energy;
}

bool is_blown_up(const TaskEnergy& energy, double start_energy) {
    const double wanted = start_energy + energy.work;
    return !(energy.total() <= wanted + 0.05 * std::max(start_energy, wanted));
}

}  // namespace cullet
