// The model file (.cmodel): the rows of one cooked shell, so that a game cooks once. Which columns stand in it follows
// from the tables' own lists; a build whose tables differ refuses the file. Its reader believes nothing.
//
// The header of engine/file_header.hpp, version 14, magic "cmodl\r\n\x1a", then the payload.
//
// The payload begins with the text name (u32 bytes, the bytes), and the text of its damage model. Then comes the
// material: its name, u8 kind, u8 fracture, f32 for each of material_values() in that order, f32 x, y, z of the grain.
// Then come the texts repairs, advice, walls. Then come the report's numbers: u64 units; f64 mass, thickness; f32
// speed, force; u32 vertices, elements, cells, degenerate elements, collisions, inverted elements, crossings. Then come
// the tables, as engine/table_bytes.hpp writes them: structures and shells (one row each), vertices, elements,
// triangle_springs, hinges, stiffness_packs, stiffness_blocks, stiffness_links, cells, hull_points.
#pragma once
#include <span>
#include <vector>

#include "components/shell_rows.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/models.hpp"

namespace cullet {

/// The bytes of any model, sound or not. Ranges start at 0 and are as large as their rows.
std::vector<uint8_t> encode_model_file(const Model::Contents& contents);
/// The name stands in sentences only. Allocates nothing for rows before their bytes are there. Gives a model whose
/// every index is in range, every number finite and in its column's range, whose elements, hinges, rings, packs, masses
/// and report fit each other: nothing that a world does with it leaves the tables.
/// Refuses a damage model that is not in the list; of one that is, its own check says what else a shell must be.
Result<Model> parse_model_file(std::span<const uint8_t> bytes, const std::string& name, const DamageModels& models);

}  // namespace cullet
