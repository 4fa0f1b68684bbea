// Plays scenes without a window and writes down how they went.
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "cullet/world.hpp"
#include "sample_game/cook_command.hpp"
#include "sample_game/options.hpp"
#include "sample_game/run_scene.hpp"
#include "sample_game/truth.hpp"

namespace cullet {
namespace {

int run(const Options& options) {
    switch (options.command) {
        case Command::Help:
            fmt::print("{}", options.help);
            return 0;
        case Command::KeysHelp:
            fmt::print("{}", keys_help(options.run.scene));
            return 0;
        case Command::Frame:
            fmt::print("{}", World::describe_frame());
            return 0;
        case Command::Run:
            return run_command(options.run);
        case Command::Cook:
            return cook_command(options.cook);
        case Command::Truth:
            break;
    }
    return run_truth(options.truth.model, {options.truth.placements, options.truth.threads, options.truth.out});
}

}  // namespace
}  // namespace cullet

int main(int count, char** arguments) {
    const cullet::Result<cullet::Options> options = cullet::parse_options({arguments + 1, arguments + count});
    if (!options.ok()) {
        fmt::print(stderr, "{}\n", options.error());
        return 2;
    }
    return cullet::run(options.value());
}
