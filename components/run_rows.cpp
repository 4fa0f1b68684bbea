#include "components/run_rows.hpp"

namespace cullet {

RunRows::RunRows(const Limits& l, const MaterialRows& of_what) : ShellRows(l, of_what), TablesOfRuns{l} {
    tasks.append(l.tasks);
    hidden_runs.append(l.tasks);
    task_contacts.append(l.tasks * kMostContacts);
    patch_vertices.append(l.tasks * kMostPatchVertices);
}

}  // namespace cullet
