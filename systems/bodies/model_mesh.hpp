// Intact bodies of one model show one mesh.
#pragma once
#include "components/body_rows.hpp"

namespace cullet {

/// What the body has drawn becomes a mesh for others to show, and the body one of its users. It takes no rows for
/// cracks. None when there is no row for it: the mesh stays the body's own. O(1).
Row<ModelMeshes> give_model_mesh(BodyRows& state, Row<Bodies> body);
/// A body without rows of its own shows it. O(1).
void show_model_mesh(BodyRows& state, Row<Bodies> body, Row<ModelMeshes> mesh);
/// The body is no user any more, and shows nothing.
void leave_model_mesh(BodyRows& state, Row<Bodies> body);
/// One user less. The last one gives its rows back.
void release_model_mesh(BodyRows& state, Row<ModelMeshes> mesh);

}  // namespace cullet
