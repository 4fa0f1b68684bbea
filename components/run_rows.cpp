#include "components/run_rows.hpp"

namespace cullet {

RunRows::RunRows(const Limits& l, const MaterialRows& of_what)
    : ShellRows(l, of_what),
      tasks(l.tasks),
      task_contacts(l.tasks * kMostContacts),
      patch_vertices(l.tasks * kMostPatchVertices),
      quick_runs(l.tasks),
      awake_packs(l.tasks * kMostAwakePacks),
      region_rests(l.tasks) {
    tasks.append(l.tasks);
    task_contacts.append(l.tasks * kMostContacts);
    patch_vertices.append(l.tasks * kMostPatchVertices);
}

}  // namespace cullet
