#include "components/run_rows.hpp"

namespace cullet {

RunRows::RunRows(const Limits& l, const MaterialRows& of_what)
    : ShellRows(l, of_what),
      tasks(l.tasks),
      task_contacts(l.tasks * kMostContacts),
      patch_vertices(l.tasks * kMostPatchVertices),
      hidden_runs(l.tasks),
      marked_packs(l.tasks * kMostMarkedPacks),
      quick_runs(l.tasks),
      region_rests(l.tasks) {
    tasks.append(l.tasks);
    hidden_runs.append(l.tasks);
    task_contacts.append(l.tasks * kMostContacts);
    patch_vertices.append(l.tasks * kMostPatchVertices);
}

}  // namespace cullet
