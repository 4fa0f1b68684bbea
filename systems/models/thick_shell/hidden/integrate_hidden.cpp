#include "systems/models/thick_shell/hidden/integrate_packs.hpp"
#include "systems/models/thick_shell/hidden/systems.hpp"
#include "systems/models/thick_shell/stiffness/pair_cells.hpp"

namespace cullet {

void integrate_hidden(Rows<StiffnessPacks> packs, Of<Tasks> task, RunStiffness of,
                      In<&Vertices::inverse_mass> inverse_mass, In<&Vertices::probe> probe,
                      InOut<&Vertices::velocity> velocity, InOut<&Vertices::displacement> displacement,
                      Out<&Vertices::probe> next_probe) {
    const Shells& shells = of.shells;
    const Row<Structures> structure = of.tasks.working[task.row];
    const Row<Shells> shell = shell_of(of.structures, structure);
    const uint32_t first_pack = shells.packs[shell].first, first = shells.vertices[shell].first;
    HiddenStep step;
    step.dt = of.runs.time_step[task.row];
    step.beta = of.runs.damping_time[task.row];
    step.first_block = of.packs.first_block.data() + first_pack;
    step.block_count = of.packs.block_count.data() + first_pack;
    step.first_link = of.packs.first_link.data() + first_pack;
    step.link_count = of.packs.link_count.data() + first_pack;
    step.blocks = of.blocks.block.data() + shells.blocks[shell].first;
    step.links = of.links.link.data() + shells.links[shell].first;
    step.inverse_mass = inverse_mass.data() + first;
    for (int k = 0; k < 3; ++k) {
        step.u[k] = displacement.lane(k) + first;
        step.v[k] = velocity.lane(k) + first;
    }
    step.probe = probe.data() + first;
    step.next_probe = next_probe.data() + first;
    step.pack_count = shells.packs[shell].count;
    step.has_pair_cells = stores_pairs_once(of.structures, structure);
    integrate_packs(step, packs.first - first_pack, packs.count);
}

}  // namespace cullet
