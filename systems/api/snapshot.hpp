// A world as bytes: the settings, every State column, the pools of rows, the rigid bodies. What a snapshot does not
// hold is the host's: its functions, its jobs, the veto.
//
// First the header of engine/file_header.hpp, version 20, magic "csnap\r\n\x1a". Then the settings as numbers, the
// names of the damage models, counts as numbers. Then the tables in the order of State::Sets, as engine/table_bytes.hpp
// writes them, the holes of the pools, the rigid world.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/byte_stream.hpp"
#include "systems/world_contents.hpp"

namespace cullet {

/// Between steps. Rebuilds the rigid world from its own bytes (see RigidWorld::save).
Result<std::vector<uint8_t>> encode_snapshot(World::Contents& world);
/// A new world with the host and the threads of `like`; the name stands in sentences. Every index is looked at before
/// anything follows it.
Result<std::unique_ptr<World::Contents>> parse_snapshot(std::span<const uint8_t> bytes, const std::string& name,
                                                        const World::Contents& like);

/// The names that DamageModels::names() wrote: rows hold numbers of that list. Refuses another list, and trouble of the
/// reader.
Result<void> take_damage_models(ByteReader& in, const DamageModels& models, const std::string& name);

/// The tables and pools of a state alone.
void put_tables(ByteWriter& out, const State& state);
/// Into a fresh state of the same limits; trouble stays with the reader.
void take_tables(ByteReader& in, State& state);

/// Whether a world's rows are such that systems can work on them: indices in range, ranges apart, numbers finite, lists
/// that end. Says nothing of whether physics would have made them. The sentence names table, column and row.
Result<void> check_state(const DamageModels& models, const State& state, const std::string& name);
/// Whether nothing waits longer for its frame than a world makes it wait; `frame` is the next step.
Result<void> check_times(const State& state, uint64_t frame, float dt, const std::string& name);

}  // namespace cullet
